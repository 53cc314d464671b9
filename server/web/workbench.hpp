// The workbench's physics: scenes that people set up, run here. Pure functions for worker threads.
//
//   Page done = simulate_page(body);   // the very bytes that `poolhall simulate` prints
//   Page cloud = evaluate_page(body);  // what noise makes of a shot
//
// Whoever sends scenes decides what they cost, so each is bounded in events and refused what only
// the program on one's own machine does.
#pragma once

#include <string_view>

#include "server/web/page.hpp"

namespace poolhall::web {

// Of one scene; a break has about 500. The smaller of this and the scene's own limit counts, and a
// scene that meets it gives the partial log, its `stats.ending` being "event_limit".
inline constexpr unsigned most_events = 20'000;
inline constexpr unsigned most_samples = 500;
// Of all samples of one evaluation together.
inline constexpr unsigned most_sampled_events = 400'000;

[[nodiscard]] Page simulate_page(std::string_view scene);
[[nodiscard]] Page evaluate_page(std::string_view order);

// Tables, physics and noise levels that have names, with all their numbers.
[[nodiscard]] Page presets_page();

}  // namespace poolhall::web
