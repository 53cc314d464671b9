// What each omission saves, with the same result bit for bit.
#include <cstring>
#include <ostream>

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

std::vector<physics::Scene<double>> scenes_with(std::size_t balls, bool friction,
                                                const BenchOptions& options) {
  physics::Materials materials = *physics::preset_materials("olympiad");
  if (!friction) {
    materials.ball_friction = physics::ConstantFriction{0};
  }
  const physics::Table table = *physics::preset_table("bar7");
  std::vector<physics::Scene<double>> scenes;
  for (std::size_t i = 0; i < scaled_count(1000, options); ++i) {
    scenes.push_back(
        test_support::scene_of(test_support::random_shot({.seed = options.seed * 8'000'000 + i,
                                                          .balls = balls,
                                                          .table = table,
                                                          .materials = materials})));
  }
  return scenes;
}

bool same_bits(const physics::BallSet<double>& p, const physics::BallSet<double>& q) {
  for (std::size_t i = 0; i < p.count; ++i) {
    if (std::memcmp(&p[i].position, &q[i].position, sizeof p[i].position) != 0 ||
        p[i].pocket != q[i].pocket) {
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
Timed timed(Loop& loop, const physics::Scene<double>& scene, Watch watch) {
  Timed best;
  best.microseconds = least_microseconds(7, [&] {
    Watch fresh = watch;
    static_cast<void>(loop.run(scene.balls, scene.shot, {}, fresh));
  });
  best.balls = loop.balls();
  return best;
}

// Runs the scenes with and without the omission, one after the other, so that both see the same
// machine.
template <Omission omission>
bool measure(const std::string& name, std::size_t balls, bool friction, const BenchOptions& options,
             ReportTable& table) {
  std::vector<double> with, without;
  bool same = true;
  for (const auto& scene : scenes_with(balls, friction, options)) {
    EventLoop<double> lean(scene.table, scene.materials);
    EventLoop<double, physics::LeanWithout<omission>> full(scene.table, scene.materials);
    const Timed quick = timed(lean, scene, physics::Unwatched{});
    const Timed slow = timed(full, scene, physics::Unwatched{});
    same = same && same_bits(quick.balls, slow.balls);
    with.push_back(quick.microseconds);
    without.push_back(slow.microseconds);
  }
  const double quick = quantile(with, .5);
  const double slow = quantile(without, .5);
  table.add({name, std::to_string(balls), cell(slow), cell(quick), cell(slow / quick),
             same ? "yes" : "no"});
  return same && slow > quick;
}

// Questions that need less than a whole shot.
template <class Watch>
bool measure_question(const std::string& name, std::size_t balls, const Watch& question,
                      const BenchOptions& options, ReportTable& table) {
  std::vector<double> asked, logged;
  for (const auto& scene : scenes_with(balls, true, options)) {
    EventLoop<double> loop(scene.table, scene.materials);
    logged.push_back(timed(loop, scene, physics::Recorder<double>{}).microseconds);
    asked.push_back(timed(loop, scene, question).microseconds);
  }
  const double quick = quantile(asked, .5);
  const double slow = quantile(logged, .5);
  table.add({name, std::to_string(balls), cell(slow), cell(quick), cell(slow / quick),
             "against a whole shot with its log"});
  return slow > quick;
}

}  // namespace

bool bench_lean(const BenchOptions& options, std::ostream& out) {
  ReportTable table("What a scene does not need (table bar7, median us a shot)",
                    {"omission", "balls", "computed", "omitted", "ratio", "same bits"});
  bool held = true;
  held &= measure<Omission::pairs_at_rest>("pairs at rest", 16, true, options, table);
  held &= measure<Omission::far_pairs>("far pairs", 16, true, options, table);
  held &= measure<Omission::clear_pairs>("clear pairs", 16, true, options, table);
  held &= measure<Omission::far_rails>("far rails and jaws", 2, true, options, table);
  held &= measure<Omission::ball_friction>("ball friction of 0", 16, false, options, table);
  held &=
      measure<Omission::far_neighbours>("clusters without a third ball", 16, true, options, table);
  held &= measure_question("no log", 16, physics::Unwatched{}, options, table);
  held &= measure_question("first contact only", 16, physics::FirstContact{physics::cue_ball, {}},
                           options, table);
  held &= measure_question("will ball 1 be pocketed", 16,
                           physics::WillBePocketed{physics::BallId{1}, {}}, options, table);
  table.print(out);
  table.write_csv(options.directory / "lean.csv");
  out << "  goal: each gives the same bits and saves something\n\n";
  return held;
}

}  // namespace poolhall::bench
