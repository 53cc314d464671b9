// One stored game, turn by turn, against what it should be.
//
//   GameCheck check(game, {match, pair});
//   if (auto difference = check.beginning()) ...
//   for each turn: if (auto difference = check.turn(row)) ...
//   if (auto difference = check.end()) ...
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "rules/game_state.hpp"
#include "server/match/clock.hpp"
#include "server/match/fair_noise.hpp"
#include "server/match/play_shot.hpp"
#include "server/match/verify.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

class GameCheck {
 public:
  using Finding = std::optional<Difference>;

  // What a game's row and noise depend on beside itself.
  struct Around {
    std::optional<storage::MatchRecord> match{};
    std::optional<storage::GameRecord> shared_from{};  // with mirrored noise
  };

  GameCheck(const storage::GameRecord& game, Around around);

  // The game's own row; the turns can be checked only if there is no difference here.
  [[nodiscard]] Finding beginning();
  // The next turn; nothing can be checked after a difference.
  [[nodiscard]] Finding turn(const storage::TurnRecord& row);
  // What the game's row says of its end.
  [[nodiscard]] Finding end() const;

  [[nodiscard]] std::uint32_t turns() const { return turns_; }
  [[nodiscard]] std::uint64_t shots_played_again() const { return shots_played_again_; }
  [[nodiscard]] std::uint64_t other_version() const { return other_version_; }

 private:
  [[nodiscard]] Difference differs(std::string field, std::string reason) const;
  template <class T>
  [[nodiscard]] Finding compare(const char* field, const T& stored, const T& expected) const;
  template <class Five>
  [[nodiscard]] Finding compare_each(const std::string& field, const Five& stored,
                                     const Five& expected) const;
  [[nodiscard]] Finding compare_rows(const storage::TurnRecord& stored,
                                     const storage::TurnRecord& again) const;
  [[nodiscard]] Finding place_in_match() const;
  [[nodiscard]] Finding noise() const;
  [[nodiscard]] Finding agents_parts() const;
  [[nodiscard]] Finding first_state();
  [[nodiscard]] Finding place_in_game(const storage::TurnRecord& row) const;
  [[nodiscard]] Finding clock(const storage::TurnRecord& row, rules::Seat mover) const;
  [[nodiscard]] Finding outcome(const storage::TurnRecord& row);
  [[nodiscard]] Finding shot(const storage::TurnRecord& row);
  [[nodiscard]] Finding shot_of_other_physics(const storage::TurnRecord& row);
  [[nodiscard]] Finding lost_turn(const storage::TurnRecord& row);
  [[nodiscard]] Finding decision(const storage::TurnRecord& row);
  [[nodiscard]] Finding ending(const storage::TurnRecord& row);
  [[nodiscard]] Finding of_other_rules(const storage::TurnRecord& row);

  const storage::GameRecord& game_;
  Around around_;
  GameKey key_{};  // mixed
  std::shared_ptr<const Board> board_;
  rules::GameState state_;
  std::string state_json_;
  GameClock::Balance balance_;
  storage::Digest head_{};
  storage::UnixMicros last_stored_{};
  std::array<std::uint32_t, 2> shots_{};
  std::uint32_t turns_ = 0;
  std::uint64_t shots_played_again_ = 0;
  std::uint64_t other_version_ = 0;
};

}  // namespace poolhall::match
