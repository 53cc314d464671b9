// Writes events and balls of any number type. `write_real` has overloads for double and long
// double; whoever simulates with another type gives one for that in this namespace.
//
//   write_events(out, simulation.events, EventDetail::full);
#pragma once

#include "physics/event_log.hpp"
#include "physics/simulator.hpp"
#include "protocol/events_json.hpp"
#include "protocol/json_writer.hpp"

namespace poolhall::protocol {

inline void write_real(JsonWriter& out, double value) {
  out.number(value);
}
inline void write_real(JsonWriter& out, long double value) {
  out.number(value);
}

template <class Real>
void write_ball_motion(JsonWriter& out, const physics::Ball<Real>& ball) {
  const auto member = [&](const char* key, const Real& value) {
    out.key(key);
    write_real(out, value);
  };
  member("x", ball.position.x);
  member("y", ball.position.y);
  member("vx", ball.velocity.x);
  member("vy", ball.velocity.y);
  member("wx", ball.angular_velocity.x);
  member("wy", ball.angular_velocity.y);
  member("wz", ball.angular_velocity.z);
}

// {"id", "state", "x", "y", "vx", "vy", "wx", "wy", "wz"}
template <class Real>
void write_ball_after(JsonWriter& out, const physics::Ball<Real>& ball) {
  out.begin_object().key("id").integer(physics::number(ball.id));
  out.key("state").string(physics::name(ball.state));
  write_ball_motion(out, ball);
  out.end_object();
}

template <class Real>
void write_event(JsonWriter& out, const physics::Event<Real>& event, EventDetail detail) {
  out.begin_object().key("t");
  write_real(out, event.t);
  out.key("type").string(physics::name(event.type)).key("balls").begin_array();
  for (std::size_t i = 0; i < event.ball_count; ++i) {
    out.integer(physics::number(event.after[i].id));
  }
  out.end_array();
  if (event.rail) {
    out.key("rail").string(physics::name(*event.rail));
  }
  if (event.pocket) {
    out.key("pocket").string(physics::name(*event.pocket));
  }
  if (event.until) {
    out.key("count").integer(event.count).key("until");
    write_real(out, *event.until);
  }
  if (detail == EventDetail::full) {
    out.key("after").begin_array();
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      write_ball_after(out, event.after[i]);
    }
    out.end_array();
  }
  out.end_object();
}

template <class Real>
void write_events(JsonWriter& out, const physics::EventLog<Real>& events, EventDetail detail) {
  out.begin_array();
  for (const physics::Event<Real>& event : events) {
    write_event(out, event, detail);
  }
  out.end_array();
}

}  // namespace poolhall::protocol
