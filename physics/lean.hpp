// What a scene does not need: each omission has a switch and changes no bit of any result. The
// event loop takes the set as a policy, so that nothing is asked while it runs; benchmarks switch
// one off to measure what it saves.
//
//   EventLoop<double> loop(table, materials);                       // omits all it can
//   EventLoop<double, LeanWithout<Omission::far_pairs>> slower(table, materials);
//   EventLoop<double, Precise> precise(table, materials);           // balls kept in wider numbers
#pragma once

#include <cstdint>

#include "physics/wide.hpp"

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
  // The number type in which balls are kept, move and collide.
  template <class Real>
  using State = Real;
  // Whether the run stops, `doubtful`, when rounding may have carried a ball too far (drift.hpp).
  static constexpr bool stops_in_doubt = false;
};

template <Omission needed>
struct LeanWithout : Lean {
  static constexpr bool omits(Omission omission) { return omission != needed; }
};

// The same, and it knows when double is not enough.
struct Guarded : Lean {
  static constexpr bool stops_in_doubt = true;
};

// The same omissions, with balls kept in wider numbers (wide.hpp): nearly twice the time of Lean
// for shots of a few balls.
struct Precise : Lean {
  template <class Real>
  using State = Wide<Real>;
};

}  // namespace poolhall::physics
