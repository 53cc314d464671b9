// The event loop: finds the next event, lets it happen, and again. A workspace that is made once
// for a table and materials and then runs any number of shots without touching the heap.
//
//   EventLoop<double> loop(table, materials);
//   Unwatched none;
//   Ending ending = loop.run(balls, shot, options, none);
//   loop.balls();  // where they lie
//
// Order of simultaneous events: motion transitions, pockets, rails, ball contacts; among equals
// the lower ball id first. Scenes must have passed check_scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "physics/ball_collision.hpp"
#include "physics/boundary.hpp"
#include "physics/contact_cluster.hpp"
#include "physics/contact_search.hpp"
#include "physics/cushion.hpp"
#include "physics/energy.hpp"
#include "physics/jaws.hpp"
#include "physics/lean.hpp"
#include "physics/simulator.hpp"
#include "physics/watch.hpp"

namespace poolhall::physics {

template <class Real, class Policy = Lean>
class EventLoop {
 public:
  EventLoop(const Table& table, const Materials& materials)
      : materials_(materials),
        c_(coefficients<Real>(materials)),
        boundary_(boundary<Real>(table, c_.radius)),
        jaws_(std::holds_alternative<Jaws>(table.pockets)
                  ? JawTable<Real>(table, materials.ball_radius)
                  : JawTable<Real>()),
        has_jaws_(std::holds_alternative<Jaws>(table.pockets)),
        nose_(nose_angle<Real>(table, materials)),
        cluster_(c_) {}

  template <class Watch>
  Ending run(const BallSet<Real>& balls, const std::optional<CueShot<Real>>& shot,
             const SimulationOptions& options, Watch& watch);

  [[nodiscard]] const BallSet<Real>& balls() const { return balls_; }
  [[nodiscard]] const EnergyAccount<Real>& energy() const { return energy_; }
  [[nodiscard]] Real duration() const { return last_.high; }
  [[nodiscard]] std::uint32_t events() const { return events_; }

 private:
  // What a ball does next, in the order in which simultaneous events happen.
  enum class Next : std::uint8_t { transition, pocket, rail, contact, nothing };

  struct Candidate {
    Instant<Real> at = never<Real>();
    Next what = Next::nothing;
    std::uint8_t partner = 0;  // of a contact, by index
  };

  // A ball's motion, what ends it if no other ball comes, and what comes first.
  struct Body {
    Segment<Real> motion{};
    BoundaryHit<Real> hit{};
    Candidate own{};
    Candidate next{};
    Span<Real> across{};  // of the centre's x until `own`
    Span<Real> along{};   // of the centre's y
    BallId id{};
    bool moves = false;
    bool down = false;
  };

  using Indices = std::uint32_t;  // a set of ball indices, one bit each

  void place(const BallSet<Real>& balls);
  void begin_motion(std::size_t i, const Ball<Real>& ball);
  void refresh(Indices changed);
  void sweep(std::size_t i, Indices done);
  void look_for_contact(std::size_t i, std::size_t k);
  [[nodiscard]] std::size_t earliest() const;
  [[nodiscard]] bool precedes(std::size_t i, std::size_t k) const;
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
  [[nodiscard]] bool is_crowded(std::size_t i, std::size_t k) const;
  template <class Watch>
  [[nodiscard]] Go meet_together(std::size_t i, std::size_t k, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go meet(std::size_t i, std::size_t k, Watch& watch);
  template <class Watch>
  [[nodiscard]] Go tell(Watch& watch, const Event<Real>& event, Hop hop);
  [[nodiscard]] Ball<Real> ball_now(std::size_t i) const;
  [[nodiscard]] Hop hop(const Real& closing) const;
  void account(const Real& before, const Real& after);
  void finish(const Instant<Real>& at);
  [[nodiscard]] Real energy_now() const;

  Materials materials_;
  Coefficients<Real> c_;
  Boundary<Real> boundary_;
  JawTable<Real> jaws_;
  bool has_jaws_;
  NoseAngle<Real> nose_;
  ContactCluster<Real> cluster_;
  ContactModel contact_ = ContactModel::cluster;
  RootSolver solver_ = RootSolver::bracketed;
  std::array<Body, max_balls> bodies_{};
  std::size_t count_ = 0;
  Instant<Real> now_{};
  Instant<Real> last_{};
  std::uint32_t events_ = 0;
  BallSet<Real> balls_{};
  EnergyAccount<Real> energy_{};
};

}  // namespace poolhall::physics

#include "physics/event_loop_impl.hpp"
