// The version of the simulator's results. It changes with every change that gives any shot other
// bits, so that a stored shot is run again only by the simulator that played it.
//
//   row.physics_version = physics::version;
#pragma once

#include <string_view>

namespace poolhall::physics {

inline constexpr std::string_view version = "physics-5";

}  // namespace poolhall::physics
