#include "server/net/tournaments.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

constexpr std::chrono::milliseconds start_retry{200};

storage::TermsRecord record_of(const GameTerms& terms, const protocol::Limits& limits) {
  storage::TermsRecord record;
  record.rules = terms.rules;
  record.table = terms.table;
  record.materials = terms.materials;
  record.noise = terms.noise;
  record.noise_hidden = terms.noise_hidden;
  record.rack_gap = terms.rack_gap;
  record.rack_jitter = terms.rack_jitter;
  record.clock = terms.clock;
  record.increment = terms.increment;
  record.shot_cap = terms.shot_cap;
  record.max_refusals = terms.max_refusals;
  record.lag_per_turn = limits.lag_credit_per_turn;
  record.lag_per_game = limits.lag_credit_per_game;
  return record;
}

}  // namespace

Tournaments::Tournaments(GameServices& services, Matches& matches, Untold& untold,
                         storage::Counters& ids, Outside outside)
    : services_(services),
      matches_(matches),
      untold_(untold),
      ids_(ids),
      house_(std::move(outside.house)),
      stand_in_(std::move(outside.stand_in)),
      forfeit_games_(std::move(outside.forfeit_games)) {}

storage::Expected<void> Tournaments::restore(storage::Reader& reader, StoredTournaments which) {
  const auto records = reader.tournaments();
  if (!records) {
    return tl::unexpected(records.error());
  }
  for (const storage::TournamentRecord& record : *records) {
    Tournament& tournament = keep(record);
    if (auto restored = restore_entries(reader, tournament); !restored) {
      return restored;
    }
    // Nobody orders a match of history again: a start reads no more of it than its name.
    if (which == StoredTournaments::taken_up && has_ended(record.status)) {
      continue;
    }
    if (auto restored = restore_results(reader, tournament); !restored) {
      return restored;
    }
  }
  return {};
}

storage::Expected<void> Tournaments::restore_entries(storage::Reader& reader,
                                                     Tournament& tournament) {
  auto entries = reader.entries(tournament.record.id);
  if (!entries) {
    return tl::unexpected(entries.error());
  }
  tournament.entered = std::move(*entries);
  return {};
}

storage::Expected<void> Tournaments::restore_results(storage::Reader& reader,
                                                     Tournament& tournament) {
  const std::string& id = tournament.record.id;
  const auto matches = reader.matches_of(id);
  if (!matches) {
    return tl::unexpected(matches.error());
  }
  for (const storage::MatchRecord& match : *matches) {
    if (!match.over || !match.pairing) {
      continue;
    }
    const auto games = reader.games_of(match.id);
    if (!games) {
      return tl::unexpected(games.error());
    }
    MatchOutcome outcome{id, *match.pairing, match.id, {}};
    for (const storage::GameRecord& game : *games) {
      if (const auto scored = ledger::scored_game(match, game)) {
        outcome.games.push_back(*scored);
      }
    }
    std::sort(outcome.games.begin(), outcome.games.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    tournament.finished.emplace(*match.pairing, std::move(outcome));
  }
  return {};
}

Tournaments::Tournament& Tournaments::keep(const storage::TournamentRecord& record) {
  Tournament& tournament = tournaments_[record.id];
  tournament.record = record;
  tournament.listing.tournament = record.wire_id;
  tournament.listing.name = record.id;
  tournament.listing.format = "round_robin";
  if (const auto settings = settings::parse_tournament(record.settings, record.id)) {
    tournament.listing.rules = settings->rules;
    tournament.listing.format = settings->format;
    tournament.joining = settings->join;
  }
  return tournament;
}

TournamentCard Tournaments::open_tournament(const TournamentCard& card) {
  const auto found = tournaments_.find(card.id);
  if (found != tournaments_.end()) {
    const storage::TournamentRecord& known = found->second.record;
    return {known.id, known.title, known.settings, known.status};
  }
  storage::TournamentRecord record;
  record.id = card.id;
  record.wire_id = ids_.tournament;
  ids_.tournament = protocol::TournamentId{protocol::number(ids_.tournament) + 1};
  record.title = card.title;
  record.settings = card.settings;
  record.status = card.status;
  record.created = storage::unix_now();
  keep(record);
  store([record](storage::Database& database) { return database.add_tournament(record); },
        "tournament " + record.id);
  return card;
}

void Tournaments::set_status(const std::string& tournament, TournamentStatus status) {
  const auto found = tournaments_.find(tournament);
  if (found == tournaments_.end() || found->second.record.status == status) {
    return;
  }
  found->second.record.status = status;
  store(
      [tournament, status](storage::Database& database) {
        return database.set_tournament_status(tournament, status);
      },
      "the status of tournament " + tournament);
}

std::vector<TournamentCard> Tournaments::tournaments() const {
  std::vector<TournamentCard> cards;
  for (const auto& [id, tournament] : tournaments_) {
    const storage::TournamentRecord& record = tournament.record;
    cards.push_back({record.id, record.title, record.settings, record.status});
  }
  return cards;
}

void Tournaments::start_match(const MatchOrder& order) {
  const auto found = tournaments_.find(order.tournament);
  if (found == tournaments_.end()) {
    spdlog::error("pairing {}: there is no tournament {}", order.pairing, order.tournament);
    return;
  }
  const OrderKey key{order.tournament, order.pairing};
  orders_[key] = order;
  const auto finished = found->second.finished.find(order.pairing);
  if (finished != found->second.finished.end()) {
    boost::asio::post(services_.io, [this, outcome = finished->second] {
      if (on_match_over_) {
        on_match_over_(outcome);
      }
    });
    return;
  }
  if (const auto match = matches_.find(order.tournament, order.pairing)) {
    matches_.go_on(*match);
    return;
  }
  const Agent* first = services_.book.named(order.agents[0]);
  const Agent* second = services_.book.named(order.agents[1]);
  if (first == nullptr || second == nullptr) {
    await_agents(key, order);
    return;
  }
  awaited_until_.erase(key);
  begin(order, {first->id(), second->id()});
}

void Tournaments::cancel_match(const std::string& tournament, std::uint32_t pairing) {
  const OrderKey key{tournament, pairing};
  orders_.erase(key);
  awaited_orders_.erase(key);
  awaited_until_.erase(key);
}

void Tournaments::await_agents(const OrderKey& key, const MatchOrder& order) {
  awaited_orders_[key] = order;
  Deadline& until = awaited_until_[key];
  if (!until.is_set()) {
    until =
        services_.deadlines.at(std::chrono::steady_clock::now() + services_.limits.entry_deadline,
                               [this, key] { waited_enough(key); });
  }
}

// Who has never registered is played without: the games are forfeited unless somebody comes yet.
void Tournaments::waited_enough(const OrderKey& key) {
  const auto found = awaited_orders_.find(key);
  if (found == awaited_orders_.end()) {
    return;
  }
  for (const std::string& name : found->second.agents) {
    if (services_.book.named(name) == nullptr) {
      spdlog::warn("tournament {}: {} has not registered, pairing {} begins without", key.first,
                   name, key.second);
      stand_in_(name);
    }
  }
  agent_enrolled();
}

void Tournaments::begin(const MatchOrder& order, const std::array<storage::AgentId, 2>& agents) {
  MatchPlan plan;
  plan.agents = agents;
  plan.games = order.games;
  plan.terms = record_of(order.terms, services_.limits);
  plan.seed = order.seed;
  plan.tournament = order.tournament;
  plan.pairing = order.pairing;
  plan.mirrored = order.mirrored;
  matches_.start(plan, [this, order](const protocol::Expected<MatchId>& started) {
    if (started) {
      return;
    }
    spdlog::error("tournament {}, pairing {}: {}", order.tournament, order.pairing,
                  started.error().reason);
    if (started.error().code == ErrorCode::paused) {
      auto timer = std::make_shared<boost::asio::steady_timer>(services_.io, start_retry);
      timer->async_wait([this, timer, order](const boost::system::error_code& error) {
        if (!error && orders_.contains({order.tournament, order.pairing})) {
          start_match(order);
        }
      });
    }
  });
}

std::vector<MatchOutcome> Tournaments::finished_matches(const std::string& tournament) const {
  std::vector<MatchOutcome> outcomes;
  const auto found = tournaments_.find(tournament);
  if (found != tournaments_.end()) {
    for (const auto& [pairing, outcome] : found->second.finished) {
      outcomes.push_back(outcome);
    }
  }
  return outcomes;
}

std::vector<MatchOutcome> Tournaments::unfinished_matches(const std::string& tournament) const {
  return matches_.unfinished(tournament);
}

void Tournaments::on_match_over(std::function<void(const MatchOutcome&)> callback) {
  on_match_over_ = std::move(callback);
}

void Tournaments::on_game_over(
    std::function<void(const MatchOrder&, const GameOutcome&)> callback) {
  on_game_over_ = std::move(callback);
}

void Tournaments::game_over(const storage::MatchRecord& match, const GameOutcome& outcome) {
  if (!match.tournament || !on_game_over_) {
    return;
  }
  const auto order = orders_.find({*match.tournament, match.pairing.value_or(0)});
  if (order != orders_.end()) {
    on_game_over_(order->second, outcome);
  }
}

void Tournaments::match_over(const storage::MatchRecord& match,
                             const std::vector<GameOutcome>& games) {
  if (!match.tournament) {
    return;
  }
  const auto found = tournaments_.find(*match.tournament);
  if (found == tournaments_.end()) {
    return;
  }
  const MatchOutcome outcome{*match.tournament, match.pairing.value_or(0), match.id, games};
  found->second.finished[outcome.pairing] = outcome;
  if (on_match_over_) {
    on_match_over_(outcome);
  }
}

void Tournaments::store(storage::Writer::Work work, std::string what) {
  const auto posted =
      services_.writer.post(std::move(work), [what](const storage::Expected<void>& stored) {
        if (!stored) {
          spdlog::error("{} cannot be stored: {}", what, stored.error().reason);
        }
      });
  if (posted != storage::Posted::accepted) {
    spdlog::error("{} cannot be stored: the database takes nothing", what);
  }
}

std::optional<protocol::TournamentId> Tournaments::wire_id(const std::string& id) const {
  const auto found = tournaments_.find(id);
  if (found == tournaments_.end()) {
    return std::nullopt;
  }
  return found->second.record.wire_id;
}

}  // namespace poolhall::net
