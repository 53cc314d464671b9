#include "server/match/game_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/version.hpp"
#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"
#include "rules/version.hpp"
#include "server/match/chain.hpp"
#include "server/match/fair_noise.hpp"
#include "server/match/game_rows.hpp"

namespace poolhall::match {
namespace {

using storage::TurnAction;
using storage::TurnRecord;

std::string shown(const storage::Digest& digest) {
  return to_hex(digest);
}
std::string shown(const std::optional<rules::GameResult>& result) {
  if (!result)
    return "no result";
  const std::string winner =
      result->winner ? "seat " + std::to_string(index(*result->winner)) : "nobody";
  return winner + " by " + std::string(rules::name(result->reason));
}
std::string shown(rules::Seat seat) {
  return std::to_string(index(seat));
}
std::string shown(storage::UnixMicros t) {
  return std::to_string(number(t));
}
std::string shown(storage::Micros t) {
  return std::to_string(t.count());
}
std::string shown(std::uint32_t n) {
  return std::to_string(n);
}
std::string shown(std::uint64_t n) {
  return std::to_string(n);
}
std::string shown(bool flag) {
  return flag ? "1" : "0";
}
std::string shown(const std::optional<std::string>& text) {
  return text ? *text : "null";
}

// Two texts from their first difference on.
std::string first_difference(const std::string& stored, const std::string& expected) {
  const auto [s, e] = std::mismatch(stored.begin(), stored.end(), expected.begin(), expected.end());
  const auto at = static_cast<std::size_t>(s - stored.begin());
  constexpr std::size_t before = 12;
  constexpr std::size_t length = 48;
  const std::size_t from = at < before ? 0 : at - before;
  const auto part = [&](const std::string& text) {
    return from < text.size() ? text.substr(from, length) : std::string("its end");
  };
  return fmt::format("from character {} on: stored {}, expected {}", from, part(stored),
                     part(expected));
}

template <class T>
std::string difference_of(const T& stored, const T& expected) {
  return "stored " + shown(stored) + ", expected " + shown(expected);
}
std::string difference_of(const std::string& stored, const std::string& expected) {
  return first_difference(stored, expected);
}
std::string difference_of(const std::optional<std::string>& stored,
                          const std::optional<std::string>& expected) {
  if (stored && expected)
    return first_difference(*stored, *expected);
  return "stored " + shown(stored) + ", expected " + shown(expected);
}

}  // namespace

GameCheck::GameCheck(const storage::GameRecord& game, Around around)
    : game_(game), around_(std::move(around)) {}

Difference GameCheck::differs(std::string field, std::string reason) const {
  Difference difference{game_.id, std::nullopt, std::move(field), std::move(reason)};
  if (turns_ > 0)
    difference.turn = turns_;
  return difference;
}

template <class T>
GameCheck::Finding GameCheck::compare(const char* field, const T& stored, const T& expected) const {
  if (stored == expected)
    return std::nullopt;
  return differs(field, difference_of(stored, expected));
}

// A stroke's five numbers, or their standard deviations.
template <class Five>
GameCheck::Finding GameCheck::compare_each(const std::string& field, const Five& stored,
                                           const Five& expected) const {
  constexpr std::array<std::pair<const char*, double Five::*>, 5> columns{{{"_a", &Five::a},
                                                                           {"_b", &Five::b},
                                                                           {"_theta", &Five::theta},
                                                                           {"_phi", &Five::phi},
                                                                           {"_v", &Five::v}}};
  for (const auto& [column, member] : columns) {
    if (stored.*member != expected.*member)
      return differs(field + column,
                     fmt::format("stored {}, expected {}", stored.*member, expected.*member));
  }
  return std::nullopt;
}

GameCheck::Finding GameCheck::beginning() {
  board_ = preset_board(game_.terms.table, game_.terms.materials);
  if (!board_)
    return differs("table_name", "no such preset table or materials");
  for (const auto check : {&GameCheck::noise, &GameCheck::agents_parts}) {
    if (auto found = (this->*check)())
      return found;
  }
  if (auto found = first_state())
    return found;
  if (auto found = place_in_match())
    return found;
  if (auto found = compare("seal", game_.seal, seal(game_)))
    return found;
  const GameClock clock(clock_settings(game_.terms));
  balance_ = clock.balance();
  head_ = first_link(game_);
  key_ = mixed_key(game_.key, game_.agent_secrets);
  return std::nullopt;
}

GameCheck::Finding GameCheck::noise() const {
  const auto noise = game_noise(game_.terms.noise, game_.key, game_.id);
  if (!noise)
    return differs("noise", "no such noise track: " + game_.terms.noise);
  if (auto found = compare_each("noise", game_.noise, *noise))
    return found;
  const storage::Digest commitment = commit({.game = game_.id,
                                             .key = game_.key,
                                             .noise = game_.noise,
                                             .rack_seed = game_.rack_seed,
                                             .rack_gap = game_.terms.rack_gap,
                                             .rack_jitter = game_.terms.rack_jitter});
  return compare("commitment", game_.commitment, commitment);
}

GameCheck::Finding GameCheck::agents_parts() const {
  constexpr std::array<const char*, 2> secret_columns{"first_secret", "second_secret"};
  for (const std::size_t seat : {0U, 1U}) {
    const auto& secret = game_.agent_secrets[seat];
    const auto& commitment = game_.agent_commitments[seat];
    if (secret && !(commitment && is_committed(*commitment, *secret)))
      return differs(secret_columns[seat], "its SHA-256 is not what the agent had committed to");
  }
  if (!game_.shared_from)
    return std::nullopt;
  const bool is_pair = around_.shared_from && around_.shared_from->match == game_.match &&
                       around_.shared_from->number == game_.number / 2 * 2;
  return is_pair ? std::nullopt
                 : Finding(differs("shared_from", "is not the first game of this game's pair"));
}

GameCheck::Finding GameCheck::first_state() {
  const rules::GameSettings settings = game_.settings();
  if (auto checked = rules::check_settings(settings, board_->table, board_->materials); !checked)
    return differs("rules", checked.error().reason);
  state_ = rules::new_game(settings, board_->table, board_->materials);
  state_json_ = protocol::encode_state(state_);
  if (game_.rules_version == rules::version)
    return compare("initial_state", game_.initial_state, state_json_);
  auto stored = protocol::decode_state(game_.initial_state);
  if (!stored)
    return differs("initial_state", stored.error().reason);
  state_ = std::move(*stored);
  state_json_ = game_.initial_state;
  return std::nullopt;
}

// Its terms and its rack are the match's.
GameCheck::Finding GameCheck::place_in_match() const {
  if (!around_.match)
    return std::nullopt;
  const storage::MatchRecord& match = *around_.match;
  const std::array<storage::AgentId, 2> swapped{game_.agents[1], game_.agents[0]};
  if (game_.agents != match.agents && swapped != match.agents)
    return differs("first_agent", "the match's agents are others");
  if (!(game_.terms == match.terms))
    return differs("rules", "the terms differ from those of the match");
  if (!match.seal)
    return std::nullopt;  // written before a match's row said whether it is mirrored
  const std::uint64_t rack = rack_number(game_.number, game_.attempt, match.mirrored);
  return compare("rack_seed", game_.rack_seed, rack_seed(match.seed, rack));
}

GameCheck::Finding GameCheck::turn(const TurnRecord& row) {
  ++turns_;
  if (auto found = place_in_game(row))
    return found;
  const bool is_own_version =
      row.physics_version == physics::version && row.rules_version == rules::version;
  if (!is_own_version) {
    ++other_version_;
    if (auto found = compare("checksum", row.checksum, chained(head_, row)))
      return found;
  }
  const rules::Seat mover = state_.to_move;
  if (auto found = outcome(row))
    return found;
  if (auto found = clock(row, mover))
    return found;
  if (auto found = compare("checksum", row.checksum, chained(head_, row)))
    return found;
  head_ = row.checksum;
  state_json_ = row.state_after;
  balance_ = {.left = row.clock.left, .lag_left = row.clock.lag_left};
  last_stored_ = row.stored;
  return std::nullopt;
}

GameCheck::Finding GameCheck::place_in_game(const TurnRecord& row) const {
  if (state_.result)
    return differs("number", "a turn after the end of the game");
  if (auto found = compare("number", row.number, turns_))
    return found;
  const bool is_players_own = is_played(row.action) || row.action == TurnAction::timeout;
  if (is_players_own) {
    if (auto found = compare("seat", row.seat, state_.to_move))
      return found;
  }
  return compare("state_before", row.state_before, state_json_);
}

GameCheck::Finding GameCheck::outcome(const TurnRecord& row) {
  if (row.shot.has_value() != (row.action == TurnAction::shot))
    return differs("shot_index", "contradicts the turn's action");
  if (row.decision.has_value() != (row.action == TurnAction::decision))
    return differs("decision", "contradicts the turn's action");
  if (row.rules_version != rules::version)
    return of_other_rules(row);
  switch (row.action) {
    case TurnAction::shot:
      return row.physics_version == physics::version ? shot(row) : shot_of_other_physics(row);
    case TurnAction::lost_turn:
      return lost_turn(row);
    case TurnAction::decision:
      return decision(row);
    default:
      return ending(row);
  }
}

GameCheck::Finding GameCheck::shot(const TurnRecord& row) {
  std::uint32_t& shots = shots_[index(row.seat)];
  if (auto found = compare("shot_index", row.shot->index, ++shots))
    return found;
  ShotJob job{.board = board_,
              .state = state_,
              .noise = game_.noise,
              .key = key_,
              .index = {game_.id, row.seat, row.shot->index},
              .previous = head_,
              .row = row};
  if (row.shot->shared) {
    if (!around_.shared_from)
      return differs("shared", "the game shares its deviates with no other");
    const storage::GameRecord& first = *around_.shared_from;
    share_deviates(job, mixed_key(first.key, first.agent_secrets), first.id);
  }
  PlayOutcome outcome = play(job);
  if (const auto* error = std::get_if<protocol::Error>(&outcome))
    return differs("intended_a", "could not be played: " + error->field + ": " + error->reason);
  if (const auto* fault = std::get_if<ServerFault>(&outcome))
    return differs("events", fault->reason);
  PlayedTurn& again = std::get<PlayedTurn>(outcome);
  if (auto found = compare_rows(row, again.record))
    return found;
  state_ = std::move(again.next);
  ++shots_played_again_;
  return std::nullopt;
}

GameCheck::Finding GameCheck::compare_rows(const TurnRecord& stored,
                                           const TurnRecord& again) const {
  if (stored.shot) {
    if (auto found = compare_each("executed", stored.shot->executed, again.shot->executed))
      return found;
    if (auto found = compare("moved", stored.shot->moved, again.shot->moved))
      return found;
    if (auto found = compare("events", stored.shot->events, again.shot->events))
      return found;
  }
  if (auto found = compare("ruling", stored.ruling, again.ruling))
    return found;
  if (auto found = compare("state_after", stored.state_after, again.state_after))
    return found;
  return compare("reason", stored.result, again.result);
}

// The stored events are judged again; that they are what the parameters give cannot be checked.
GameCheck::Finding GameCheck::shot_of_other_physics(const TurnRecord& row) {
  std::uint32_t& shots = shots_[index(row.seat)];
  if (auto found = compare("shot_index", row.shot->index, ++shots))
    return found;
  const auto events = protocol::decode_events(row.shot->events);
  if (!events)
    return differs("events", events.error().field + ": " + events.error().reason);
  const auto ready = rules::prepare_shot(state_, row.shot->call, row.shot->cue_ball, board_->table,
                                         board_->materials);
  if (!ready)
    return differs("call_kind", ready.error().reason);
  auto ruling = rules::judge(*ready, row.shot->call, *events, board_->table, board_->materials);
  if (!ruling)
    return differs("events", ruling.error().reason);
  TurnRecord again = row;
  again.ruling = protocol::encode_ruling(*ruling);
  again.state_after = protocol::encode_state(ruling->next);
  again.result = ruling->next.result;
  state_ = std::move(ruling->next);
  return compare_rows(row, again);
}

GameCheck::Finding GameCheck::lost_turn(const TurnRecord& row) {
  const rules::FoulCode code = row.refusals >= game_.terms.max_refusals
                                   ? rules::FoulCode::too_many_refusals
                                   : rules::FoulCode::shot_time_exceeded;
  rules::Ruling ruling = rules::judge_lost_turn(state_, code, board_->table, board_->materials);
  TurnRecord again = row;
  again.ruling = protocol::encode_ruling(ruling);
  again.state_after = protocol::encode_state(ruling.next);
  again.result = ruling.next.result;
  state_ = std::move(ruling.next);
  return compare_rows(row, again);
}

GameCheck::Finding GameCheck::decision(const TurnRecord& row) {
  auto next = rules::decide(state_, *row.decision, board_->table, board_->materials);
  if (!next)
    return differs("decision", next.error().reason);
  TurnRecord again = row;
  again.ruling.reset();
  again.state_after = protocol::encode_state(*next);
  again.result = next->result;
  state_ = std::move(*next);
  return compare_rows(row, again);
}

GameCheck::Finding GameCheck::ending(const TurnRecord& row) {
  rules::GameResult result{other(row.seat), rules::EndReason::conceded};
  if (row.action == TurnAction::timeout)
    result.reason = rules::EndReason::timeout;
  else if (row.action == TurnAction::forfeit)
    result.reason = rules::EndReason::forfeit;
  else if (row.action == TurnAction::void_game)
    result = {std::nullopt, rules::EndReason::void_game};
  TurnRecord again = row;
  again.ruling.reset();
  state_ = rules::ended(state_, result);
  again.state_after = protocol::encode_state(state_);
  again.result = result;
  if (auto found = compare_rows(row, again))
    return found;
  if (row.action == TurnAction::timeout)
    return compare("first_left_us", row.clock.left[index(row.seat)], storage::Micros{0});
  return std::nullopt;
}

// Rulings of other rules are taken as they stand.
GameCheck::Finding GameCheck::of_other_rules(const TurnRecord& row) {
  if (row.shot)
    shots_[index(row.seat)] = row.shot->index;
  auto next = protocol::decode_state(row.state_after);
  if (!next)
    return differs("state_after", next.error().field + ": " + next.error().reason);
  state_ = std::move(*next);
  return std::nullopt;
}

GameCheck::Finding GameCheck::clock(const TurnRecord& row, rules::Seat mover) const {
  const ClockSettings settings = clock_settings(game_.terms);
  // Numbers that no turn can have must not reach the clock's arithmetic.
  constexpr std::chrono::hours longest{24 * 365};
  for (const auto& [column, time] :
       {std::pair{"used_us", row.clock.used}, std::pair{"forgiven_us", row.clock.forgiven}}) {
    if (time.count() < 0 || time > longest)
      return differs(column, "expected 0 to a year of microseconds, " +
                                 std::to_string(time.count()) + " is stored");
  }
  const TurnTime time{row.clock.used, row.clock.forgiven};
  const GameClock::Balance expected = is_played(row.action)
                                          ? after_turn(settings, balance_, mover, time)
                                          : after_charge(settings, balance_, mover, time);
  constexpr std::array<const char*, 2> left{"first_left_us", "second_left_us"};
  constexpr std::array<const char*, 2> lag_left{"first_lag_left_us", "second_lag_left_us"};
  for (std::size_t seat = 0; seat < 2; ++seat) {
    if (auto found = compare(left[seat], row.clock.left[seat], expected.left[seat]))
      return found;
    if (auto found = compare(lag_left[seat], row.clock.lag_left[seat], expected.lag_left[seat]))
      return found;
  }
  return std::nullopt;
}

GameCheck::Finding GameCheck::end() const {
  const auto differs_in_game = [&](const char* field, std::string reason) -> Finding {
    return Difference{game_.id, std::nullopt, field, std::move(reason)};
  };
  if (game_.over != state_.result.has_value())
    return differs_in_game(
        "over", game_.over ? "the last turn did not end the game" : "the last turn ended the game");
  if (!game_.over)
    return std::nullopt;
  if (game_.result != state_.result)
    return differs_in_game("reason", difference_of(game_.result, state_.result));
  if (game_.turns != turns_)
    return differs_in_game("turns", difference_of(game_.turns, turns_));
  if (game_.head != head_)
    return differs_in_game("head", difference_of(game_.head, head_));
  if (game_.finished != last_stored_)
    return differs_in_game("finished", "not the time of the last turn, " + shown(last_stored_));
  return std::nullopt;
}

}  // namespace poolhall::match
