// The part of LiveGame that speaks: what was stored, to those whom it concerns.
#include <utility>

#include "server/net/live_game.hpp"
#include "server/storage/failpoint.hpp"

namespace poolhall::net {

using match::Phase;
using protocol::Repetition;
using std::chrono::steady_clock;

void LiveGame::tell(const match::Store& what) {
  storage::failpoint(storage::Failpoint::before_send);
  if (what.error) {
    asker_.refuse(*what.error);
    for (const Asker& asker : std::exchange(joined_, {})) {
      asker.refuse(*what.error);
    }
  }
  switch (what.turn.action) {
    case storage::TurnAction::shot:
      tell_played<protocol::ShotReply<Outgoing>>(what.turn, shot_of);
      break;
    case storage::TurnAction::decision:
      tell_played<protocol::DecideReply<Outgoing>>(what.turn, decision_of);
      break;
    case storage::TurnAction::lost_turn:
      tell_lost_turn(what.turn);
      break;
    case storage::TurnAction::concession:
      asker_.reply(protocol::GameReply{record().id});
      break;
    case storage::TurnAction::timeout:
    case storage::TurnAction::forfeit:
    case storage::TurnAction::void_game:
      break;
  }
  asker_ = {};
  if (services_.on_turn) {
    services_.on_turn(*this, what.turn);
  }
}

template <class TurnReply, class MessageOf>
void LiveGame::tell_played(const storage::TurnRecord& row, MessageOf message_of) {
  const Seat by = row.seat;
  const auto asked = asker_.session.lock();
  asker_.reply(TurnReply{message_of(row, side_of(by, asked)), Repetition::first_time});
  for (const Asker& asker : std::exchange(joined_, {})) {
    asker.reply(
        TurnReply{message_of(row, side_of(by, asker.session.lock())), Repetition::duplicate});
  }
  for (const Seat seat : both_seats) {
    const auto session = session_of(seat);
    // Who asked has it in its reply; if that went to a connection that was taken over since, the
    // new one learns of it in this way.
    if (session && (seat != by || session != asked)) {
      session->push(message_of(row, side_of(seat, session)));
    }
  }
}

void LiveGame::tell_lost_turn(const storage::TurnRecord& row) {
  for (const Seat seat : both_seats) {
    if (const auto session = session_of(seat)) {
      session->push(lost_turn_of(row, side_of(seat, session)));
    }
  }
}

void LiveGame::tell_over() {
  for (const Seat seat : both_seats) {
    push(seat, over_of(record()));
  }
}

void LiveGame::agent_came(Seat seat) {
  const auto session = session_of(seat);
  if (!session) {
    return;
  }
  session->push(snapshot_for(seat));
  const bool own_turn = game_.state().to_move == seat;
  if (game_.phase() == Phase::thinking && own_turn) {
    session->push(turn_of(game_, clocks_of(game_, seat, steady_clock::now(), services_.time)));
    watch_flag();  // the lag of a new connection is another
  } else if (game_.phase() == Phase::due) {
    go_on();
  }
}

void LiveGame::sync(const Asker& asker, Seat seat) const {
  protocol::SyncReply<Outgoing> reply;
  reply.snapshot = snapshot_for(seat);
  if (game_.phase() == Phase::thinking && game_.state().to_move == seat) {
    reply.pending = turn_of(game_, reply.snapshot.clocks);
  }
  if (game_.phase() == Phase::over) {
    reply.over = over_of(record());
  }
  asker.reply(reply);
}

protocol::GameSnapshot<Outgoing> LiveGame::snapshot_for(Seat seat) const {
  protocol::GameSnapshot<Outgoing> snapshot;
  snapshot.terms = terms_of(record(), card_, seat);
  snapshot.state = {game_.state_json()};
  snapshot.clocks = clocks_of(game_, seat, steady_clock::now(), services_.time);
  return snapshot;
}

protocol::GameListing LiveGame::listing_for(Seat seat) const {
  return {.game = record().id,
          .match = record().match,
          .tournament = card_.tournament,
          .seat = seat,
          .opponent = card_.names[rules::index(rules::other(seat))],
          .status = game_.phase() == Phase::over ? protocol::GameStatus::over
                                                 : protocol::GameStatus::running};
}

std::optional<Seat> LiveGame::seat_of(storage::AgentId agent) const {
  for (const Seat seat : both_seats) {
    if (record().agents[rules::index(seat)] == agent) {
      return seat;
    }
  }
  return std::nullopt;
}

std::shared_ptr<Session> LiveGame::session_of(Seat seat) const {
  const Agent* agent = services_.book.find(record().agents[rules::index(seat)]);
  return agent == nullptr ? nullptr : agent->session.lock();
}

Side side_of(Seat seat, const std::shared_ptr<Session>& session) {
  return session ? Side{seat, session->detail(), session->event_bytes()} : Side{seat};
}

storage::Micros LiveGame::lag_of(Seat seat) const {
  const auto session = session_of(seat);
  return session ? session->lag() : storage::Micros{0};
}

void LiveGame::push(Seat seat, const Notification& notification) const {
  if (const auto session = session_of(seat)) {
    session->push(notification);
  }
}

void answer_from_row(const storage::TurnRecord& row, const Asker& asker, Seat seat,
                     const std::variant<protocol::Shot, protocol::Decide>& what) {
  const Side side = side_of(seat, asker.session.lock());
  const auto* shot = std::get_if<protocol::Shot>(&what);
  const auto conflict = shot != nullptr ? match::repeated_shot(row, seat, *shot)
                                        : match::repeated_decision(row, seat, std::get<1>(what));
  if (conflict) {
    asker.refuse(*conflict);
  } else if (shot != nullptr) {
    asker.reply(protocol::ShotReply<Outgoing>{shot_of(row, side), protocol::Repetition::duplicate});
  } else {
    asker.reply(
        protocol::DecideReply<Outgoing>{decision_of(row, side), protocol::Repetition::duplicate});
  }
}

}  // namespace poolhall::net
