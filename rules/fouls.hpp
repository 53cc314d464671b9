// The fouls of a shot that all games know, from its facts and the duties that the game lays on it.
//
//   FoulReport report = standard_fouls(ready, facts, {.first_balls = mine}, table);
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rules/clause.hpp"
#include "rules/shot_facts.hpp"

namespace poolhall::rules {

// What a shot must do.
struct Duties {
  std::vector<BallId> first_balls;  // one of these first
  bool strike_a_ball = true;
  bool right_ball_first = true;
  bool rail_after_contact = true;
};

struct FoulReport {
  std::vector<FoulRecord> fouls;
  std::optional<BallId> first_contact{};
  std::vector<Finding> notes;
};

[[nodiscard]] FoulReport standard_fouls(const GameState& ready, const ShotFacts& facts,
                                        const Duties& duties, const physics::Table& table);

// The foul of a break that neither pockets an object ball nor drives four to a rail; `rule` is
// where the game's own rules say so.
[[nodiscard]] std::optional<FoulRecord> illegal_break(const ShotFacts& facts,
                                                      std::string_view rule);

[[nodiscard]] FoulRecord foul(FoulCode code, const Clause& clause, const std::string& detail,
                              std::optional<std::size_t> event = std::nullopt);
[[nodiscard]] Finding finding(const Clause& clause,
                              std::optional<std::size_t> event = std::nullopt);

// A clause in words of the moment.
[[nodiscard]] Finding said(const Clause& clause, std::string text);

// "the 8", "the cue ball".
[[nodiscard]] std::string ball_words(BallId ball);
// "the 1, the 4 and the 7".
[[nodiscard]] std::string ball_words(const std::vector<BallId>& balls);

}  // namespace poolhall::rules
