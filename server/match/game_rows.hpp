// What a game's rows say before, between and after its turns: the new game's row, the finished
// game's row, and whether a request is the one that a stored turn came from.
//
//   storage::GameRecord record = new_game_record(order).value();
//   if (auto error = repeated_shot(row, seat, request)) refuse(*error); else answer_again(row);
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "protocol/errors.hpp"
#include "protocol/messages.hpp"
#include "server/match/fair_noise.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

using rules::Seat;

struct GameOrder {
  protocol::GameId id{};
  protocol::MatchId match{};
  std::uint32_t number = 0;
  std::uint32_t attempt = 0;
  std::array<storage::AgentId, 2> agents{};  // by seat
  storage::TermsRecord terms;
  Seat breaker = Seat::first;
  std::uint64_t rack_seed = 0;
  GameKey key{};
  storage::UnixMicros created{};
  std::array<std::optional<storage::Digest>, 2> agent_commitments{};  // by seat
  std::optional<protocol::GameId> shared_from{};                      // with mirrored noise
};

// A game's row before its first turn, noise, commitment, rack and seal included; or why the terms
// cannot be played.
[[nodiscard]] tl::expected<storage::GameRecord, std::string> new_game_record(
    const GameOrder& order);

// The match's row once it is over.
[[nodiscard]] storage::MatchRecord finished(storage::MatchRecord match, storage::UnixMicros when);

// The game's row once `last`, which has a result, is its last turn.
[[nodiscard]] storage::GameRecord finished(storage::GameRecord game,
                                           const storage::TurnRecord& last);

// Whether a turn was played (or lost) rather than the game ended from outside: it earns the
// increment.
[[nodiscard]] bool is_played(storage::TurnAction action);

// Compares a request with the row of its turn: nothing if it is the same request with the same
// content, so that the row is its answer; else conflicting_shot, conflicting_request or
// stale_turn.
[[nodiscard]] std::optional<protocol::Error> repeated_shot(const storage::TurnRecord& row, Seat by,
                                                           const protocol::Shot& shot);
[[nodiscard]] std::optional<protocol::Error> repeated_decision(const storage::TurnRecord& row,
                                                               Seat by,
                                                               const protocol::Decide& decide);

}  // namespace poolhall::match
