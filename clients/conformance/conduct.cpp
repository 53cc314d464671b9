#include "clients/conformance/conduct.hpp"

#include <utility>

namespace poolhall::conformance {
namespace {

const std::vector<StandingCheck> standing{
    {{duties::valid_requests,
      "every line is a JSON-RPC 2.0 request of the page, with the parameters that it names",
      "Lines"},
     {"plays-8-ball", "lost-reply"}},
    {{duties::line_length,
      "no line is longer than limits.line_bytes, or line_bytes_before_login before the login",
      "Lines"},
     {"plays-8-ball"}},
    {{duties::hello_first,
      "each connection begins with one hello, then login or register, then the rest", "A session"},
     {"plays-8-ball", "lost-reply"}},
    {{duties::one_content_per_key,
      "the same game, turn and shot_id are never sent with another content", "Requests"},
     {"repeated-turn", "lost-answer"}},
    {{duties::answers_fit_turns,
      "shot and decide only for turns that the bot was told, and each for its kind of turn",
      "A session"},
     {"two-games", "decide-illegal-break", "opponent-shot"}},
    {{duties::cue_ball_as_told,
      "cue_ball where the turn's kind asks for it, behind the head string where it says so, and "
      "nowhere else",
      "A turn"},
     {"ball-in-hand-kitchen", "8-ball-break", "open-table", "passed-break"}},
    {{duties::calls_offered, "a call of a kind in legal.calls, of a ball in legal.balls", "A turn"},
     {"8-ball-break", "open-table", "own-group-cleared"}},
    {{duties::decisions_offered, "a decision of legal.decisions", "A turn"},
     {"decide-illegal-break", "decide-foul-on-break", "decide-8-on-break"}},
    {{duties::playable_strokes,
      "strokes and places of the cue ball are possible (the third refusal of a turn is a foul)",
      "A turn"},
     {"8-ball-break", "frozen-to-rail", "ball-in-hand-crowded"}},
    {{duties::lag_echo, "lag, if it is answered, comes back with the t of a probe", "A turn"},
     {"lag-probes"}},
    {{duties::reveals_fit,
      "game.reveal, if it is sent, comes after game.start has shown the commitment and has its "
      "bytes",
      "Fair noise"},
     {"plays-8-ball", "lost-commitment"}},
};

int weight(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_reached:
      return 0;
    case Verdict::pass:
      return 1;
    case Verdict::warning:
      return 2;
    case Verdict::failure:
      return 3;
  }
  return 0;
}

}  // namespace

const std::vector<StandingCheck>& standing_checks() {
  return standing;
}

void Conduct::note(std::string_view duty, Outcome outcome) {
  const auto known = outcomes_.find(duty);
  if (known == outcomes_.end()) {
    outcomes_.emplace(std::string(duty), std::move(outcome));
  } else if (weight(outcome.verdict) > weight(known->second.verdict)) {
    known->second = std::move(outcome);
  }
}

void Conduct::seen(std::string_view duty) {
  note(duty, {Verdict::pass, {}, {}});
}

void Conduct::broke(std::string_view duty, Verdict verdict, std::string why,
                    std::vector<std::string> lines) {
  note(duty, {verdict, std::move(why), std::move(lines)});
}

void Conduct::add(const Conduct& other) {
  for (const auto& [duty, outcome] : other.outcomes_) {
    note(duty, outcome);
  }
}

Outcome Conduct::outcome(std::string_view duty) const {
  const auto found = outcomes_.find(duty);
  return found == outcomes_.end() ? Outcome{} : found->second;
}

}  // namespace poolhall::conformance
