#include "server/match/clock.hpp"

#include <algorithm>
#include <cassert>

namespace poolhall::match {

Instant rounded_up(std::chrono::steady_clock::time_point t) {
  return std::chrono::ceil<Instant>(t.time_since_epoch());
}

Instant rounded_down(std::chrono::steady_clock::time_point t) {
  return std::chrono::floor<Instant>(t.time_since_epoch());
}

ClockSettings clock_settings(const storage::TermsRecord& terms) {
  return {.game_time = terms.clock,
          .increment = terms.increment,
          .shot_cap = terms.shot_cap,
          .lag_per_turn = terms.lag_per_turn,
          .lag_per_game = terms.lag_per_game};
}

GameClock::GameClock(const ClockSettings& settings)
    : GameClock(settings, {.left = {settings.game_time, settings.game_time},
                           .lag_left = {settings.lag_per_game, settings.lag_per_game}}) {}

GameClock::GameClock(const ClockSettings& settings, const Balance& balance)
    : settings_(settings), balance_(balance) {}

void GameClock::begin_turn(Seat seat, Instant now) {
  assert(!turn_);
  turn_ = Turn{.seat = seat, .since = now, .began = now, .time = {}};
}

// What may still be charged in this turn before it is lost.
Micros GameClock::limit() const {
  const Micros left = balance_.left[index(turn_->seat)];
  return settings_.shot_cap ? std::min(left, *settings_.shot_cap) : left;
}

// What of `lag` may still be forgiven in this turn.
Micros GameClock::forgivable(Micros lag) const {
  const Micros credit = std::min(settings_.lag_per_turn, balance_.lag_left[index(turn_->seat)]);
  return std::clamp(lag, Micros{0}, std::max(Micros{0}, credit - turn_->time.forgiven));
}

ClockVerdict GameClock::stop(Instant now, Micros lag) {
  assert(running());
  // The end of a stretch may be read before its beginning: they are rounded towards each other.
  const Micros stretch = std::max(Micros{0}, now - *turn_->since);
  const Micros forgiven = std::min(stretch, forgivable(lag));
  turn_->since.reset();
  turn_->time.used += stretch;
  turn_->time.forgiven += forgiven;
  if (turn_->time.charged() < limit())
    return ClockVerdict::in_time;
  return limit() == balance_.left[index(turn_->seat)] ? ClockVerdict::game_time_over
                                                      : ClockVerdict::shot_cap_over;
}

void GameClock::pause(Instant now) {
  assert(running());
  turn_->time.used += std::max(Micros{0}, now - *turn_->since);
  turn_->since.reset();
}

void GameClock::resume(Instant now) {
  assert(turn_ && !turn_->since);
  // A request may have been read before this stretch began, and be refused only now.
  turn_->began = std::max(turn_->began, now);
  turn_->since = turn_->began;
}

TurnTime GameClock::finish_turn() {
  assert(turn_ && !turn_->since);
  const TurnTime time = turn_->time;
  balance_ = after_turn(settings_, balance_, turn_->seat, time);
  turn_.reset();
  return time;
}

TurnTime GameClock::abandon_turn() {
  assert(turn_ && !turn_->since);
  const TurnTime time = turn_->time;
  balance_ = after_charge(settings_, balance_, turn_->seat, time);
  turn_.reset();
  return time;
}

std::optional<Instant> GameClock::expires(Micros lag) const {
  if (!running())
    return std::nullopt;
  const Micros remaining = std::max(Micros{0}, limit() - turn_->time.charged());
  return *turn_->since + remaining + (remaining > Micros{0} ? forgivable(lag) : Micros{0});
}

TurnTime GameClock::turn_so_far(Instant now) const {
  if (!turn_)
    return {};
  TurnTime time = turn_->time;
  if (turn_->since)
    time.used += std::max(Micros{0}, now - *turn_->since);
  return time;
}

Micros GameClock::left(Seat seat, Instant now) const {
  const Micros before = balance_.left[index(seat)];
  if (!turn_ || turn_->seat != seat)
    return before;
  return std::max(Micros{0}, before - turn_so_far(now).charged());
}

GameClock::Balance after_charge(const ClockSettings& settings, GameClock::Balance balance,
                                Seat seat, const TurnTime& time) {
  Micros& left = balance.left[index(seat)];
  Micros charged = std::min(time.charged(), left);
  if (settings.shot_cap)
    charged = std::min(charged, *settings.shot_cap);
  left -= charged;
  balance.lag_left[index(seat)] -= time.forgiven;
  return balance;
}

GameClock::Balance after_turn(const ClockSettings& settings, GameClock::Balance balance, Seat seat,
                              const TurnTime& time) {
  GameClock::Balance after = after_charge(settings, balance, seat, time);
  Micros& left = after.left[index(seat)];
  if (left > Micros{0})
    left += settings.increment;
  return after;
}

}  // namespace poolhall::match
