#include "server/net/admin_calls.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "protocol/json_writer.hpp"

namespace poolhall::net {

using protocol::JsonWriter;
using web::Page;
using web::Then;

namespace {

constexpr unsigned created = 201;
constexpr unsigned accepted = 202;

Page page_of(const DeskRefusal& refusal) {
  switch (refusal.kind) {
    case DeskRefusal::Kind::bad_settings:
      return web::refusal(400, "bad_settings", refusal.reason);
    case DeskRefusal::Kind::unknown:
      return web::refusal(404, "not_found", refusal.reason);
    case DeskRefusal::Kind::conflict:
      break;
  }
  return web::refusal(409, "conflict", refusal.reason);
}

Page page_of(unsigned status, const TournamentDesk::Result<TournamentCard>& card) {
  if (!card) {
    return page_of(card.error());
  }
  spdlog::info("the host: tournament {} is {}", card->id, storage::name(card->status));
  JsonWriter out;
  out.begin_object().key("tournament").string(card->id);
  out.key("status").string(storage::name(card->status)).end_object();
  return {status, "application/json", std::move(out).text()};
}

unsigned status_of(protocol::ErrorCode code) {
  switch (code) {
    case protocol::ErrorCode::bad_name:
      return 400;
    case protocol::ErrorCode::unknown_agent:
      return 404;
    case protocol::ErrorCode::name_taken:
    case protocol::ErrorCode::tournament_closed:
      return 409;
    default:
      return 503;
  }
}

Page agent_page(const std::string& name, const protocol::Expected<std::string>& token) {
  if (!token) {
    return web::refusal(status_of(token.error().code), protocol::name(token.error().code),
                        token.error().reason);
  }
  JsonWriter out;
  out.begin_object().key("agent").string(name).key("token").string(*token).end_object();
  return {created, "application/json", std::move(out).text()};
}

Page void_page(std::int64_t game) {
  JsonWriter out;
  out.begin_object().key("game").integer(game).key("status").string("ending").end_object();
  return {accepted, "application/json", std::move(out).text()};
}

void void_game(Arena& arena, Archive& archive, std::int64_t game, const Then& then) {
  const protocol::GameId id{game};
  if (arena.call_off(id) == Arena::CalledOff::ends) {
    then(void_page(game));
    return;
  }
  archive.read(
      [id](storage::Reader& reader) { return reader.game(id); },
      [then, game](const storage::Expected<std::optional<storage::GameRecord>>& found) {
        if (!found) {
          then(web::refusal(503, "database", found.error().reason));
        } else if (*found) {
          then(web::refusal(409, "game_over",
                            fmt::format("game {} is over, expected one that goes on", game)));
        } else {
          then(web::refusal(404, "not_found", fmt::format("there is no game {}", game)));
        }
      });
}

struct EntryOf {
  std::string tournament;
  std::string agent;
};

void change_entry(Tournaments& tournaments, const EntryOf& entry,
                  web::HostCalls::EntryChange change, const Then& then) {
  if (!tournaments.wire_id(entry.tournament)) {
    then(web::refusal(404, "not_found",
                      fmt::format("there is no tournament \"{}\"", entry.tournament)));
    return;
  }
  const bool enters = change == web::HostCalls::EntryChange::enter;
  const auto done = [entry, enters, then](const protocol::Expected<void>& stored) {
    if (!stored) {
      then(web::refusal(status_of(stored.error().code), protocol::name(stored.error().code),
                        stored.error().reason));
      return;
    }
    JsonWriter out;
    out.begin_object().key("tournament").string(entry.tournament).key("agent").string(entry.agent);
    out.key("status").string(enters ? "entered" : "withdrawn").end_object();
    then({200, "application/json", std::move(out).text()});
  };
  if (enters) {
    tournaments.host_enters(entry.tournament, entry.agent, done);
  } else {
    tournaments.host_withdraws(entry.tournament, entry.agent, done);
  }
}

TournamentDesk::Result<TournamentCard> changed(TournamentDesk& desk, const std::string& id,
                                               web::HostCalls::Change change) {
  using Change = web::HostCalls::Change;
  switch (change) {
    case Change::start:
      return desk.start(id);
    case Change::pause:
      return desk.pause(id);
    case Change::resume:
      return desk.resume(id);
    case Change::abort:
      break;
  }
  return desk.abort(id);
}

}  // namespace

web::HostCalls host_calls(Arena& arena, Archive& archive, TournamentDesk& desk) {
  web::HostCalls calls;
  const auto when_stored = [&arena](Page page, const Then& then) {
    arena.when_stored([page = std::move(page), then] { then(page); });
  };
  calls.create_tournament = [&desk, when_stored](const std::string& toml, const Then& then) {
    when_stored(page_of(created, desk.create(toml)), then);
  };
  calls.change_tournament = [&desk, when_stored](const std::string& id,
                                                 web::HostCalls::Change change, const Then& then) {
    when_stored(page_of(200, changed(desk, id, change)), then);
  };
  calls.change_entry = [&arena](const std::string& id, web::HostCalls::EntryChange change,
                                const std::string& agent, const Then& then) {
    change_entry(arena.tournaments(), {id, agent}, change, then);
  };
  calls.add_agent = [&arena](const std::string& name, const Then& then) {
    arena.add_agent(name, [name, then](const protocol::Expected<std::string>& token) {
      then(agent_page(name, token));
    });
  };
  calls.void_game = [&arena, &archive](std::int64_t game, const Then& then) {
    void_game(arena, archive, game, then);
  };
  return calls;
}

}  // namespace poolhall::net
