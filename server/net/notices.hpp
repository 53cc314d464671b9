// Games and stored turns as messages, each from its reader's side. Pure: nothing is sent here.
//
//   Side to{.seat = Seat::second, .detail = EventDetail::summary};
//   session.push(shot_of(row, to));
#pragma once

#include <optional>
#include <string>

#include "protocol/limits.hpp"
#include "protocol/messages.hpp"
#include "server/match/game.hpp"
#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

using protocol::Outgoing;
using rules::Seat;

// Who reads: from which side, in what detail.
struct Side {
  Seat seat = Seat::first;
  protocol::EventDetail detail = protocol::EventDetail::full;
  // Of a shot's events, so that the line is no longer than the server's lines may be: a longer log
  // goes without its states, and one that is still too long goes empty.
  std::size_t event_bytes = protocol::Limits{}.server_line_bytes;
};

// What every message of a game's terms says alike.
struct GameCard {
  std::optional<protocol::TournamentId> tournament{};
  std::array<std::string, 2> names;  // by seat
  std::string table;                 // JSON
  std::string materials;             // JSON
};
[[nodiscard]] GameCard card_of(const match::Board& board, std::array<std::string, 2> names,
                               std::optional<protocol::TournamentId> tournament);

// The scale of time_ms: milliseconds since 1970 as they were when the server started, counted on
// by the monotonic clock.
class WireTime {
 public:
  WireTime();
  [[nodiscard]] std::int64_t ms(SteadyTime t) const;

 private:
  std::chrono::microseconds offset_;
};

[[nodiscard]] protocol::GameTerms<Outgoing> terms_of(const storage::GameRecord& game,
                                                     const GameCard& card, Seat reader);
// Both clocks at `now`, with the deadline of the one that runs.
[[nodiscard]] protocol::ClockReading clocks_of(const match::Game& game, Seat reader, SteadyTime now,
                                               const WireTime& time);
// As they will stand when a due turn begins at `now`.
[[nodiscard]] protocol::ClockReading clocks_if_begun(const match::Game& game, Seat reader,
                                                     SteadyTime now, const WireTime& time);
// As a stored turn left them.
[[nodiscard]] protocol::ClockReading clocks_after(const storage::TurnRecord& row, Seat reader);

[[nodiscard]] protocol::GameTurn<Outgoing> turn_of(const match::Game& game,
                                                   const protocol::ClockReading& clocks);
[[nodiscard]] protocol::GameShot<Outgoing> shot_of(const storage::TurnRecord& row,
                                                   const Side& reader);
[[nodiscard]] protocol::GameDecision<Outgoing> decision_of(const storage::TurnRecord& row,
                                                           const Side& reader);
[[nodiscard]] protocol::GameTurnLost<Outgoing> lost_turn_of(const storage::TurnRecord& row,
                                                            const Side& reader);
// Of a game that is over.
[[nodiscard]] protocol::GameOver over_of(const storage::GameRecord& game);
[[nodiscard]] protocol::GameSeeds seeds_of(const storage::GameRecord& game);

// The terms as an agent asks for them, in the record's units.
[[nodiscard]] protocol::ClockSettings clock_settings_of(const storage::TermsRecord& terms);

}  // namespace poolhall::net
