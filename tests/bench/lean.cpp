// What each omission saves, with the same result bit for bit.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>

#include "physics/ball_collision.hpp"
#include "physics/event_loop.hpp"
#include "physics/watch.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/timing.hpp"
#include "tests/support/random_shots.hpp"

namespace poolhall::bench {

namespace {

using physics::EventLoop;
using physics::Omission;
using test_support::RandomShot;

// What an omission is measured on.
struct Play {
  std::size_t balls = 16;  // 0: breaks, 16 balls
  physics::ContactModel contact = physics::ContactModel::cluster;
};

std::vector<physics::Scene<double>> scenes_of(const Play& play, const BenchOptions& options) {
  const physics::Materials materials = *physics::preset_materials("olympiad");
  const physics::Table table = *physics::preset_table("bar7");
  std::vector<physics::Scene<double>> scenes;
  for (std::size_t i = 0; i < scaled_count(play.balls == 0 ? 300 : 1000, options); ++i) {
    const std::uint64_t seed = options.seed * 8'000'000 + i;
    scenes.push_back(test_support::scene_of(
        play.balls == 0
            ? test_support::random_break({.seed = seed, .table = table, .materials = materials})
            : test_support::random_shot(
                  {.seed = seed, .balls = play.balls, .table = table, .materials = materials})));
  }
  return scenes;
}

bool same_bits(const physics::Vec2<double>& p, const physics::Vec2<double>& q) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return bits(p.x) == bits(q.x) && bits(p.y) == bits(q.y);
}

bool same_bits(const physics::BallSet<double>& p, const physics::BallSet<double>& q) {
  for (std::size_t i = 0; i < p.count; ++i) {
    if (!same_bits(p[i].position, q[i].position) || p[i].pocket != q[i].pocket) {
      return false;
    }
  }
  return true;
}

struct Timed {
  double microseconds = 0;
  physics::BallSet<double> balls;
};

template <class Loop, class Watch>
Timed timed(Loop& loop, const physics::Scene<double>& scene, physics::ContactModel contact,
            Watch watch) {
  Timed best;
  best.microseconds = least_microseconds(15, [&] {
    Watch fresh = watch;
    static_cast<void>(loop.run(scene.balls, scene.shot, {.contact = contact}, fresh));
  });
  best.balls = loop.balls();
  return best;
}

std::string words(const Play& play) {
  return (play.balls == 0 ? "break" : std::to_string(play.balls) + " balls") +
         (play.contact == physics::ContactModel::sequential ? ", sequential" : "");
}

// Means of the least of some runs: a median would hide what only some shots save.
double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

// Runs the scenes with and without the omission, one after the other, so that both see the same
// machine.
template <Omission omission>
bool measure(const std::string& name, const Play& play, const BenchOptions& options,
             ReportTable& table) {
  std::vector<double> with, without;
  bool same = true;
  for (const auto& scene : scenes_of(play, options)) {
    EventLoop<double> lean(scene.table, scene.materials);
    EventLoop<double, physics::LeanWithout<omission>> full(scene.table, scene.materials);
    const Timed quick = timed(lean, scene, play.contact, physics::Unwatched{});
    const Timed slow = timed(full, scene, play.contact, physics::Unwatched{});
    same = same && same_bits(quick.balls, slow.balls);
    with.push_back(quick.microseconds);
    without.push_back(slow.microseconds);
  }
  const double quick = mean(with);
  const double slow = mean(without);
  table.add({name, words(play), cell(slow, 4), cell(quick, 4), cell(slow / quick, 4),
             same ? "yes" : "no"});
  return same && slow > quick;
}

using BallPair = std::array<physics::Ball<double>, 2>;

// Moving balls that touch, at any angle.
std::vector<BallPair> touching_pairs(double radius) {
  std::vector<BallPair> pairs(1000);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double n = static_cast<double>(i);
    auto& [first, second] = pairs[i];
    second.position = {2 * radius * std::cos(n), 2 * radius * std::sin(n)};
    first.velocity = {2 * std::cos(n + std::sin(3 * n)), 2 * std::sin(n + std::sin(3 * n))};
    first.angular_velocity = {30 * std::sin(n), 40 * std::cos(2 * n), 20 * std::sin(5 * n)};
    second.angular_velocity = {10 * std::cos(n), 20 * std::sin(7 * n), 30 * std::cos(3 * n)};
  }
  return pairs;
}

template <class Policy>
double microseconds_an_impact(std::vector<BallPair>& pairs, const physics::Materials& materials) {
  const auto c = physics::coefficients<double>(materials);
  const std::vector<BallPair> before = pairs;
  const double all = least_microseconds(300, [&] {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      pairs[i] = before[i];
      static_cast<void>(
          physics::strike_together<Policy>(pairs[i][0], pairs[i][1], c, materials.ball_friction));
    }
  });
  return all / static_cast<double>(pairs.size());
}

// In a whole shot this is less than two runs of one program differ by: impacts alone show it.
bool measure_friction(ReportTable& table) {
  physics::Materials materials = *physics::preset_materials("olympiad");
  materials.ball_friction = physics::ConstantFriction{0};
  std::vector<BallPair> lean = touching_pairs(materials.ball_radius);
  std::vector<BallPair> full = lean;
  const double quick = microseconds_an_impact<physics::Lean>(lean, materials);
  const double slow =
      microseconds_an_impact<physics::LeanWithout<Omission::ball_friction>>(full, materials);
  bool same = true;
  for (std::size_t i = 0; i < lean.size(); ++i) {
    for (const std::size_t k : {0U, 1U}) {
      same = same && lean[i][k].velocity == full[i][k].velocity &&
             lean[i][k].angular_velocity == full[i][k].angular_velocity;
    }
  }
  table.add({"ball friction of 0", "an impact, mu_b 0", cell(slow, 4), cell(quick, 4),
             cell(slow / quick, 4), same ? "yes" : "no"});
  return same && slow > quick;
}

// Questions that need less than a whole shot.
template <class Watch>
bool measure_question(const std::string& name, const Watch& question, const BenchOptions& options,
                      ReportTable& table) {
  const Play play;
  std::vector<double> asked, logged;
  for (const auto& scene : scenes_of(play, options)) {
    EventLoop<double> loop(scene.table, scene.materials);
    logged.push_back(timed(loop, scene, play.contact, physics::Recorder<double>{}).microseconds);
    asked.push_back(timed(loop, scene, play.contact, question).microseconds);
  }
  const double quick = mean(asked);
  const double slow = mean(logged);
  table.add({name, words(play), cell(slow, 4), cell(quick, 4), cell(slow / quick, 4),
             "against a whole shot with its log"});
  return slow > quick;
}

}  // namespace

bool bench_lean(const BenchOptions& options, std::ostream& out) {
  ReportTable table("What a scene does not need (table bar7, mean us a shot or an impact)",
                    {"omission", "measured on", "computed", "omitted", "ratio", "same bits"});
  constexpr auto one_by_one = physics::ContactModel::sequential;
  bool held = true;
  held &= measure<Omission::pairs_at_rest>("pairs at rest", {}, options, table);
  held &= measure<Omission::far_pairs>("far pairs", {}, options, table);
  held &= measure<Omission::clear_pairs>("clear pairs", {.balls = 0, .contact = one_by_one},
                                         options, table);
  held &= measure<Omission::far_rails>("far rails and jaws", {.balls = 2}, options, table);
  held &= measure_friction(table);
  held &= measure<Omission::far_neighbours>("clusters without a third ball", {}, options, table);
  held &= measure_question("no log", physics::Unwatched{}, options, table);
  held &= measure_question("first contact only", physics::FirstContact{physics::cue_ball, {}},
                           options, table);
  held &= measure_question("will ball 1 be pocketed",
                           physics::WillBePocketed{physics::BallId{1}, {}}, options, table);
  table.print(out);
  table.write_csv(options.directory / "lean.csv");
  out << "  goal: each gives the same bits and saves something\n\n";
  return held;
}

}  // namespace poolhall::bench
