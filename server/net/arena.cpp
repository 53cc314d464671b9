#include "server/net/arena.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "physics/version.hpp"
#include "rules/version.hpp"
#include "server/match/chain.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;
using std::chrono::steady_clock;

namespace {

// How long shots in flight may take once the server stops, and how long last lines.
constexpr std::chrono::seconds longest_stop{10};
constexpr std::chrono::milliseconds last_lines{300};
// Connections beyond the bounds that are told so at a time.
constexpr std::size_t most_turned_away = 64;

}  // namespace

Arena::Arena(boost::asio::io_context& io, boost::asio::thread_pool& workers,
             storage::Writer& writer, Archive& archive, ArenaSettings settings)
    : io_(io),
      settings_(std::move(settings)),
      deadlines_(io),
      visitors_(settings_.limits),
      connections_{settings_.limits, deadlines_},
      untold_(archive, book_, settings_.limits),
      services_{io,
                workers,
                writer,
                archive,
                deadlines_,
                book_,
                time_,
                settings_.limits,
                [this](LiveGame& game) { game_over(game); },
                [this] { look_whether_quiet(); },
                [this](protocol::GameId game) { return bots_.has_places(game); }},
      bots_(io, deadlines_),
      matches_(services_, ids_,
               {[this](std::shared_ptr<LiveGame> game) { launch(std::move(game)); },
                [this](const std::string& id) { return tournaments_.wire_id(id); },
                [this](const std::string& id, storage::AgentId agent) {
                  return tournaments_.has_left(id, agent);
                },
                [this](const storage::MatchRecord& match, const GameOutcome& outcome) {
                  tournaments_.game_over(match, outcome);
                },
                [this](const storage::MatchRecord& match, const std::vector<GameOutcome>& games) {
                  tournaments_.match_over(match, games);
                },
                [this](const storage::MatchRecord& match,
                       const std::vector<storage::GameRecord>& games) {
                  untold_.match_over(
                      match, games,
                      match.tournament ? tournaments_.wire_id(*match.tournament) : std::nullopt);
                }}),
      tournaments_(services_, matches_, untold_, ids_,
                   {[this](const std::string& name, const HousePlayer& player) -> Agent& {
                      return house_agent(name, player);
                    },
                    [this](const std::string& name) -> Agent& { return stand_in(name); },
                    [this](const std::string& tournament, storage::AgentId loser) {
                      forfeit_games_of(tournament, loser);
                    }}),
      challenges_(services_, matches_,
                  {[this](storage::AgentId from, const std::string& bot) {
                     return house_opponent(from, bot);
                   },
                   [this](storage::AgentId agent) {
                     const auto own = games_of_.find(agent);
                     return own == games_of_.end() ? 0 : own->second.size();
                   }}),
      finished_(services_, [this](const storage::MatchRecord& match) {
        return match.tournament ? tournaments_.wire_id(*match.tournament) : std::nullopt;
      }) {}

Arena::~Arena() = default;

storage::Expected<void> Arena::restore(storage::Reader& reader, StoredTournaments tournaments) {
  auto counters = reader.counters();
  auto agents = reader.agents();
  auto matches = reader.unfinished_matches();
  auto games = reader.unfinished_games();
  if (!counters || !agents) {
    return tl::unexpected(counters ? agents.error() : counters.error());
  }
  if (!matches || !games) {
    return tl::unexpected(matches ? games.error() : matches.error());
  }
  ids_ = *counters;
  for (storage::AgentRecord& agent : *agents) {
    book_.add(std::move(agent));
  }
  if (auto restored = tournaments_.restore(reader, tournaments); !restored) {
    return restored;
  }
  for (const storage::MatchRecord& match : *matches) {
    const auto played = reader.games_of(match.id);
    if (!played) {
      return tl::unexpected(played.error());
    }
    matches_.restore(match, *played);
  }
  unfinished_ = std::move(*games);
  return {};
}

void Arena::begin(const HouseBots::Settings& bots) {
  book_.for_each([this](Agent& agent) {
    // The bots of tournaments' entries are employed when the driver enters them again.
    if (agent.record.house_bot && agent.record.name.starts_with("house:")) {
      bots_.employ(book_, agent, {.bot = *agent.record.house_bot});
    }
  });
  bots_.on_places([this](protocol::GameId game) {
    if (LiveGame* live = live_game(game)) {
      live->places_given();
    }
  });
  bots_.configure(bots);
  for (const storage::UnfinishedGame& game : std::exchange(unfinished_, {})) {
    if (const auto resumed = matches_.resume(game); !resumed) {
      spdlog::error("{}", resumed.error());
    }
  }
  for (const MatchId match : matches_.challenges()) {
    matches_.go_on(match);
  }
}

void Arena::turn_away(Channel channel, const protocol::Error& error) {
  if (turned_away_ >= most_turned_away) {
    return;  // too many to be polite
  }
  ++turned_away_;
  const auto connection = std::make_shared<Connection>(
      std::move(channel), ConnectionId{next_connection_++}, connections_);
  connection->on_gone([this] { --turned_away_; });
  connection->start({});
  connection->close(std::make_shared<const std::string>(protocol::encode_error({}, error)),
                    std::string{protocol::name(error.code)});
}

void Arena::accept(Channel channel, std::function<void()> gone) {
  const ConnectionId id{next_connection_++};
  auto connection = std::make_shared<Connection>(std::move(channel), id, connections_);
  connection->on_gone(std::move(gone));
  spdlog::info("connection {} from {}", number(id), connection->peer());
  const auto session = std::make_shared<Session>(std::move(connection), *this);
  sessions_.emplace(number(id), session);
  session->begin();
  if (stage_ != Stage::running) {
    session->close({ErrorCode::shutting_down, "", "the server stops; come back later"});
  }
}

void Arena::leaves(const Session& session) {
  if (const auto agent = session.agent()) {
    Agent* known = book_.find(*agent);
    if (known != nullptr && known->session.lock().get() == &session) {
      known->session.reset();
    }
  }
}

void Arena::ended(const Session& session) {
  leaves(session);
  sessions_.erase(number(session.connection().id()));
}

protocol::HelloReply Arena::greeting(const Session& session) const {
  protocol::HelloReply reply;
  reply.server = {settings_.name, "0.1.0"};
  reply.session = fmt::format("{}", number(session.connection().id()));
  reply.limits = settings_.limits;
  reply.rules_version = rules::version;
  reply.physics_version = physics::version;
  reply.time_ms = time_.ms(steady_clock::now());
  return reply;
}

LiveGame* Arena::live_game(protocol::GameId game) const {
  const auto found = games_.find(number(game));
  return found == games_.end() ? nullptr : found->second.get();
}

bool Arena::is_awaited(storage::AgentId agent, const protocol::Request& request) const {
  const auto* shot = std::get_if<protocol::Shot>(&request);
  const auto* decide = std::get_if<protocol::Decide>(&request);
  if (shot == nullptr && decide == nullptr) {
    return false;
  }
  const LiveGame* game = live_game(shot != nullptr ? shot->game : decide->game);
  const auto seat = game != nullptr ? game->seat_of(agent) : std::nullopt;
  return seat && game->is_awaited(*seat, request);
}

void Arena::handle(const Asker& asker, storage::AgentId agent, protocol::Request request,
                   SteadyTime read_at) {
  using protocol::Method;
  const Method method = protocol::method_of(request);
  const bool begins_something = method == Method::challenge || method == Method::challenge_accept ||
                                method == Method::tournament_join;
  if (begins_something && stage_ != Stage::running) {
    asker.refuse({ErrorCode::shutting_down, "", "the server stops; ask again when it is back"});
    return;
  }
  switch (method) {
    case Method::tournament_list:
      return tournaments_.list(asker);
    case Method::tournament_join:
      return tournaments_.join(asker, agent,
                               std::get<protocol::TournamentJoin>(request).tournament);
    case Method::tournament_leave:
      return tournaments_.leave(asker, agent,
                                std::get<protocol::TournamentLeave>(request).tournament);
    case Method::challenge:
      return challenges_.challenge(asker, agent, std::get<protocol::Challenge>(request));
    case Method::challenge_accept:
      return challenges_.accept(asker, agent,
                                std::get<protocol::ChallengeAccept>(request).challenge);
    case Method::challenge_decline:
      return challenges_.decline(asker, agent,
                                 std::get<protocol::ChallengeDecline>(request).challenge);
    case Method::shot:
    case Method::decide:
    case Method::concede:
    case Method::sync:
    case Method::game_reveal:
      return handle_game(asker, agent, request, read_at);
    case Method::game_ready:
      return ready(asker, agent, std::get<protocol::GameReady>(request));
    case Method::ack:
      return acknowledge(asker, agent, std::get<protocol::Ack>(request).what);
    case Method::hello:
    case Method::register_agent:
    case Method::login:
    case Method::ping:
    case Method::lag:
      return;  // answered by the session
  }
}

void Arena::handle_game(const Asker& asker, storage::AgentId agent, protocol::Request& request,
                        SteadyTime read_at) {
  const auto with_seat = [&](protocol::GameId id, const auto& live, const auto& over) {
    LiveGame* game = live_game(id);
    if (game == nullptr) {
      over();
    } else if (const auto seat = game->seat_of(agent)) {
      live(*game, *seat);
    } else {
      asker.refuse(unknown_game(id));
    }
  };
  if (auto* shot = std::get_if<protocol::Shot>(&request)) {
    with_seat(
        shot->game,
        [&](LiveGame& game, Seat seat) {
          game.take({asker, seat, std::move(*shot), read_at});
        },
        [&] { finished_.repeat(asker, agent, *shot); });
  } else if (auto* decide = std::get_if<protocol::Decide>(&request)) {
    with_seat(
        decide->game,
        [&](LiveGame& game, Seat seat) {
          game.take({asker, seat, *decide, read_at});
        },
        [&] { finished_.repeat(asker, agent, *decide); });
  } else if (auto* concede = std::get_if<protocol::Concede>(&request)) {
    with_seat(
        concede->game,
        [&](LiveGame& game, Seat seat) {
          game.take({asker, seat, *concede, read_at});
        },
        [&] { finished_.concede(asker, agent, concede->game); });
  } else if (auto* sync = std::get_if<protocol::Sync>(&request)) {
    with_seat(
        sync->game, [&](LiveGame& game, Seat seat) { game.sync(asker, seat); },
        [&] { finished_.sync(asker, agent, sync->game); });
  } else if (auto* reveal = std::get_if<protocol::GameReveal>(&request)) {
    with_seat(
        reveal->game, [&](LiveGame& game, Seat seat) { game.reveal(asker, seat, *reveal); },
        [&] { finished_.too_late(asker, agent, reveal->game); });
  }
}

// Kept in memory alone: game.start shows whether it counts.
void Arena::ready(const Asker& asker, storage::AgentId agent, const protocol::GameReady& request) {
  const auto session = asker.session.lock();
  if (session == nullptr) {
    return;
  }
  book_.find(agent)->commitments.add(match::digest_of(request.commitment.text), session);
  asker.reply(protocol::EmptyReply{});
}

void Arena::acknowledge(const Asker& asker, storage::AgentId agent, const protocol::Ended& what) {
  if (const auto* game = std::get_if<protocol::GameId>(&what)) {
    if (const LiveGame* live = live_game(*game); live != nullptr && live->seat_of(agent)) {
      asker.refuse({ErrorCode::invalid_params, "/params/game",
                    fmt::format("got {}, a game that goes on", number(*game)), *game});
      return;
    }
  }
  untold_.acknowledged(agent, what);
  if (const auto* game = std::get_if<protocol::GameId>(&what)) {
    finished_.acknowledge(asker, agent, *game);
  } else if (const auto* match = std::get_if<protocol::MatchId>(&what)) {
    finished_.acknowledge(asker, agent, *match);
  } else {
    tournaments_.acknowledge(asker, agent, std::get<protocol::TournamentId>(what));
  }
}

void Arena::launch(std::shared_ptr<LiveGame> game) {
  const storage::GameRecord& record = game->record();
  games_[number(record.id)] = game;
  for (const storage::AgentId agent : record.agents) {
    games_of_[agent].push_back(record.id);
  }
  bots_.need(record.id, record.agents);
  if (stage_ != Stage::running) {
    game->halt();
  }
  if (storage_in_trouble_) {
    game->suspend();
  }
  game->begin();
  if (on_games_changed_) {
    on_games_changed_();
  }
}

void Arena::game_over(LiveGame& game) {
  const storage::GameRecord& record = game.record();
  const protocol::GameOver over = over_of(record);
  spdlog::info("game {} is over: {}, {}", number(record.id),
               over.winner ? book_.name_of(record.agents[rules::index(*over.winner)]) + " wins"
                           : "nobody wins",
               rules::name(over.reason));
  ++games_over_;
  for (const storage::AgentId agent : record.agents) {
    std::erase(games_of_[agent], record.id);
  }
  bots_.release(record.id);
  untold_.game_over(record);
  matches_.game_over(game);
  games_.erase(number(record.id));  // whoever called holds it until the call is done
  if (on_games_changed_) {
    on_games_changed_();
  }
}

Arena::CalledOff Arena::call_off(protocol::GameId game) {
  LiveGame* live = live_game(game);
  if (live == nullptr) {
    return CalledOff::no_game_that_goes_on;
  }
  spdlog::warn("game {} is called off by the host", number(game));
  live->shared_from_this()->call_off();
  return CalledOff::ends;
}

void Arena::when_stored(std::function<void()> then) {
  const auto posted =
      services_.writer.post([](storage::Database&) { return storage::Expected<void>{}; },
                            [then](const storage::Expected<void>&) { then(); });
  if (posted != storage::Posted::accepted) {
    then();
  }
}

void Arena::call_off_games_of(const std::string& tournament) {
  const auto games = games_;
  for (const auto& [id, game] : games) {
    if (matches_.tournament_of(game->record().match) == tournament) {
      game->call_off();
    }
  }
}

void Arena::forfeit_games_of(const std::string& tournament, storage::AgentId loser) {
  const auto games = games_;
  for (const auto& [id, game] : games) {
    const auto seat = game->seat_of(loser);
    if (seat && matches_.tournament_of(game->record().match) == tournament) {
      game->leave(*seat);
    }
  }
}

void Arena::stop(std::function<void()> then) {
  if (stage_ != Stage::running) {
    return;
  }
  spdlog::info("stopping: {} games stand until the server is back", games_.size());
  stage_ = Stage::stopping;
  after_stop_ = std::move(then);
  for (const auto& [id, game] : games_) {
    game->halt();
  }
  stop_deadline_ = deadlines_.at(steady_clock::now() + longest_stop, [this] { tell_everyone(); });
  look_whether_quiet();
}

void Arena::look_whether_quiet() {
  if (stage_ != Stage::stopping) {
    return;
  }
  const bool busy = std::any_of(games_.begin(), games_.end(),
                                [](const auto& entry) { return entry.second->in_flight(); });
  if (!busy && tournaments_.ends_under_way() == 0) {
    tell_everyone();
  }
}

void Arena::tell_everyone() {
  if (stage_ == Stage::told) {
    return;
  }
  stage_ = Stage::told;
  const auto sessions = sessions_;
  for (const auto& [id, session] : sessions) {
    session->close_with(
        protocol::ShuttingDown{"the server stops; games that are not over go on when it is back"},
        "shutting_down");
  }
  bots_.stop();
  stop_deadline_ = deadlines_.at(steady_clock::now() + last_lines, [this] { after_stop_(); });
}

void Arena::storage_health(const storage::WriterHealth& health) {
  const bool was_in_trouble = std::exchange(storage_in_trouble_, health.trouble.has_value());
  if (was_in_trouble != storage_in_trouble_) {
    const auto games = games_;
    for (const auto& [id, game] : games) {
      if (storage_in_trouble_) {
        game->suspend();
      } else {
        game->go_on_after_suspension();
      }
    }
  }
  if (health.trouble) {
    spdlog::error("the database takes nothing, games stand: {} ({} pieces of work wait)",
                  health.trouble->reason, health.waiting);
  } else {
    spdlog::info("the database works again, games go on");
  }
}

void Arena::for_each_game(const std::function<void(const LiveGame&)>& visit) const {
  for (const auto& [id, game] : games_) {
    visit(*game);
  }
}

ArenaFigures Arena::figures() const {
  ArenaFigures figures;
  figures.connections = sessions_.size();
  figures.agents_here = static_cast<std::size_t>(
      std::count_if(sessions_.begin(), sessions_.end(),
                    [](const auto& entry) { return entry.second->is_present(); }));
  figures.agents_known = book_.size();
  figures.games = games_.size();
  figures.matches = matches_.size();
  figures.house_bots = bots_.running();
  figures.games_over = games_over_;
  figures.storage_in_trouble = storage_in_trouble_;
  return figures;
}

}  // namespace poolhall::net
