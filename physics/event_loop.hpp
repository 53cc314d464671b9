// The event loop: finds the next event, lets it happen, and again. A workspace that is made once
// for a table and materials and then runs any number of shots without touching the heap.
//
//   EventLoop<double> loop(table, materials);           // fast: all in double
//   EventLoop<double, Precise> loop(table, materials);  // see lean.hpp
//   Unwatched none;
//   Ending ending = loop.run(balls, shot, options, none);
//   loop.balls();  // where they lie
//
// Order of simultaneous events: motion transitions, pockets, rails, ball contacts; among equals
// the lower ball id first. Scenes must have passed check_scene.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "physics/ball_collision.hpp"
#include "physics/boundary.hpp"
#include "physics/contact_cluster.hpp"
#include "physics/contact_search.hpp"
#include "physics/cushion.hpp"
#include "physics/drift.hpp"
#include "physics/energy.hpp"
#include "physics/jaws.hpp"
#include "physics/lean.hpp"
#include "physics/simulator.hpp"
#include "physics/watch.hpp"
#include "physics/wide.hpp"

namespace poolhall::physics {

template <class Real, class Policy = Lean>
class EventLoop {
 public:
  EventLoop(const Table& table, const Materials& materials);

  template <class Watch>
  Ending run(const BallSet<Real>& balls, const std::optional<CueShot<Real>>& shot,
             const SimulationOptions& options, Watch& watch);

  [[nodiscard]] const BallSet<Real>& balls() const { return balls_; }
  [[nodiscard]] const EnergyAccount<Real>& energy() const { return energy_; }
  [[nodiscard]] Real duration() const { return last_.high; }
  [[nodiscard]] std::uint32_t events() const { return events_; }
  // Whether the last run ended, with Ending::stopped, since rounding may have carried a ball
  // further than `drift_bound`; of a policy that stops in doubt.
  [[nodiscard]] bool is_doubtful() const { return doubtful_; }
  static constexpr double drift_bound = 1e-11;  // m

 private:
  using Exact = typename Policy::template State<Real>;

  // What a ball does next, in the order in which simultaneous events happen.
  enum class Next : std::uint8_t { transition, pocket, rail, contact, nothing };

  struct Candidate {
    Instant<Real> at = never<Real>();
    Next what = Next::nothing;
    std::uint8_t partner = 0;  // of a contact, by index
  };

  // A ball's motion, what ends it if no other ball comes, and what comes first.
  struct Body {
    Segment<Exact> exact{};
    Segment<Real> motion{};  // `exact` rounded, for searching
    BoundaryHit<Exact> hit{};
    Candidate own{};
    Candidate next{};
    BallId id{};
  };

  // The bounding boxes of the centres' paths until `own`, by ball index.
  struct Boxes {
    std::array<Real, max_balls> left{}, right{}, head{}, foot{};
  };

  using Indices = std::uint32_t;  // a set of ball indices, one bit each
  [[nodiscard]] static constexpr Indices only(std::size_t i) { return Indices{1} << i; }

  void place(const BallSet<Real>& balls);
  void begin_motion(std::size_t i, const Ball<Exact>& ball);
  void begin_rest(std::size_t i, const Ball<Exact>& ball);
  void set_box(std::size_t i, const Span<Real>& across, const Span<Real>& along);
  void find_own_event(std::size_t i);
  void refresh(Indices changed);
  void sweep(std::size_t i, Indices others);
  [[nodiscard]] Indices near(const Span<Real>& across, const Span<Real>& along, const Real& reach,
                             Indices among) const;
  void look_for_contact(std::size_t i, std::size_t k);
  [[nodiscard]] Exact refined(std::size_t i, std::size_t k, const Real& t) const;
  void set_next(std::size_t i, const Candidate& next);
  [[nodiscard]] std::size_t earliest() const;
  [[nodiscard]] bool precedes(std::size_t i, std::size_t k) const;

  [[nodiscard]] Exact elapsed(std::size_t i) const;
  [[nodiscard]] Ball<Exact> ball_now(std::size_t i) const;
  [[nodiscard]] bool is_crowded(std::size_t i, std::size_t k) const;
  [[nodiscard]] Hop hop(const Exact& closing) const;
  void account(const Exact& before, const Exact& after);
  void carry_drift(std::size_t i);
  void drift_off(std::size_t i, Surface surface, const Ball<Exact>& before,
                 const Ball<Exact>& after, const Exact& closing);
  void drift_together(std::size_t i, std::size_t k, const Ball<Exact>& first,
                      const Ball<Exact>& second);
  [[nodiscard]] Real energy_now() const;
  void finish(const Instant<Real>& at);

  template <class Watch>
  [[nodiscard]] Go strike_cue_ball(const CueShot<Real>& shot, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go happen(std::size_t i, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go transition(std::size_t i, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go pocket(std::size_t i, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go bounce(std::size_t i, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go meet(std::size_t i, std::size_t k, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go meet_alone(std::size_t i, std::size_t k, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go meet_together(std::size_t i, std::size_t k, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go tell(Watch& watch, EventType type, const Ball<Exact>& after,
                        const BoundaryHit<Exact>* hit = nullptr, Hop hop_kind = Hop::no) const;
  template <class Watch>
  [[nodiscard]] Go tell_contact(Watch& watch, const Ball<Exact>& first, const Ball<Exact>& second,
                                Hop hop_kind) const;

  Materials materials_;
  Coefficients<Exact> c_;
  Real reach_{};  // m, 2R
  Real reach_squared_{};
  Boundary<Real> boundary_;
  Boundary<Exact> exact_boundary_;
  bool has_jaws_;
  JawTable<Real> jaws_;
  JawTable<Exact> exact_jaws_;
  NoseAngle<Exact> nose_;
  ContactCluster<Exact> cluster_;
  ContactModel contact_ = ContactModel::cluster;
  RootSolver solver_ = RootSolver::bracketed;
  std::array<Body, max_balls> bodies_{};
  Boxes boxes_{};
  Indices present_ = 0;  // not pocketed
  Indices moving_ = 0;
  Indices busy_ = 0;     // something comes next
  Indices touched_ = 0;  // moved at some time
  Indices meeting_ = 0;  // and it is a contact
  std::size_t count_ = 0;
  Instant<Real> now_{};
  Instant<Real> last_{};
  std::uint32_t events_ = 0;
  BallSet<Real> balls_{};
  EnergyAccount<Real> energy_{};
  Exact added_{};
  std::array<Drift<Real>, max_balls> drift_{};
  Real extent_;             // m, the largest coordinate
  Real cushion_roughness_;  // square of the roundings that an impact on a cushion is worth
  bool doubtful_ = false;
};

}  // namespace poolhall::physics

#include "physics/event_loop_drift.hpp"
#include "physics/event_loop_run.hpp"
#include "physics/event_loop_search.hpp"
