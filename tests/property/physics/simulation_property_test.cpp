#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "physics/event_loop.hpp"
#include "tests/support/random_shots.hpp"
#include "tests/support/scenes.hpp"

namespace poolhall::test_support {
namespace {

using namespace physics;

RandomShot any_shot(std::uint64_t seed, std::string_view table = "olympiad",
                    std::string_view kind = "olympiad") {
  return random_shot({.seed = seed,
                      .balls = 2 + seed % 15,
                      .table = *preset_table(table),
                      .materials = *preset_materials(kind)});
}

RandomShot any_break(std::uint64_t seed, std::string_view table, std::string_view kind) {
  return random_break({.seed = seed,
                       .gap = seed % 2 == 0 ? 0 : 1e-4,
                       .table = *preset_table(table),
                       .materials = *preset_materials(kind)});
}

// Replays the log by the motion laws alone and holds the balls against each other at each event.
double worst_overlap(const Scene<double>& scene, const Simulation<double>& result) {
  const auto c = coefficients<double>(scene.materials);
  std::array<Segment<double>, max_balls> path{};
  std::array<bool, max_balls> there{};
  for (const auto& ball : scene.balls) {
    path[number(ball.id)] = segment(ball, {}, c);
    there[number(ball.id)] = true;
  }
  double worst = 0;
  for (const auto& event : result.events) {
    const double now = event.until.value_or(event.t);
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      const auto& ball = event.after[i];
      path[number(ball.id)] = segment(ball, Instant<double>{now, 0}, c);
      there[number(ball.id)] = !ball.pocket;
    }
    for (std::size_t i = 0; i < max_balls; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double t = event.t - std::max(path[i].start.high, path[k].start.high);
        if (there[i] && there[k] && t >= 0) {
          const auto d = position_at(path[i], event.t - path[i].start.high) -
                         position_at(path[k], event.t - path[k].start.high);
          worst = std::max(worst, c.diameter - length(d));
        }
      }
    }
  }
  return worst;
}

void hold_invariants(const RandomShot& shot, ContactModel contact) {
  const Scene<double> scene = scene_of(shot);
  const auto result = simulate(scene, {.contact = contact});
  RC_ASSERT(result.has_value());
  RC_ASSERT(result->ending == Ending::at_rest);
  RC_ASSERT(broken_invariant(scene, *result) == "");
  RC_ASSERT(worst_overlap(scene, *result) < 1e-12);
  double before = 0;
  for (const auto& event : result->events) {
    RC_ASSERT(event.t >= before);
    before = event.t;
  }
}

RC_GTEST_PROP(Simulation, HoldsItsInvariantsOnEveryTable, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const bool jaws = *rc::gen::arbitrary<bool>();
  const bool modern = *rc::gen::arbitrary<bool>();
  const auto contact = *rc::gen::element(ContactModel::cluster, ContactModel::sequential);
  const auto* table = jaws ? "wpa9" : "olympiad";
  const auto* kind = modern ? "modern" : "olympiad";
  hold_invariants(any_shot(seed, table, kind), contact);
  hold_invariants(any_break(seed, table, kind), contact);
}

template <Omission omission>
void expect_no_bit_changed(const Scene<double>& scene) {
  Recorder<double> all, without;
  EventLoop<double> lean(scene.table, scene.materials);
  EventLoop<double, LeanWithout<omission>> full(scene.table, scene.materials);
  RC_ASSERT(lean.run(scene.balls, scene.shot, {}, all) ==
            full.run(scene.balls, scene.shot, {}, without));
  const auto p = all.take();
  const auto q = without.take();
  RC_ASSERT(p.size() == q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    RC_ASSERT(p[i].t == q[i].t);
    RC_ASSERT(p[i].after[0].position == q[i].after[0].position);
    RC_ASSERT(p[i].after[0].velocity == q[i].after[0].velocity);
    RC_ASSERT(p[i].after[0].angular_velocity == q[i].after[0].angular_velocity);
  }
}

RC_GTEST_PROP(Lean, NoOmissionChangesABit, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  RandomShot shot = any_shot(seed, seed % 3 == 0 ? "bar7" : "olympiad");
  if (seed % 2 == 0) {
    shot.materials.ball_friction = ConstantFriction{0};
  }
  for (const Scene<double>& scene :
       {scene_of(shot), scene_of(any_break(seed, "olympiad", "olympiad"))}) {
    expect_no_bit_changed<Omission::pairs_at_rest>(scene);
    expect_no_bit_changed<Omission::far_pairs>(scene);
    expect_no_bit_changed<Omission::clear_pairs>(scene);
    expect_no_bit_changed<Omission::far_rails>(scene);
    expect_no_bit_changed<Omission::ball_friction>(scene);
    expect_no_bit_changed<Omission::far_neighbours>(scene);
  }
}

}  // namespace
}  // namespace poolhall::test_support
