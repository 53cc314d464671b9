// What was said in one session with a bot, and when: the evidence beside a verdict.
//
//   transcript.bot(line);  transcript.server(line);  transcript.note("the bot ended with code 1");
//   std::vector<std::string> last = transcript.tail(8);
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace poolhall::conformance {

class Transcript {
 public:
  void bot(std::string_view line) { add("> ", line); }
  void server(std::string_view line) { add("< ", line); }
  void note(std::string_view text) { add("# ", text); }

  // The last `count` lines, long ones cut short, each with the seconds since the beginning.
  [[nodiscard]] std::vector<std::string> tail(std::size_t count) const;

 private:
  void add(std::string_view mark, std::string_view line);

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::deque<std::string> lines_;
};

}  // namespace poolhall::conformance
