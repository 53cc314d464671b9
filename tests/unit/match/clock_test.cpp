#include "server/match/clock.hpp"

#include <gtest/gtest.h>

namespace poolhall::match {
namespace {

using std::chrono::microseconds;

constexpr Micros no_lag{0};
constexpr ClockSettings settings{.game_time = Micros{1000},
                                 .increment = Micros{10},
                                 .shot_cap = {},
                                 .lag_per_turn = Micros{50},
                                 .lag_per_game = Micros{120}};

Micros left(const GameClock& clock, Seat seat) {
  return clock.balance().left[index(seat)];
}

TEST(GameClock, charges_the_player_to_move_and_adds_the_increment) {
  GameClock clock(settings);
  clock.begin_turn(Seat::second, Instant{5});
  EXPECT_EQ(clock.stop(Instant{305}, no_lag), ClockVerdict::in_time);
  const TurnTime time = clock.finish_turn();
  EXPECT_EQ(time.used, Micros{300});
  EXPECT_EQ(left(clock, Seat::second), Micros{710});
  EXPECT_EQ(left(clock, Seat::first), Micros{1000});
}

TEST(GameClock, leaves_out_what_passes_while_it_is_stopped) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.stop(Instant{100}, no_lag), ClockVerdict::in_time);
  clock.resume(Instant{5000});
  EXPECT_EQ(clock.stop(Instant{5200}, no_lag), ClockVerdict::in_time);
  EXPECT_EQ(clock.finish_turn().used, Micros{300});
}

TEST(GameClock, does_not_charge_again_what_passed_before_a_stretch_began) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{1000});
  EXPECT_EQ(clock.stop(Instant{400}, no_lag), ClockVerdict::in_time);  // read before it was due
  clock.resume(Instant{400});
  EXPECT_EQ(clock.stop(Instant{1100}, no_lag), ClockVerdict::in_time);
  EXPECT_EQ(clock.finish_turn().used, Micros{100});
}

TEST(GameClock, falls_when_nothing_is_left) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.expires(no_lag), Instant{1000});
  EXPECT_EQ(clock.stop(Instant{1000}, no_lag), ClockVerdict::game_time_over);
  EXPECT_EQ(clock.finish_turn().used, Micros{1000});
  EXPECT_EQ(left(clock, Seat::first), Micros{0});
}

TEST(GameClock, has_time_to_the_last_microsecond) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.stop(Instant{999}, no_lag), ClockVerdict::in_time);
}

TEST(GameClock, loses_the_turn_at_the_cap_and_charges_no_more_than_it) {
  ClockSettings capped = settings;
  capped.shot_cap = Micros{200};
  GameClock clock(capped);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.expires(no_lag), Instant{200});
  EXPECT_EQ(clock.stop(Instant{260}, no_lag), ClockVerdict::shot_cap_over);
  static_cast<void>(clock.finish_turn());
  EXPECT_EQ(left(clock, Seat::first), Micros{810});
}

TEST(GameClock, loses_the_game_where_the_cap_and_the_game_end_together) {
  ClockSettings capped = settings;
  capped.shot_cap = Micros{1000};
  GameClock clock(capped);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.stop(Instant{1000}, no_lag), ClockVerdict::game_time_over);
}

TEST(GameClock, forgives_lag_within_the_turns_credit) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.expires(Micros{80}), Instant{1050});
  EXPECT_EQ(clock.stop(Instant{100}, Micros{30}), ClockVerdict::in_time);
  clock.resume(Instant{200});
  EXPECT_EQ(clock.stop(Instant{300}, Micros{30}), ClockVerdict::in_time);
  const TurnTime time = clock.finish_turn();
  EXPECT_EQ(time.used, Micros{200});
  EXPECT_EQ(time.forgiven, Micros{50});
}

TEST(GameClock, forgives_no_more_lag_than_the_games_credit) {
  GameClock clock(settings);
  Micros forgiven{0};
  for (int turn = 0; turn < 5; ++turn) {
    clock.begin_turn(Seat::first, Instant{1000 * turn});
    ASSERT_EQ(clock.stop(Instant{1000 * turn + 60}, Micros{50}), ClockVerdict::in_time);
    forgiven += clock.finish_turn().forgiven;
  }
  EXPECT_EQ(forgiven, Micros{120});
  EXPECT_EQ(clock.balance().lag_left[0], Micros{0});
  EXPECT_EQ(clock.balance().lag_left[1], Micros{120});
}

TEST(GameClock, forgives_no_more_than_was_used) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  EXPECT_EQ(clock.stop(Instant{20}, Micros{50}), ClockVerdict::in_time);
  EXPECT_EQ(clock.finish_turn().forgiven, Micros{20});
}

TEST(GameClock, goes_on_from_a_stored_balance) {
  const GameClock::Balance stored{.left = {Micros{7}, Micros{8}},
                                  .lag_left = {Micros{9}, Micros{10}}};
  GameClock clock(settings, stored);
  EXPECT_FALSE(clock.in_turn());
  EXPECT_EQ(clock.balance(), stored);
  clock.begin_turn(Seat::second, Instant{100});
  EXPECT_EQ(clock.expires(Micros{50}), Instant{118});
}

TEST(GameClock, adds_no_increment_to_a_turn_that_the_game_ended_in) {
  GameClock clock(settings);
  clock.begin_turn(Seat::first, Instant{0});
  ASSERT_EQ(clock.stop(Instant{100}, no_lag), ClockVerdict::in_time);
  static_cast<void>(clock.abandon_turn());
  EXPECT_EQ(left(clock, Seat::first), Micros{900});
}

TEST(GameClock, rounds_starts_up_and_stops_down) {
  const std::chrono::steady_clock::time_point t{std::chrono::nanoseconds{1500}};
  EXPECT_EQ(rounded_up(t), Instant{2});
  EXPECT_EQ(rounded_down(t), Instant{1});
}

}  // namespace
}  // namespace poolhall::match
