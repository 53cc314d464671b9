// A value or the reason why there is none.
//
//   Expected<Scene<double>> scene = checked(input);
//   if (!scene) report(scene.error().field, scene.error().reason);
//
// Untrusted input gives an Error; bugs are asserts; exceptions are not used inside physics.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace poolhall::physics {

// Why a scene or a shot was refused, or why a simulation stopped before its end.
enum class Fault : std::uint8_t {
  not_finite,          // a number is NaN or infinite
  out_of_range,        // a number is outside its documented range
  overlap,             // two balls in one place
  outside_table,       // a ball beyond a rail or a mouth line
  inconsistent_state,  // a given motion state contradicts the velocities
  duplicate_ball,      // two balls with one id
  no_cue_ball,         // a shot without a cue ball on the table
  tip_off_ball,        // a^2 + b^2 > R^2
  miscue,              // the line of the cue passes the ball's centre beyond the miscue limit
  cue_obstructed,      // the cue stick would pass through a ball or a rail
  event_limit,         // the bound on the number of events was met
  bad_table,           // a table whose geometry contradicts itself
};

[[nodiscard]] std::string_view name(Fault fault);

struct Error {
  Fault fault;
  std::string field;   // JSON Pointer into the thing that was checked, "" for the whole
  std::string reason;  // one line: what came and what was expected
};

template <class T>
using Expected = tl::expected<T, Error>;

}  // namespace poolhall::physics
