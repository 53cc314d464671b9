// What a check says of a bot, and how a script ends early.
//
//   throw Stop{Verdict::failure, "no answer to turn 3 within 10 s"};
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace poolhall::conformance {

enum class Verdict : std::uint8_t {
  pass,
  warning,      // against no demand of the page, but it will cost games
  failure,      // against a demand of the page
  not_reached,  // the bot never came to where this shows
};
// "PASS", "WARN", "FAIL", "NOT REACHED".
[[nodiscard]] std::string_view name(Verdict verdict);

struct Outcome {
  Verdict verdict = Verdict::not_reached;
  std::string why{};                 // one line; empty where all is well
  std::vector<std::string> lines{};  // what was said before, "> " the bot, "< " the server
};

// Ends a script; what it says holds for the check that runs.
struct Stop {
  Verdict verdict = Verdict::failure;
  std::string why;
};

}  // namespace poolhall::conformance
