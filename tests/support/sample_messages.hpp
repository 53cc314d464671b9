// At least one message of every kind of the protocol, made from a game that is really played: for
// round trips, schemas and decoders.
//
//   for (const protocol::Request& request : sample_requests()) ...
#pragma once

#include <vector>

#include "physics/event_log.hpp"
#include "protocol/messages.hpp"
#include "rules/referee.hpp"

namespace poolhall::test_support {

// A break shot of a new game, from its state to its ruling.
struct PlayedBreak {
  rules::GameState before;
  rules::Call call{};
  physics::Vec2<double> cue_ball{};
  protocol::ShotParams params{};
  physics::EventLog<double> events;
  rules::Ruling ruling;
};
[[nodiscard]] PlayedBreak played_break(rules::RuleSet rules);

struct SampleReply {
  protocol::Method method;
  protocol::Reply<protocol::Outgoing> reply;
};

[[nodiscard]] std::vector<protocol::Request> sample_requests();
[[nodiscard]] std::vector<SampleReply> sample_replies();
[[nodiscard]] std::vector<protocol::Notification<protocol::Outgoing>> sample_notifications();

}  // namespace poolhall::test_support
