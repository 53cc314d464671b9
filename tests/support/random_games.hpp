// Whole games between two random players, with everything checked that must hold of every game:
// it ends, the balls add up, no impossible state comes about, a ruling is the same when it is
// recomputed from the stored log, and mirrored events give the mirrored ruling.
//
//   GamesReport report = play_random_games({.rules = RuleSet::nine_ball, .games = 100});
//   EXPECT_TRUE(report.broken.empty()) << report.broken.front();
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rules/game_state.hpp"

namespace poolhall::test_support {

struct GamesPlan {
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::size_t games = 10;
  std::uint64_t seed = 1;
  std::string table = "olympiad";
  std::string materials = "olympiad";
  // Every how many shots the stored form of log and state is read back and judged again.
  std::size_t stored_every = 16;
};

struct GamesReport {
  std::size_t games = 0;
  std::size_t turns = 0;
  std::size_t shots = 0;
  std::size_t rejudged_from_store = 0;
  std::size_t longest = 0;                   // turns of the longest game
  std::map<std::string, std::size_t> ends;   // games by the reason of their end
  std::map<std::string, std::size_t> fouls;  // shots and lost turns by foul
  std::vector<std::string> broken;           // what did not hold: seed, turn and why; at most 20
};

[[nodiscard]] GamesReport play_random_games(const GamesPlan& plan);

}  // namespace poolhall::test_support
