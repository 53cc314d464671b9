// What a scene does not need: each omission has a switch and changes no bit of any result. The
// event loop takes the set as a policy, so that nothing is asked while it runs; benchmarks switch
// one off to measure what it saves.
//
//   EventLoop<double> loop(table, materials);                       // omits all it can
//   EventLoop<double, LeanWithout<Omission::far_pairs>> slower(table, materials);
#pragma once

#include <cstdint>

namespace poolhall::physics {

enum class Omission : std::uint8_t {
  pairs_at_rest,   // no contact is looked for between two balls that do not move
  far_pairs,       // nor between balls whose paths' bounding boxes stay apart
  clear_pairs,     // nor searched where the Bernstein ordinates of the gap exclude it
  far_rails,       // rails, mouths and jaws that the path's bounding box does not reach
  ball_friction,   // the friction between balls where its coefficient is 0
  far_neighbours,  // the search for a cluster where no third ball is near
};

struct Lean {
  static constexpr bool omits(Omission) { return true; }
};

template <Omission needed>
struct LeanWithout {
  static constexpr bool omits(Omission omission) { return omission != needed; }
};

}  // namespace poolhall::physics
