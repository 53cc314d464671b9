#include "server/net/matches.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/match/chain.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

constexpr std::chrono::milliseconds store_retry{100};
// A game that is void so often in a row will not become better.
constexpr std::uint32_t attempts_bound = 5;

template <class Id>
Id take_next(Id& next) {
  const Id taken = next;
  next = Id{static_cast<std::int64_t>(next) + 1};
  return taken;
}

std::uint32_t attempts_at(const std::vector<storage::GameRecord>& games, std::uint32_t number) {
  return static_cast<std::uint32_t>(
      std::count_if(games.begin(), games.end(),
                    [number](const storage::GameRecord& game) { return game.number == number; }));
}

storage::Expected<void> add_all(storage::Database& database,
                                const std::vector<storage::GameRecord>& games) {
  for (const storage::GameRecord& game : games) {
    if (auto added = database.add_game(game); !added) {
      return added;
    }
  }
  return {};
}

}  // namespace

Matches::Matches(GameServices& services, storage::Counters& ids, Outside outside)
    : services_(services), ids_(ids), outside_(std::move(outside)) {}

void Matches::start(const MatchPlan& plan, Started started) {
  LiveMatch match;
  storage::MatchRecord& record = match.record;
  record.id = take_next(ids_.match);
  record.tournament = plan.tournament;
  record.pairing = plan.pairing;
  record.request = plan.request;
  record.challenge = plan.challenge;
  record.agents = plan.agents;
  record.games = plan.games;
  record.terms = plan.terms;
  record.seed = plan.seed;
  record.mirrored = plan.mirrored;
  record.created = storage::unix_now();
  record.seal = match::seal(record);
  const auto games = draw_next(match, 0);
  if (!games) {
    started(tl::unexpected(Error{ErrorCode::invalid_params, "/params", games.error()}));
    return;
  }
  match.going_on = static_cast<std::uint32_t>(games->size());
  const MatchId id = record.id;
  matches_.emplace(id, match);
  const auto posted = services_.writer.post(
      [record, games = *games](storage::Database& database) -> storage::Expected<void> {
        auto added = database.add_match(record);
        return added ? add_all(database, games) : added;
      },
      [this, id, games = *games, started](const storage::Expected<void>& stored) {
        if (!stored) {
          matches_.erase(id);
          started(tl::unexpected(Error{ErrorCode::internal, "",
                                       "the match cannot be stored: " + stored.error().reason}));
          return;
        }
        started(id);
        launch_all(id, games);
      });
  if (posted != storage::Posted::accepted) {
    matches_.erase(id);
    started(
        tl::unexpected(Error{ErrorCode::paused, "", "the database takes nothing at the moment"}));
  }
}

void Matches::restore(const storage::MatchRecord& record,
                      const std::vector<storage::GameRecord>& games) {
  LiveMatch match;
  match.record = record;
  std::copy_if(games.begin(), games.end(), std::back_inserter(match.games),
               [](const storage::GameRecord& game) { return game.over; });
  matches_.emplace(record.id, std::move(match));
}

tl::expected<void, std::string> Matches::resume(const storage::UnfinishedGame& unfinished) {
  const auto found = matches_.find(unfinished.game.match);
  if (found == matches_.end()) {
    return tl::unexpected(
        fmt::format("game {} belongs to no unfinished match", number(unfinished.game.id)));
  }
  ++found->second.going_on;
  launch(unfinished, found->second, Start::resume);
  return {};
}

void Matches::go_on(MatchId match) {
  const auto found = matches_.find(match);
  if (found != matches_.end()) {
    begin_next(found->second);
  }
}

std::vector<GameOutcome> Matches::outcomes(const LiveMatch& match) const {
  std::vector<GameOutcome> scored;
  for (const storage::GameRecord& game : match.games) {
    if (const auto outcome = ledger::scored_game(match.record, game)) {
      scored.push_back(*outcome);
    }
  }
  std::sort(scored.begin(), scored.end(),
            [](const GameOutcome& a, const GameOutcome& b) { return a.number < b.number; });
  return scored;
}

std::optional<std::uint32_t> Matches::next_number(const LiveMatch& match) const {
  for (std::uint32_t number = 0; number < match.record.games; ++number) {
    const std::uint32_t attempts = attempts_at(match.games, number);
    const bool scored =
        std::any_of(match.games.begin(), match.games.end(), [&](const storage::GameRecord& game) {
          return game.number == number && ledger::scored_game(match.record, game);
        });
    if (!scored && attempts < attempts_bound) {
      return number;
    }
  }
  return std::nullopt;
}

tl::expected<storage::GameRecord, std::string> Matches::draw_game(
    const LiveMatch& match, std::uint32_t number, std::optional<protocol::GameId> shared_from) {
  match::GameOrder order;
  order.match = match.record.id;
  order.number = number;
  order.attempt = attempts_at(match.games, number);
  // The breaker sits in the first seat, and the agents change seats from game to game.
  order.agents = match.record.agents;
  if (number % 2 == 1) {
    std::swap(order.agents[0], order.agents[1]);
  }
  order.terms = match.record.terms;
  order.breaker = Seat::first;
  order.rack_seed = match::rack_seed(
      match.record.seed, match::rack_number(number, order.attempt, match.record.mirrored));
  order.key = match::draw_key();
  order.created = storage::unix_now();
  order.id = ids_.game;
  order.shared_from = shared_from;
  for (const std::size_t seat : {0U, 1U}) {
    if (Agent* agent = services_.book.find(order.agents[seat])) {
      order.agent_commitments[seat] = agent->commitments.take();
    }
  }
  auto record = match::new_game_record(order);
  if (record) {
    take_next(ids_.game);
  }
  return record;
}

void Matches::set_pace(const std::string& tournament, Pace pace) {
  paces_[tournament] = pace;
  for (auto& [id, match] : matches_) {
    if (match.record.tournament == tournament) {
      begin_next(match);
    }
  }
}

Matches::Pace Matches::pace_of(const LiveMatch& match) const {
  const auto found = match.record.tournament ? paces_.find(*match.record.tournament) : paces_.end();
  return found == paces_.end() ? Pace::steady : found->second;
}

tl::expected<Matches::Drawn, std::string> Matches::draw_next(const LiveMatch& match,
                                                             std::uint32_t number) {
  const bool is_pair = match.record.mirrored == storage::Mirror::noise && number % 2 == 0 &&
                       number + 1 < match.record.games &&
                       attempts_at(match.games, number) + attempts_at(match.games, number + 1) == 0;
  Drawn drawn;
  const auto shared_from = is_pair ? std::optional(ids_.game) : std::nullopt;
  for (std::uint32_t i = 0; i < (is_pair ? 2U : 1U); ++i) {
    auto game = draw_game(match, number + i, shared_from);
    if (!game) {
      return tl::unexpected(game.error());
    }
    drawn.push_back(std::move(*game));
  }
  return drawn;
}

void Matches::begin_next(LiveMatch& match) {
  if (match.going_on > 0 || match.finishing) {
    return;
  }
  const auto number = next_number(match);
  const Pace pace = pace_of(match);
  if (!number || pace == Pace::ended) {
    finish(match);
    return;
  }
  if (pace == Pace::held) {
    return;
  }
  const auto games = draw_next(match, *number);
  if (!games) {
    spdlog::error("match {}: no game {}: {}", protocol::number(match.record.id), *number,
                  games.error());
    return;
  }
  match.going_on = static_cast<std::uint32_t>(games->size());
  post([games = *games](storage::Database& database) { return add_all(database, games); },
       [this, id = match.record.id, games = *games] { launch_all(id, games); },
       fmt::format("game {}", protocol::number(games->front().id)));
}

void Matches::launch_all(MatchId match, const Drawn& games) {
  for (const storage::GameRecord& game : games) {
    launch({game, {}, {}}, matches_.at(match), Start::fresh);
  }
}

void Matches::launch(const storage::UnfinishedGame& unfinished, LiveMatch& match, Start start) {
  auto game = match::Game::open(unfinished);
  if (!game) {
    spdlog::error("game {} cannot go on: {}", protocol::number(unfinished.game.id), game.error());
    return;
  }
  const std::array<std::string, 2> names{services_.book.name_of(unfinished.game.agents[0]),
                                         services_.book.name_of(unfinished.game.agents[1])};
  const storage::MatchRecord& record = match.record;
  const auto wire_id = record.tournament ? outside_.wire_id(*record.tournament) : std::nullopt;
  const GameCard card = card_of(game->board(), names, wire_id);
  spdlog::info("game {} of match {}: {} against {}{}", protocol::number(unfinished.game.id),
               protocol::number(record.id), names[0], names[1],
               start == Start::resume ? ", goes on" : "");
  const auto live = std::make_shared<LiveGame>(std::move(*game), card, services_, start);
  join_pair(match, live);
  outside_.launch(live);
  for (const Seat seat : both_seats) {
    if (record.tournament &&
        outside_.has_left(*record.tournament, live->record().agents[rules::index(seat)])) {
      live->leave(seat);
    }
  }
}

void Matches::join_pair(LiveMatch& match, const std::shared_ptr<LiveGame>& game) {
  const auto partner = match.partner.lock();
  const auto shared_from = game->record().shared_from;
  if (!shared_from) {
    return;
  }
  match.partner = game;
  if (partner == nullptr || partner->record().shared_from != shared_from ||
      partner->record().over) {
    return;
  }
  const bool is_first = game->record().id == *shared_from;
  const auto& first = is_first ? game : partner;
  const auto& second = is_first ? partner : game;
  const auto noise = std::make_shared<SharedNoise>(
      std::array{first->game().shots(), second->game().shots()}, services_.deadlines);
  first->join_pair({noise, PairSide::first, nullptr});
  second->join_pair({noise, PairSide::second, first});
}

void Matches::game_over(const LiveGame& live) {
  const storage::GameRecord& game = live.record();
  const auto found = matches_.find(game.match);
  if (found == matches_.end()) {
    return;
  }
  LiveMatch& match = found->second;
  --match.going_on;
  match.games.push_back(game);
  if (const auto outcome = ledger::scored_game(match.record, game)) {
    outside_.on_game_over(match.record, *outcome);
  }
  begin_next(match);
}

void Matches::finish(LiveMatch& match) {
  match.finishing = true;  // nothing begins any more
  match.record = match::finished(match.record, storage::unix_now());
  const MatchId id = match.record.id;
  post([record =
            match.record](storage::Database& database) { return database.update_match(record); },
       [this, id] {
         const LiveMatch over = std::move(matches_.extract(id).mapped());
         outside_.tell_over(over.record, over.games);
         outside_.on_match_over(over.record, outcomes(over));
       },
       fmt::format("the end of match {}", protocol::number(id)));
}

// Goes on trying while the database takes nothing.
void Matches::post(storage::Writer::Work work, std::function<void()> then, std::string what) {
  const auto posted =
      services_.writer.post(work, [then, what](const storage::Expected<void>& stored) {
        if (stored) {
          then();
        } else {
          spdlog::error("{} cannot be stored: {}", what, stored.error().reason);
        }
      });
  if (posted == storage::Posted::full) {
    auto timer = std::make_shared<boost::asio::steady_timer>(services_.io, store_retry);
    timer->async_wait([this, timer, work = std::move(work), then = std::move(then),
                       what = std::move(what)](const boost::system::error_code& error) mutable {
      if (!error) {
        post(std::move(work), std::move(then), std::move(what));
      }
    });
  }
}

std::optional<MatchId> Matches::find(const std::string& tournament, std::uint32_t pairing) const {
  for (const auto& [id, match] : matches_) {
    if (match.record.tournament == tournament && match.record.pairing == pairing) {
      return id;
    }
  }
  return std::nullopt;
}

std::vector<MatchOutcome> Matches::unfinished(const std::string& tournament) const {
  std::vector<MatchOutcome> unfinished;
  for (const auto& [id, match] : matches_) {
    if (match.record.tournament == tournament && match.record.pairing) {
      unfinished.push_back({tournament, *match.record.pairing, id, outcomes(match)});
    }
  }
  return unfinished;
}

std::optional<std::string> Matches::tournament_of(MatchId match) const {
  const auto found = matches_.find(match);
  return found == matches_.end() ? std::nullopt : found->second.record.tournament;
}

std::vector<MatchId> Matches::challenges() const {
  std::vector<MatchId> ids;
  for (const auto& [id, match] : matches_) {
    if (!match.record.tournament) {
      ids.push_back(id);
    }
  }
  return ids;
}

}  // namespace poolhall::net
