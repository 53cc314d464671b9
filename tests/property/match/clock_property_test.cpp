#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/match/clock.hpp"

namespace poolhall::match {
namespace {

ClockSettings any_settings() {
  ClockSettings settings{.game_time = Micros{*rc::gen::inRange(1, 5000)},
                         .increment = Micros{*rc::gen::inRange(0, 100)},
                         .shot_cap = {},
                         .lag_per_turn = Micros{*rc::gen::inRange(0, 60)},
                         .lag_per_game = Micros{*rc::gen::inRange(0, 300)}};
  if (*rc::gen::arbitrary<bool>())
    settings.shot_cap = Micros{*rc::gen::inRange(1, 2000)};
  return settings;
}

// A turn in one to four stretches with waits in between; what really passed for the player.
struct PlayedTime {
  Micros passed{0};
  ClockVerdict verdict = ClockVerdict::in_time;
};
PlayedTime play_turn(GameClock& clock, Seat seat, Instant& now, Micros& lag_seen) {
  PlayedTime played;
  clock.begin_turn(seat, now);
  const int stretches = *rc::gen::inRange(1, 5);
  for (int i = 0; i < stretches && played.verdict == ClockVerdict::in_time; ++i) {
    if (i > 0) {
      now += Micros{*rc::gen::inRange(0, 1000)};  // the server's own time
      clock.resume(now);
    }
    const Micros thought{*rc::gen::inRange(0, 800)};
    const Micros lag{*rc::gen::inRange(0, 120)};
    now += thought;
    played.passed += thought;
    lag_seen += std::min(lag, thought);
    played.verdict = clock.stop(now, lag);
  }
  return played;
}

RC_GTEST_PROP(GameClock, accounts_for_every_microsecond, ()) {
  const ClockSettings settings = any_settings();
  GameClock clock(settings);
  Instant now{*rc::gen::inRange(0, 1'000'000)};
  std::array<Micros, 2> charged{};
  std::array<Micros, 2> forgiven{};
  std::array<Micros, 2> increments{};
  for (int turn = 0; turn < 20; ++turn) {
    const Seat seat = *rc::gen::element(Seat::first, Seat::second);
    Micros lag_seen{0};
    const PlayedTime played = play_turn(clock, seat, now, lag_seen);
    const Micros before = clock.balance().left[index(seat)];
    const TurnTime time = clock.finish_turn();
    const Micros after = clock.balance().left[index(seat)];
    RC_ASSERT(time.used == played.passed);
    RC_ASSERT(time.forgiven >= Micros{0});
    RC_ASSERT(time.forgiven <= std::min(lag_seen, settings.lag_per_turn));
    forgiven[index(seat)] += time.forgiven;
    RC_ASSERT(forgiven[index(seat)] <= settings.lag_per_game);
    RC_ASSERT(clock.balance().lag_left[index(seat)] ==
              settings.lag_per_game - forgiven[index(seat)]);
    RC_ASSERT((played.verdict == ClockVerdict::game_time_over) == (after == Micros{0}));
    if (played.verdict == ClockVerdict::in_time)
      RC_ASSERT(after == before - time.charged() + settings.increment);
    RC_ASSERT(after >= Micros{0});
    if (after == Micros{0})
      return;
    charged[index(seat)] += before + settings.increment - after;
    increments[index(seat)] += settings.increment;
    RC_ASSERT(after == settings.game_time + increments[index(seat)] - charged[index(seat)]);
  }
}

RC_GTEST_PROP(GameClock, stops_in_time_exactly_before_the_instant_at_which_it_expires, ()) {
  const ClockSettings settings = any_settings();
  GameClock clock(settings);
  Instant now{*rc::gen::inRange(0, 1'000'000)};
  clock.begin_turn(Seat::first, now);
  if (*rc::gen::arbitrary<bool>()) {
    now += Micros{*rc::gen::inRange(0, 500)};
    if (clock.stop(now, Micros{*rc::gen::inRange(0, 120)}) != ClockVerdict::in_time)
      return;
    now += Micros{*rc::gen::inRange(0, 500)};
    clock.resume(now);
  }
  const Micros lag{*rc::gen::inRange(0, 120)};
  const Instant expires = clock.expires(lag).value();
  GameClock early = clock;
  if (expires - Instant{1} >= now)
    RC_ASSERT(early.stop(expires - Instant{1}, lag) == ClockVerdict::in_time);
  GameClock late = clock;
  RC_ASSERT(late.stop(expires, lag) != ClockVerdict::in_time);
  RC_ASSERT(clock.left(Seat::first, expires) <= std::max(Micros{0}, settings.game_time));
}

RC_GTEST_PROP(GameClock, goes_on_after_a_restart_as_if_there_had_been_none, ()) {
  const ClockSettings settings = any_settings();
  GameClock clock(settings);
  Instant now{0};
  Micros lag_seen{0};
  const PlayedTime first = play_turn(clock, Seat::first, now, lag_seen);
  static_cast<void>(clock.finish_turn());
  if (first.verdict != ClockVerdict::in_time)
    return;
  GameClock restarted(settings, clock.balance());
  const Micros think{*rc::gen::inRange(0, 3000)};
  clock.begin_turn(Seat::first, now);
  restarted.begin_turn(Seat::first, Instant{77});
  RC_ASSERT(clock.stop(now + think, Micros{10}) == restarted.stop(Instant{77} + think, Micros{10}));
  static_cast<void>(clock.finish_turn());
  static_cast<void>(restarted.finish_turn());
  RC_ASSERT(clock.balance() == restarted.balance());
}

}  // namespace
}  // namespace poolhall::match
