// How a simulated shot differs from the 100-digit reference.
//
//   const Difference d = difference(simulated, reference_simulate(...));
//   d.sequence.same;        // the same events in the same order, ties apart
//   d.position;             // m, of the ball that is furthest off
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "physics/reference/reference_simulator.hpp"
#include "physics/simulator.hpp"

namespace poolhall::bench {

// What an event is, without its time.
struct EventKey {
  physics::EventType type = physics::EventType::transition;
  physics::BallId first{};   // the lower id of a pair
  physics::BallId second{};  // the higher one; else the same as `first`
  int place = -1;            // rail or pocket

  friend auto operator<=>(const EventKey&, const EventKey&) = default;
};

struct TimedEvent {
  EventKey key;
  double t = 0;  // s
  std::uint32_t count = 1;
  double until = 0;  // s, of the last hop that the entry stands for
};

template <class Real>
[[nodiscard]] TimedEvent timed_event(const physics::Event<Real>& event) {
  const bool pair = event.ball_count == 2;
  const physics::BallId one = event.after[0].id;
  const physics::BallId two = pair ? event.after[1].id : one;
  TimedEvent out;
  out.key = {event.type, std::min(one, two), std::max(one, two),
             event.rail     ? static_cast<int>(*event.rail)
             : event.pocket ? static_cast<int>(*event.pocket)
                            : -1};
  out.t = static_cast<double>(event.t);
  out.count = event.count;
  out.until = event.until ? static_cast<double>(*event.until) : out.t;
  return out;
}

// Two events of the reference closer than this may come in either order.
inline constexpr double tie = 1e-13;  // s

struct Sequence {
  bool same = false;    // but for the order of ties
  bool parted = false;  // an event is another; else one sequence only ends before the other
  bool has_ties_in_another_order = false;
  std::vector<double> time_errors;  // s, of each event up to the first that is another
  std::string first_difference;     // in words, where not the same
};

// `reference` has an entry a hop; entries of `found` with a count stand for as many.
[[nodiscard]] Sequence compare_sequences(const std::vector<TimedEvent>& found,
                                         std::vector<TimedEvent> reference);

struct Difference {
  Sequence sequence;
  bool same_pockets = false;  // every ball pocketed in the same pocket or on the table in both
  double position = 0;        // m, largest distance of a ball from where it should lie
};

template <class Real>
[[nodiscard]] std::vector<TimedEvent> timed_events(const physics::EventLog<Real>& events) {
  std::vector<TimedEvent> timed;
  for (const auto& event : events) {
    timed.push_back(timed_event(event));
  }
  return timed;
}

template <class Real>
[[nodiscard]] Difference difference(const physics::Simulation<Real>& found,
                                    const physics::reference::ReferenceSimulation& reference) {
  Difference d;
  d.sequence = compare_sequences(timed_events(found.events), timed_events(reference.events));
  d.same_pockets = true;
  using physics::reference::Number;
  for (std::size_t i = 0; i < found.balls.count; ++i) {
    const auto& p = found.balls[i];
    const auto& q = reference.balls[i];
    d.same_pockets = d.same_pockets && p.pocket == q.pocket;
    if (p.pocket || q.pocket) {
      continue;
    }
    const Number x = Number(p.position.x) - q.position.x;
    const Number y = Number(p.position.y) - q.position.y;
    d.position = std::max(d.position, static_cast<double>(Number(sqrt(x * x + y * y))));
  }
  return d;
}

}  // namespace poolhall::bench
