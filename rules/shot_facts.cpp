#include "rules/shot_facts.hpp"

#include <algorithm>
#include <set>

#include "rules/ball_path.hpp"
#include "rules/common_clauses.hpp"
#include "rules/rail_contact.hpp"

namespace poolhall::rules {
namespace {

using physics::Event;
using physics::EventLog;
using physics::EventType;
using physics::RailId;

// s; balls that the cue ball meets within it are struck at once.
constexpr double simultaneous = 1e-9;

std::vector<BallEvent> first_contacts(const EventLog<double>& events) {
  std::vector<BallEvent> contacts;
  double first = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event<double>& event = events[i];
    if (event.type != EventType::ball_collision || !event.involves(physics::cue_ball)) {
      continue;
    }
    const BallId ball = event.after[event.after[0].id == physics::cue_ball ? 1 : 0].id;
    if (contacts.empty()) {
      first = event.t;
    } else if (!applies(clauses::simultaneous_contact, event.t - first <= simultaneous)) {
      continue;
    }
    const auto same = [ball](const BallEvent& contact) { return contact.ball == ball; };
    if (std::none_of(contacts.begin(), contacts.end(), same)) {
      contacts.push_back({ball, i});
    }
  }
  return contacts;
}

// Whether the ball of `path`, frozen to `rail` at the start, had been away before event `event`.
bool was_away(const std::vector<PathPiece>& path, RailId rail, std::size_t event,
              const RailDistances& rails) {
  return std::any_of(path.begin(), path.end(), [&](const PathPiece& piece) {
    return piece.to <= event && rails.comes_away(rail, piece);
  });
}

// Every time `place`'s ball was driven to a rail.
std::vector<BallEvent> driven_to_rail(const BallPlace& place, const EventLog<double>& events,
                                      const RailDistances& rails,
                                      const physics::Materials& materials) {
  const auto touched = [&place](const Event<double>& event) { return event.involves(place.id); };
  if (std::none_of(events.begin(), events.end(), touched)) {
    return {};
  }
  const std::vector<PathPiece> path = ball_path(place.id, events, materials);
  const std::vector<RailId> frozen = rails.frozen(place.position);
  std::vector<BallEvent> driven;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event<double>& event = events[i];
    if (!touched(event)) {
      continue;
    }
    bool counts = false;
    if (event.type == EventType::rail_collision) {
      const bool frozen_here =
          std::find(frozen.begin(), frozen.end(), *event.rail) != frozen.end() &&
          !was_away(path, *event.rail, i, rails);
      counts = !applies(clauses::frozen_rail, frozen_here);
    } else if (event.type == EventType::pocketed) {
      counts = applies(clauses::pocketed_is_driven, true);
    } else if (event.type == EventType::off_table) {
      counts = applies(clauses::off_table_is_driven, true);
    }
    if (counts) {
      driven.push_back({place.id, i});
    }
  }
  return driven;
}

double farthest_y(const GameState& ready, const EventLog<double>& events, std::size_t until,
                  const physics::Materials& materials) {
  double farthest = find_ball(ready, physics::cue_ball)->position.y;
  for (const PathPiece& piece : ball_path(physics::cue_ball, events, materials)) {
    if (piece.from < until) {
      farthest = std::max(farthest, largest(piece, {0, 1}));
    }
  }
  return farthest;
}

}  // namespace

bool ShotFacts::is_pocketed(BallId ball) const {
  return std::any_of(pocketed.begin(), pocketed.end(),
                     [ball](const PocketedBall& down) { return down.ball == ball; });
}

bool ShotFacts::is_off(BallId ball) const {
  return std::any_of(driven_off.begin(), driven_off.end(),
                     [ball](const BallEvent& off) { return off.ball == ball; });
}

bool ShotFacts::is_pocketed_in(BallId ball, PocketId pocket) const {
  return std::any_of(pocketed.begin(), pocketed.end(), [ball, pocket](const PocketedBall& down) {
    return down.ball == ball && down.pocket == pocket;
  });
}

std::optional<std::size_t> ShotFacts::first_object_ball_down() const {
  const auto found = std::find_if(pocketed.begin(), pocketed.end(), [](const PocketedBall& down) {
    return down.ball != physics::cue_ball;
  });
  return found == pocketed.end() ? std::nullopt : std::optional{found->event};
}

std::optional<std::size_t> ShotFacts::gone_event(BallId ball) const {
  for (const PocketedBall& down : pocketed) {
    if (down.ball == ball) {
      return down.event;
    }
  }
  for (const BallEvent& off : driven_off) {
    if (off.ball == ball) {
      return off.event;
    }
  }
  return std::nullopt;
}

std::size_t ShotFacts::object_balls_driven_to_rail() const {
  std::set<BallId> balls;
  for (const BallEvent& driven : driven_to_rail) {
    if (driven.ball != physics::cue_ball) {
      balls.insert(driven.ball);
    }
  }
  return balls.size();
}

ShotFacts shot_facts(const GameState& ready, const EventLog<double>& events,
                     const physics::Table& table, const physics::Materials& materials) {
  ShotFacts facts;
  facts.first_contacts = first_contacts(events);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const BallId ball = events[i].after[0].id;
    if (events[i].type == EventType::pocketed) {
      facts.pocketed.push_back({ball, *events[i].pocket, i});
    } else if (events[i].type == EventType::off_table) {
      facts.driven_off.push_back({ball, i});
    }
  }
  const RailDistances rails(table, materials);
  for (const BallPlace& place : ready.balls) {
    if (place.where == Whereabouts::on_table) {
      const std::vector<BallEvent> driven = driven_to_rail(place, events, rails, materials);
      facts.driven_to_rail.insert(facts.driven_to_rail.end(), driven.begin(), driven.end());
    }
  }
  const std::size_t contact =
      facts.first_contacts.empty() ? events.size() : facts.first_contacts.front().event;
  facts.cue_ball_farthest_y = farthest_y(ready, events, contact, materials);
  return facts;
}

GameState settled(const GameState& ready, const EventLog<double>& events) {
  GameState state = ready;
  for (const Event<double>& event : events) {
    for (std::size_t k = 0; k < event.ball_count; ++k) {
      const physics::Ball<double>& after = event.after[k];
      const auto place = std::find_if(state.balls.begin(), state.balls.end(),
                                      [&](const BallPlace& p) { return p.id == after.id; });
      if (has_place(after)) {
        place->position = after.position;
      }
      if (event.type == EventType::pocketed) {
        *place = {after.id, Whereabouts::pocketed, {}, *event.pocket};
      } else if (event.type == EventType::off_table) {
        *place = {after.id, Whereabouts::off_table, {}, {}};
      }
    }
  }
  return state;
}

}  // namespace poolhall::rules
