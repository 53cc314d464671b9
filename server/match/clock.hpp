// A game's two clocks as a pure state machine in integer microseconds. It reads no clock: instants
// are arguments.
//
//   GameClock clock{settings};
//   clock.begin_turn(Seat::first, now);                     // the turn was handed to its queue
//   ClockVerdict verdict = clock.stop(arrived, lag);        // a complete line was read
//   if (refused) clock.resume(now);                         // the refusal was handed to the queue
//   TurnTime time = clock.finish_turn();                    // played: charged, increment added
//
// Only the time between begin_turn or resume and stop is charged: whatever the server does in
// between is its own. Of each such stretch the measured lag is forgiven, as far as the turn's
// credit and the game's allow. Rounding: start instants with rounded_up, stop instants with
// rounded_down, so that it is never against the player.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "rules/game_state.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

using rules::Seat;
using storage::Micros;
using Instant = std::chrono::microseconds;  // since the epoch of the server's monotonic clock

[[nodiscard]] Instant rounded_up(std::chrono::steady_clock::time_point t);
[[nodiscard]] Instant rounded_down(std::chrono::steady_clock::time_point t);

struct ClockSettings {
  Micros game_time{600'000'000};     // each player has
  Micros increment{0};               // added after each finished turn
  std::optional<Micros> shot_cap{};  // longest turn; past it the turn is lost
  Micros lag_per_turn{100'000};      // most lag forgiven in a turn
  Micros lag_per_game{5'000'000};    // and by each player's game
};
[[nodiscard]] ClockSettings clock_settings(const storage::TermsRecord& terms);

enum class ClockVerdict : std::uint8_t {
  in_time,
  game_time_over,  // the game is lost
  shot_cap_over,   // the turn is lost
};

struct TurnTime {
  Micros used{0};      // by the player, lag included
  Micros forgiven{0};  // of it
  [[nodiscard]] Micros charged() const { return used - forgiven; }
};

class GameClock {
 public:
  // What a stored turn leaves of the clocks, by seat.
  struct Balance {
    std::array<Micros, 2> left{};
    std::array<Micros, 2> lag_left{};

    friend bool operator==(const Balance&, const Balance&) = default;
  };

  explicit GameClock(const ClockSettings& settings);
  // As the last durable turn left them; no turn is under way.
  GameClock(const ClockSettings& settings, const Balance& balance);

  // No turn may be under way.
  void begin_turn(Seat seat, Instant now);

  // The clock must run. Decides whether what was read at `now` came in time.
  [[nodiscard]] ClockVerdict stop(Instant now, Micros lag);
  // Stops the running clock for the server's own reasons: no verdict, no lag.
  void pause(Instant now);
  // The clock must be stopped in a turn.
  void resume(Instant now);
  // Ends the turn, whose clock must be stopped, and adds the increment. After `game_time_over`
  // nothing is left and there is no increment.
  TurnTime finish_turn();
  // Ends the turn with the game: charged, no increment.
  TurnTime abandon_turn();

  // When the running clock will have come to its end, if that lag is forgiven; unset while it
  // stands. At that instant stop() gives no in_time.
  [[nodiscard]] std::optional<Instant> expires(Micros lag) const;

  // What the player has left at `now`, lag not counted; never below zero.
  [[nodiscard]] Micros left(Seat seat, Instant now) const;
  [[nodiscard]] TurnTime turn_so_far(Instant now) const;
  // Between turns: complete. Within a turn: as before it.
  [[nodiscard]] const Balance& balance() const { return balance_; }
  [[nodiscard]] const ClockSettings& settings() const { return settings_; }
  [[nodiscard]] bool in_turn() const { return turn_.has_value(); }
  [[nodiscard]] bool running() const { return turn_ && turn_->since; }

 private:
  struct Turn {
    Seat seat = Seat::first;
    std::optional<Instant> since{};  // unset: stopped
    Instant began{};                 // of this stretch or the last: time does not run backwards
    TurnTime time;
  };

  [[nodiscard]] Micros limit() const;
  [[nodiscard]] Micros forgivable(Micros lag) const;

  ClockSettings settings_;
  Balance balance_;
  std::optional<Turn> turn_{};
};

// The balance when a turn of `seat` has taken that time: charged at most what there was and at most
// the cap.
[[nodiscard]] GameClock::Balance after_charge(const ClockSettings& settings,
                                              GameClock::Balance balance, Seat seat,
                                              const TurnTime& time);
// Likewise, with the increment unless nothing is left.
[[nodiscard]] GameClock::Balance after_turn(const ClockSettings& settings,
                                            GameClock::Balance balance, Seat seat,
                                            const TurnTime& time);

}  // namespace poolhall::match
