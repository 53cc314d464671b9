#include "server/web/pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <vector>

#include "protocol/json_writer.hpp"
#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"
#include "server/web/table_pages.hpp"

namespace poolhall::web {

using protocol::JsonWriter;
using storage::Reader;

namespace {

using Names = std::map<std::int64_t, std::string>;

Page unreadable(const storage::StorageError& error) {
  return refusal(503, "database", error.reason);
}

Page not_found(std::string_view what) {
  return refusal(404, "not_found", what);
}

Page page_of(JsonWriter& out) {
  return {200, "application/json", std::move(out).text()};
}

std::optional<std::int64_t> number_in(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty() || value < 0) {
    return std::nullopt;
  }
  return value;
}

std::vector<std::string_view> segments_of(std::string_view path) {
  std::vector<std::string_view> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const auto end = std::min(path.find('/'), path.size());
    segments.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return segments;
}

storage::Expected<Names> names_of(Reader& reader) {
  const auto agents = reader.agents();
  if (!agents) {
    return tl::unexpected(agents.error());
  }
  Names names;
  for (const storage::AgentRecord& agent : *agents) {
    names[storage::number(agent.id)] = agent.name;
  }
  return names;
}

void write_agents(JsonWriter& out, const std::array<storage::AgentId, 2>& agents,
                  const Names& names) {
  out.key("agents").begin_array();
  for (const storage::AgentId agent : agents) {
    const auto found = names.find(storage::number(agent));
    out.string(found == names.end() ? "?" : found->second);
  }
  out.end_array();
}

void write_noise(JsonWriter& out, const storage::GameRecord& game) {
  out.key("noise");
  if (game.terms.noise_hidden && !game.over) {
    out.string("hidden");
    return;
  }
  out.begin_object();
  out.key("a").number(game.noise.a).key("b").number(game.noise.b);
  out.key("theta").number(game.noise.theta).key("phi").number(game.noise.phi);
  out.key("v").number(game.noise.v).end_object();
}

void write_result(JsonWriter& out, const storage::GameRecord& game) {
  out.key("over").boolean(game.over);
  if (!game.result) {
    return;
  }
  out.key("winner");
  if (game.result->winner) {
    out.integer(rules::index(*game.result->winner));
  } else {
    out.null();
  }
  out.key("reason").string(rules::name(game.result->reason));
  out.key("scored").boolean(game.result->reason != rules::EndReason::void_game);
}

void write_game(JsonWriter& out, const storage::GameRecord& game, const Names& names) {
  out.key("game").integer(protocol::number(game.id));
  out.key("match").integer(protocol::number(game.match));
  out.key("number").integer(game.number);
  write_agents(out, game.agents, names);
  out.key("rules").string(rules::name(game.terms.rules));
  out.key("table").string(game.terms.table);
  out.key("physics").string(game.terms.materials);
  write_noise(out, game);
  out.key("commitment").string(match::to_hex(game.commitment));
  out.key("physics_version").string(game.physics_version);
  out.key("rules_version").string(game.rules_version);
  write_result(out, game);
}

void write_params(JsonWriter& out, std::string_view key, const protocol::ShotParams& params) {
  out.key(key).begin_object();
  out.key("a").number(params.a).key("b").number(params.b);
  out.key("theta").number(params.theta).key("phi").number(params.phi);
  out.key("v").number(params.v).end_object();
}

void write_turn(JsonWriter& out, const storage::TurnRecord& turn) {
  out.key("turn").integer(turn.number);
  out.key("by").integer(rules::index(turn.seat));
  out.key("action").string(storage::name(turn.action));
  out.key("used_ms").number(static_cast<double>(turn.clock.used.count()) / 1e3);
  if (turn.shot) {
    write_params(out, "intended", turn.shot->intended);
    write_params(out, "executed", turn.shot->executed);
    out.key("moved").boolean(turn.shot->moved);
    out.key("call").raw(protocol::encode_call(turn.shot->call));
  }
  if (turn.decision) {
    out.key("choice").string(rules::name(*turn.decision));
  }
  out.key("ruling").raw(turn.ruling.value_or("null"));
}

Page agents_page(Reader& reader) {
  const auto agents = reader.agents();
  if (!agents) {
    return unreadable(agents.error());
  }
  JsonWriter out;
  out.begin_object().key("agents").begin_array();
  for (const storage::AgentRecord& agent : *agents) {
    out.begin_object().key("agent").string(agent.name);
    out.key("house").boolean(agent.house_bot.has_value()).end_object();
  }
  out.end_array().end_object();
  return page_of(out);
}

void write_tournament(JsonWriter& out, const storage::TournamentRecord& tournament) {
  out.key("tournament").string(tournament.id);
  out.key("wire_id").integer(protocol::number(tournament.wire_id));
  out.key("title").string(tournament.title);
  out.key("status").string(storage::name(tournament.status));
}

Page tournaments_page(Reader& reader) {
  const auto tournaments = reader.tournaments();
  if (!tournaments) {
    return unreadable(tournaments.error());
  }
  JsonWriter out;
  out.begin_object().key("tournaments").begin_array();
  for (const storage::TournamentRecord& tournament : *tournaments) {
    out.begin_object();
    write_tournament(out, tournament);
    out.end_object();
  }
  out.end_array().end_object();
  return page_of(out);
}

storage::Expected<void> write_matches(JsonWriter& out, Reader& reader, std::string_view tournament,
                                      const Names& names) {
  const auto matches = reader.matches_of(tournament);
  if (!matches) {
    return tl::unexpected(matches.error());
  }
  out.key("matches").begin_array();
  for (const storage::MatchRecord& match : *matches) {
    const auto games = reader.games_of(match.id);
    if (!games) {
      return tl::unexpected(games.error());
    }
    out.begin_object().key("match").integer(protocol::number(match.id));
    out.key("over").boolean(match.over);
    write_agents(out, match.agents, names);
    out.key("games").begin_array();
    for (const storage::GameRecord& game : *games) {
      out.begin_object().key("game").integer(protocol::number(game.id));
      write_agents(out, game.agents, names);
      write_result(out, game);
      out.end_object();
    }
    out.end_array().end_object();
  }
  out.end_array();
  return {};
}

Page tournament_page(Reader& reader, std::string_view id) {
  const auto tournaments = reader.tournaments();
  const auto names = names_of(reader);
  const auto entries = reader.entries(id);
  if (!tournaments || !names || !entries) {
    return unreadable(!tournaments ? tournaments.error()
                      : !names     ? names.error()
                                   : entries.error());
  }
  const auto found = std::find_if(tournaments->begin(), tournaments->end(),
                                  [id](const auto& tournament) { return tournament.id == id; });
  if (found == tournaments->end()) {
    return not_found("there is no such tournament");
  }
  JsonWriter out;
  out.begin_object();
  write_tournament(out, *found);
  out.key("entries").begin_array();
  for (const storage::EntryRecord& entry : *entries) {
    const auto name = names->find(storage::number(entry.agent));
    out.begin_object().key("agent").string(name == names->end() ? "?" : name->second);
    out.key("withdrawn").boolean(entry.withdrawn).end_object();
  }
  out.end_array();
  if (const auto written = write_matches(out, reader, id, *names); !written) {
    return unreadable(written.error());
  }
  out.end_object();
  return page_of(out);
}

// The key of a game whose match is over; before, nobody sees it.
storage::Expected<void> write_key(JsonWriter& out, Reader& reader,
                                  const storage::GameRecord& game) {
  const auto match = reader.match(game.match);
  if (!match) {
    return tl::unexpected(match.error());
  }
  if (*match && (*match)->over) {
    out.key("key").string(match::to_hex(game.key));
    out.key("rack_seed").integer(game.rack_seed);
  }
  return {};
}

Page game_page(Reader& reader, std::int64_t id) {
  const auto game = reader.game(protocol::GameId{id});
  const auto names = names_of(reader);
  if (!game || !names) {
    return unreadable(game ? names.error() : game.error());
  }
  if (!*game) {
    return not_found("there is no such game");
  }
  JsonWriter out;
  out.begin_object();
  write_game(out, **game, *names);
  if (const auto written = write_key(out, reader, **game); !written) {
    return unreadable(written.error());
  }
  out.key("initial_state").raw((*game)->initial_state).key("turns").begin_array();
  const auto read = reader.each_turn((*game)->id, [&out](const storage::TurnRecord& turn) {
    out.begin_object();
    write_turn(out, turn);
    out.end_object();
    return true;
  });
  if (!read) {
    return unreadable(read.error());
  }
  out.end_array().end_object();
  return page_of(out);
}

Page shot_page(Reader& reader, std::int64_t id, std::int64_t number) {
  if (number > 0xffff'ffffLL) {
    return not_found("there is no such turn");
  }
  const auto turn = reader.turn(protocol::GameId{id}, static_cast<std::uint32_t>(number));
  if (!turn) {
    return unreadable(turn.error());
  }
  if (!*turn) {
    return not_found("there is no such turn");
  }
  JsonWriter out;
  out.begin_object().key("game").integer(id);
  write_turn(out, **turn);
  out.key("state_before").raw((*turn)->state_before);
  out.key("events").raw((*turn)->shot ? (*turn)->shot->events : "[]");
  out.key("state_after").raw((*turn)->state_after);
  out.key("checksum").string(match::to_hex((*turn)->checksum)).end_object();
  return page_of(out);
}

}  // namespace

Page refusal(unsigned status, std::string_view code, std::string_view reason) {
  JsonWriter out;
  out.begin_object().key("error").begin_object();
  out.key("code").string(code).key("reason").string(reason).end_object().end_object();
  return {status, "application/json", std::move(out).text()};
}

Page answer(Reader& reader, std::string_view path) {
  const auto segments = segments_of(path);
  if (segments.size() < 2 || segments[0] != "api") {
    return not_found("the API's pages begin with /api/");
  }
  const std::string_view what = segments[1];
  if (segments.size() == 2 && what == "agents") {
    return agents_page(reader);
  }
  if (segments.size() == 2 && what == "tournaments") {
    return tournaments_page(reader);
  }
  if (segments.size() == 3 && what == "tournaments") {
    return tournament_page(reader, segments[2]);
  }
  if (segments.size() == 2 && what == "tournaments.txt") {
    return tournament_list_page(reader);
  }
  if (segments.size() == 4 && what == "tournaments") {
    return table_page(reader, segments[2], segments[3]);
  }
  const bool shot = segments.size() == 5 && segments[3] == "shots";
  if (what == "games" && (segments.size() == 3 || shot)) {
    const auto game = number_in(segments[2]);
    const auto turn = shot ? number_in(segments[4]) : std::optional<std::int64_t>{0};
    if (!game || !turn) {
      return not_found("games and turns are called by their numbers");
    }
    return shot ? shot_page(reader, *game, *turn) : game_page(reader, *game);
  }
  return not_found("there is no such page");
}

}  // namespace poolhall::web
