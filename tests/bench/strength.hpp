// How strong one house bot is against another: games in pairs of the same rack, each breaking once,
// inside one process, with clocks on the wall.
//
//   StrengthReport report = play_strength({.one = "planner", .other = "greedy", .games = 200});
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "clients/bots/exhibition.hpp"

namespace poolhall::bench {

struct StrengthOptions {
  std::string one = "planner";
  std::string other = "greedy";
  std::uint32_t games = 200;  // an even number
  double clock = 20;          // s, of each player in a game; 0: none runs
  std::string noise = "olympiad";
  std::string table = "olympiad";
  std::string materials = "olympiad";
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::optional<std::uint64_t> effort{};  // of `one`; unset: what its clock allows
  unsigned cores = 1;                     // of `one`, a move
  unsigned at_once = 1;                   // games
  std::uint64_t seed = 1;
  bool hides_noise = false;
};

// Of one player over all games.
struct StrengthSums {
  std::uint32_t wins = 0;
  std::uint32_t breaks = 0;
  std::uint32_t broken_and_run = 0;
  std::uint32_t won_breaking = 0;
  std::uint32_t shots = 0;
  std::uint32_t pots = 0;
  std::uint32_t fouls = 0;
  std::uint32_t refused = 0;
  std::uint32_t visits = 0;
  std::uint32_t timeouts = 0;
  double seconds = 0;                             // thought, in all games
  double longest_game = 0;                        // s
  double longest_move = 0;                        // s
  std::map<std::string, std::uint32_t> won_by{};  // reasons
};

struct StrengthReport {
  std::uint32_t games = 0;
  std::uint32_t draws = 0;
  std::array<StrengthSums, 2> players{};  // one, other
  double score = 0;                       // of `one`, a draw a half
  double low = 0;                         // 95 % interval of it, over pairs
  double high = 0;
};

// Throws std::runtime_error for a bot, table or noise that there is not, and if a game is void.
[[nodiscard]] StrengthReport play_strength(const StrengthOptions& options, std::ostream* progress);

bool bench_strength(const StrengthOptions& options, std::ostream& out);

}  // namespace poolhall::bench
