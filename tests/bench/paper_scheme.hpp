// The paper's event-based scheme as it stands there (section 3.2 and figure 3): at every event the
// closed-form roots of all pairs and all rails and pockets are computed again and every ball is
// advanced. Same contact rule, same collision models, same flags as the core and no allocation
// either: what the core's speed is a ratio to. Tables with mouth lines or without pockets.
//
//   PaperScheme<double> scheme(table, materials);
//   std::size_t events = scheme.run(balls, shot);
//
// For double, and Counted (counted.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "physics/coefficients.hpp"
#include "physics/cue_strike.hpp"
#include "physics/cushion.hpp"
#include "physics/motion.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::bench {

template <class Real>
class PaperScheme {
 public:
  PaperScheme(const physics::Table& table, const physics::Materials& materials);

  // Plays the shot to its end, or for so many seconds, and tells the number of events; at most a
  // million.
  std::size_t run(const physics::BallSet<Real>& balls,
                  const std::optional<physics::CueShot<Real>>& shot,
                  const Real& longest = physics::forever<Real>());

  [[nodiscard]] const physics::BallSet<Real>& balls() const { return balls_; }

 private:
  enum class What : std::uint8_t { nothing, transition, pocket, rail, contact };
  struct Next {
    Real t{};  // s from now
    What what = What::nothing;
    std::size_t ball = 0;
    std::size_t other = 0;  // second ball, rail or mouth
  };

  void strike(const physics::CueShot<Real>& shot);
  [[nodiscard]] Next next_event();
  void next_of_ball(std::size_t i, Next& best) const;
  void next_of_pair(std::size_t i, std::size_t k, Next& best) const;
  void advance_all(const Next& next);
  void carry_out(const Next& next);

  physics::Materials materials_;
  physics::Coefficients<Real> c_;
  physics::TableGeometry<Real> geometry_;
  physics::NoseAngle<Real> nose_;
  physics::BallSet<Real> balls_;
  std::array<physics::Segment<Real>, physics::max_balls> segments_{};
};

}  // namespace poolhall::bench
