// A call to argue about, as one JSON document: what `poolhall judge` reads and prints.
//
//   Expected<std::string> answer = judge_document(text);   // {"ruling": {...}, "state": {...}}
//
// The document: {"state": {...}, "call"?, "cue_ball"?: {x, y}, and one of
//   "events": [...]     the shot's log
//   "shot": {a, b, theta, phi, v}   simulated first; the answer then has "events" too
//   "decision": name    instead of a shot
//   "lost_turn": foul   "shot_time_exceeded" or "too_many_refusals"
// "table"? and "physics"?: as in a scene file, "olympiad" by default}. A state as agents have it;
// what it may leave out: settings, counters, options, result, the open table.
#pragma once

#include <string>
#include <string_view>

#include "protocol/errors.hpp"

namespace poolhall::protocol {

// The ruling (for a shot and a lost turn) and the next state, or what is wrong, with its field.
[[nodiscard]] Expected<std::string> judge_document(std::string_view text);

}  // namespace poolhall::protocol
