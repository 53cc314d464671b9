// The paper's count of operations (section 4), beside counted ones: a second of three rolling balls
// among sixteen in which nothing happens.
#include <ostream>

#include "physics/event_loop.hpp"
#include "physics/watch.hpp"
#include "tests/bench/counted.hpp"
#include "tests/bench/paper_scheme.hpp"
#include "tests/bench/precision_parts.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/time_stepping.hpp"

namespace poolhall::bench {

namespace {

constexpr double second = 1;
constexpr std::size_t rolling_balls = 3;

// Three balls roll side by side up the table, thirteen lie at its foot.
physics::Scene<Counted> three_rolling() {
  physics::Scene<Counted> scene{
      *physics::preset_table("olympiad"), *physics::preset_materials("olympiad"), {}, {}};
  scene.balls.count = physics::max_balls;
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    physics::Ball<Counted>& ball = scene.balls[i];
    ball.id = physics::BallId{static_cast<std::uint8_t>(i)};
    if (i < rolling_balls) {
      ball.position = {0.3 + 0.2 * static_cast<double>(i), 0.4};
      ball.velocity = {0.0, 0.5};
      ball.angular_velocity = {-0.5 / scene.materials.ball_radius, 0.0, 0.0};
      ball.state = physics::MotionState::rolling;
    } else {
      const auto place = static_cast<double>(i - rolling_balls);
      ball.position = {0.1 + 0.07 * place, i % 2 == 0 ? 1.4 : 1.7};
    }
  }
  return scene;
}

template <class Run>
OperationCount counted(const Run& run) {
  const OperationCount before = Counted::count();
  run();
  return Counted::count() - before;
}

void add_row(ReportTable& table, const std::string& name, const std::string& papers,
             const OperationCount& n) {
  table.add({name, papers, std::to_string(n.total()), std::to_string(n.additions),
             std::to_string(n.multiplications), std::to_string(n.divisions),
             std::to_string(n.roots), std::to_string(n.comparisons)});
}

}  // namespace

void operation_counts(const BenchOptions& options, std::ostream& out) {
  const physics::Scene<Counted> scene = three_rolling();
  SteppedShot stepped;
  const OperationCount discrete =
      counted([&] { stepped = step_through(scene, Stepper::paper_discrete, 1e-3, second); });
  PaperScheme<Counted> paper(scene.table, scene.materials);
  std::size_t events = 0;
  const OperationCount event_scheme =
      counted([&] { events += paper.run(scene.balls, std::nullopt, Counted(second)); });
  physics::EventLoop<Counted> loop(scene.table, scene.materials);
  physics::SimulationOptions until;
  until.t_max = second;
  const OperationCount core = counted([&] {
    physics::Unwatched none;
    static_cast<void>(loop.run(scene.balls, std::nullopt, until, none));
  });
  const std::size_t n = rolling_balls;
  ReportTable table(
      "Operations for one second of three rolling balls among sixteen, " +
          std::to_string(events + stepped.events.size() + loop.events()) + " events",
      {"", "the paper's count", "counted", "+ -", "*", "/", "square roots", "comparisons"});
  add_row(table, "paper's discrete scheme, steps of 1 ms", std::to_string(stepped.operations),
          discrete);
  add_row(table, "paper's event scheme", std::to_string((645 * n - 19 * n * n) / 2), event_scheme);
  add_row(table, "event loop", "", core);
  table.print(out);
  table.write_csv(options.directory / "operations.csv");
  const auto ratio = [&](const OperationCount& other) {
    return cell(static_cast<double>(discrete.total()) / static_cast<double>(other.total()));
  };
  out << "  the paper counts a ball's step, a test or a root as one operation (a pair's quartic as "
         "19):\n  87,000 against 882, a ratio of 98.6. Counted by the arithmetic that they take, "
         "the ratio is "
      << ratio(event_scheme) << ",\n  and " << ratio(core)
      << " to the event loop, which leaves out what it can exclude\n\n";
}

}  // namespace poolhall::bench
