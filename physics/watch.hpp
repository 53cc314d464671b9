// Who looks at a simulation while it runs. A watch is a policy: `records` says whether it wants
// the balls' states after each event, and `see` may stop the run by returning Go::stop.
//
//   Unwatched none;                 // no log: costs nothing
//   Recorder<double> log;           // the whole event log
//   FirstContact contact{cue_ball}; // stops at the first ball that the cue ball meets
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "physics/event_log.hpp"

namespace poolhall::physics {

enum class Go : std::uint8_t { on, stop };

// What every watch is told of an event, even one that records nothing.
struct Sighting {
  EventType type = EventType::transition;
  BallId first{};
  BallId second{};  // of a ball_collision, else the same as `first`
  std::optional<PocketId> pocket{};
};

struct Unwatched {
  static constexpr bool records = false;
  [[nodiscard]] Go see(const Sighting&) const { return Go::on; }
};

// The first ball that `ball` touches.
struct FirstContact {
  static constexpr bool records = false;
  BallId ball{};
  std::optional<BallId> touched{};

  [[nodiscard]] Go see(const Sighting& s) {
    if (s.type != EventType::ball_collision || (s.first != ball && s.second != ball)) {
      return Go::on;
    }
    touched = s.first == ball ? s.second : s.first;
    return Go::stop;
  }
};

// Whether, and where, `ball` is pocketed.
struct WillBePocketed {
  static constexpr bool records = false;
  BallId ball{};
  std::optional<PocketId> pocket{};

  [[nodiscard]] Go see(const Sighting& s) {
    if (s.type != EventType::pocketed || s.first != ball) {
      return Go::on;
    }
    pocket = s.pocket;
    return Go::stop;
  }
};

// Sustained contact comes as many hops. An event is a hop if the balls, or ball and rail, closed
// no faster than the separation speed.
enum class Hop : std::uint8_t { no, yes };

// Writes the event log. More than three hops in a row of one ball on one rail, or of one pair,
// become one entry: `count` hops from `t` to `until`, `after` as at `until`. Whatever else happens
// to a ball, a transition too, ends its row, so that nothing is logged of it between `t` and
// `until`.
template <class Real>
class Recorder {
 public:
  static constexpr bool records = true;

  [[nodiscard]] Go see(const Sighting&) const { return Go::on; }

  void record(const Event<Real>& event, Hop hop) {
    Row& row = rows_[number(event.after[0].id)];
    if (hop == Hop::no) {
      forget(event);
      events_.push_back(event);
    } else if (continues(row, event)) {
      extend(row, event);
    } else {
      begin(row, event);
    }
  }

  // The log without the entries that were merged into others.
  [[nodiscard]] EventLog<Real> take() {
    std::erase_if(events_, [](const Event<Real>& e) { return e.count == 0; });
    rows_ = {};
    return std::move(events_);
  }

 private:
  static constexpr std::uint32_t longest_single = 3;

  struct Row {
    std::uint32_t length = 0;
    std::array<std::size_t, longest_single> entries{};
  };

  [[nodiscard]] bool continues(const Row& row, const Event<Real>& event) const {
    if (row.length == 0) {
      return false;
    }
    const Event<Real>& first = events_[row.entries[0]];
    if (first.type != event.type || first.rail != event.rail ||
        first.after[0].id != event.after[0].id) {
      return false;
    }
    // The second ball of a pair has no row of its own only as long as it meets nothing else.
    return event.ball_count == 1 || (first.after[1].id == event.after[1].id &&
                                     partner_[number(event.after[1].id)] == event.after[0].id);
  }

  void forget(const Event<Real>& event) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      rows_[number(event.after[i].id)] = {};
      partner_[number(event.after[i].id)].reset();
    }
  }

  void begin(Row& row, const Event<Real>& event) {
    forget(event);
    if (event.ball_count == 2) {
      partner_[number(event.after[1].id)] = event.after[0].id;
    }
    row.length = 1;
    row.entries[0] = events_.size();
    events_.push_back(event);
  }

  void extend(Row& row, const Event<Real>& event) {
    ++row.length;
    if (row.length <= longest_single) {
      row.entries[row.length - 1] = events_.size();
      events_.push_back(event);
      return;
    }
    Event<Real>& entry = events_[row.entries[0]];
    entry.after = event.after;
    entry.count = row.length;
    entry.until = event.t;
    if (row.length == longest_single + 1) {
      events_[row.entries[1]].count = 0;
      events_[row.entries[2]].count = 0;
    }
  }

  EventLog<Real> events_;
  std::array<Row, max_balls> rows_{};
  std::array<std::optional<BallId>, max_balls> partner_{};
};

}  // namespace poolhall::physics
