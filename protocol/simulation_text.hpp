// What `poolhall simulate` prints of a simulation, in any number type that has a `write_real`.
//
//   std::string line = simulation_text(simulation);
#pragma once

#include <array>
#include <string>

#include "physics/simulator.hpp"
#include "protocol/events_text.hpp"

namespace poolhall::protocol {

// A ball at the end: with its pocket instead of a place, if it has one.
template <class Real>
void write_final_ball(JsonWriter& out, const physics::Ball<Real>& ball) {
  out.begin_object().key("id").integer(physics::number(ball.id));
  out.key("state").string(physics::name(ball.state));
  if (ball.pocket) {
    out.key("pocket").string(physics::name(*ball.pocket));
  } else {
    write_ball_motion(out, ball);
  }
  out.end_object();
}

template <class Real>
void write_energy(JsonWriter& out, const physics::EnergyAccount<Real>& energy) {
  out.begin_object().key("start");
  write_real(out, energy.start);
  out.key("end");
  write_real(out, energy.end);
  out.key("added_by_separation");
  write_real(out, energy.added_by_separation);
  out.end_object();
}

// How it ended, and how many events of each type there were.
template <class Real>
void write_stats(JsonWriter& out, const physics::Simulation<Real>& simulation) {
  using physics::EventType;
  out.begin_object().key("ending").string(physics::name(simulation.ending));
  out.key("events").integer(simulation.events.size());
  for (const EventType type :
       {EventType::cue_strike, EventType::ball_collision, EventType::rail_collision,
        EventType::pocketed, EventType::transition}) {
    std::size_t count = 0;
    for (const physics::Event<Real>& event : simulation.events) {
      count += event.type == type ? 1 : 0;
    }
    out.key(physics::name(type)).integer(count);
  }
  out.end_object();
}

template <class Real>
[[nodiscard]] std::string simulation_text(const physics::Simulation<Real>& simulation) {
  JsonWriter out;
  out.begin_object().key("events");
  write_events(out, simulation.events, EventDetail::full);
  out.key("final").begin_array();
  for (const physics::Ball<Real>& ball : simulation.balls) {
    write_final_ball(out, ball);
  }
  out.end_array().key("duration");
  write_real(out, simulation.duration);
  out.key("energy");
  write_energy(out, simulation.energy);
  out.key("stats");
  write_stats(out, simulation);
  out.end_object();
  return std::move(out).text();
}

}  // namespace poolhall::protocol
