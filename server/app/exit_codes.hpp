// What the sub-commands tell their shell; `poolhall verify` has codes of its own.
#pragma once

namespace poolhall::app {

inline constexpr int done = 0;
inline constexpr int failed = 1;
inline constexpr int wrong_input = 2;
inline constexpr int incomplete = 3;  // the run ended before its end: event limit, games left over

}  // namespace poolhall::app
