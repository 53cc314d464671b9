#include "tests/bench/tie_proof.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/bench/event_runs.hpp"

namespace poolhall::bench {
namespace {

using physics::EventType;

TimedEvent event(EventType type, unsigned first, unsigned second, double t) {
  const auto id = [](unsigned n) { return physics::BallId{static_cast<std::uint8_t>(n)}; };
  return {{type, id(first), id(second), -1}, t, 1, t};
}

const TimedEvent rail_of_1 = event(EventType::rail_collision, 1, 1, 0.5);
const TimedEvent contact = event(EventType::ball_collision, 0, 2, 0.7);

TEST(Sequences, EqualOnesAreTheSameAndTellTheTimesErrors) {
  TimedEvent late = contact;
  late.t += 1e-9;
  const Sequence s = compare_sequences({rail_of_1, late}, {rail_of_1, contact});
  EXPECT_TRUE(s.same);
  EXPECT_FALSE(s.has_ties_in_another_order);
  ASSERT_EQ(s.time_errors.size(), 2u);
  EXPECT_NEAR(s.time_errors[1], 1e-9, 1e-15);
}

TEST(Sequences, EventsCloserThanATieMayComeInEitherOrderOthersNot) {
  TimedEvent close = contact, far = contact;
  close.t = rail_of_1.t + tie / 2;
  far.t = rail_of_1.t + 2 * tie;
  const Sequence tied = compare_sequences({close, rail_of_1}, {rail_of_1, close});
  EXPECT_TRUE(tied.same);
  EXPECT_TRUE(tied.has_ties_in_another_order);
  const Sequence apart = compare_sequences({far, rail_of_1}, {rail_of_1, far});
  EXPECT_FALSE(apart.same);
  EXPECT_FALSE(apart.has_ties_in_another_order);
}

TEST(Sequences, AnEventThatTheReferenceDoesNotHaveIsNoTie) {
  TimedEvent close = contact;
  close.t = rail_of_1.t + tie / 2;
  const TimedEvent stranger = event(EventType::pocketed, 3, 3, rail_of_1.t);
  const Sequence s = compare_sequences({stranger, rail_of_1}, {rail_of_1, close});
  EXPECT_FALSE(s.same);
  EXPECT_FALSE(s.has_ties_in_another_order);
}

test_support::RandomShot shot_with_two_balls() {
  return test_support::random_shot({.seed = 3,
                                    .balls = 2,
                                    .table = *physics::preset_table("olympiad"),
                                    .materials = *physics::preset_materials("olympiad")});
}

TEST(TieProof, WhatTheReferenceHasIsTheSame) {
  const auto shot = shot_with_two_balls();
  const auto truth = reference_simulate(reference_scene(shot), {});
  const auto run = played<double, physics::EventLoop<double>>(shot, physics::RootSolver::bracketed);
  EXPECT_EQ(verdict(shot, timed_events(run.events), truth), Verdict::same);
}

TEST(TieProof, AnOrderThatNoUlpGivesIsUnexplained) {
  const auto shot = shot_with_two_balls();
  const auto truth = reference_simulate(reference_scene(shot), {});
  auto found = timed_events(truth.events);
  ASSERT_GT(found.size(), 3u);
  std::swap(found[1], found[2]);
  EXPECT_EQ(verdict(shot, found, truth), Verdict::unexplained);
}

TEST(TieProof, EventsThatAnUlpBringsForthAreProven) {
  const auto shot = shot_with_two_balls();
  const auto truth = reference_simulate(reference_scene(shot), {});
  // As if the scene itself ended an event earlier, and all its neighbours did not.
  auto shorter = truth;
  shorter.events.pop_back();
  EXPECT_EQ(verdict(shot, timed_events(truth.events), shorter), Verdict::flips_under_an_ulp);
}

}  // namespace
}  // namespace poolhall::bench
