// Identities as they stand on the wire, each a type of its own, so that a match cannot be taken
// for a game.
//
//   GameId game{17};
//   std::int64_t row = number(game);
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace poolhall::protocol {

enum class GameId : std::int64_t {};
enum class MatchId : std::int64_t {};
enum class TournamentId : std::int64_t {};
enum class ChallengeId : std::int64_t {};

[[nodiscard]] constexpr std::int64_t number(GameId id) {
  return static_cast<std::int64_t>(id);
}
[[nodiscard]] constexpr std::int64_t number(MatchId id) {
  return static_cast<std::int64_t>(id);
}
[[nodiscard]] constexpr std::int64_t number(TournamentId id) {
  return static_cast<std::int64_t>(id);
}
[[nodiscard]] constexpr std::int64_t number(ChallengeId id) {
  return static_cast<std::int64_t>(id);
}

// What an agent calls one of its shots: canonical JSON text of a string of 1..64 characters or of
// an integer, so that 7 and "7" stay two ids.
struct ShotId {
  std::string json;

  friend auto operator<=>(const ShotId&, const ShotId&) = default;
};

// The `id` of a JSON-RPC request: canonical JSON text of a number, a string or null.
struct RequestId {
  std::string json = "null";

  friend auto operator<=>(const RequestId&, const RequestId&) = default;
};

}  // namespace poolhall::protocol
