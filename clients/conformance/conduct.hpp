// What is demanded of a bot all the time, whatever is played at it: watched in every session.
//
//   conduct.seen(duties::valid_requests);
//   conduct.broke(duties::valid_requests, Verdict::failure, "no JSON", transcript.tail(6));
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "clients/conformance/verdict.hpp"

namespace poolhall::conformance {

// A check as the list has it.
struct CheckInfo {
  std::string_view name;
  std::string_view demand;
  std::string_view section;  // of protocol/README.md
};

namespace duties {
inline constexpr std::string_view valid_requests = "valid-requests";
inline constexpr std::string_view line_length = "line-length";
inline constexpr std::string_view hello_first = "hello-first";
inline constexpr std::string_view one_content_per_key = "one-content-per-key";
inline constexpr std::string_view answers_fit_turns = "answers-fit-turns";
inline constexpr std::string_view cue_ball_as_told = "cue-ball-as-told";
inline constexpr std::string_view calls_offered = "calls-offered";
inline constexpr std::string_view decisions_offered = "decisions-offered";
inline constexpr std::string_view playable_strokes = "playable-strokes";
inline constexpr std::string_view lag_echo = "lag-echo";
inline constexpr std::string_view reveals_fit = "reveals-fit";
}  // namespace duties

struct StandingCheck {
  CheckInfo info;
  std::vector<std::string_view> occasions;  // scripts in which it shows, for a run of this alone
};
[[nodiscard]] const std::vector<StandingCheck>& standing_checks();

class Conduct {
 public:
  // The occasion came.
  void seen(std::string_view duty);
  // The worst and of these the first is kept.
  void broke(std::string_view duty, Verdict verdict, std::string why,
             std::vector<std::string> lines);
  // What another session saw.
  void add(const Conduct& other);

  [[nodiscard]] Outcome outcome(std::string_view duty) const;

 private:
  void note(std::string_view duty, Outcome outcome);

  std::map<std::string, Outcome, std::less<>> outcomes_;
};

}  // namespace poolhall::conformance
