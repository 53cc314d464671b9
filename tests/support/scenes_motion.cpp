// One ball: free motion against the formulas, frictions and speeds from nothing to absurd.
#include <cmath>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double gravity = 9.81;
const Materials cloth{};  // the Olympiad's

Finding last_place(const Simulation<double>& result, const Vec2<double>& expected,
                   double tolerance) {
  const Vec2<double>& p = result.balls[0].position;
  return all_of({near("x", p.x, expected.x, tolerance), near("y", p.y, expected.y, tolerance)});
}

// (6), (8), (12), (13), (15), (17): a slide that ends in a roll that ends at rest, in long double.
struct SlideAndRoll {
  long double slide_time, roll_time;
  Vec2<long double> end;
};
SlideAndRoll slide_and_roll(const Ball<double>& ball) {
  const long double g = gravity, mu_s = cloth.mu_slide, mu_r = cloth.mu_roll;
  const Vec2<long double> v{ball.velocity.x, ball.velocity.y};
  const Vec2<long double> u{v.x - static_cast<long double>(ball_radius) * ball.angular_velocity.y,
                            v.y + static_cast<long double>(ball_radius) * ball.angular_velocity.x};
  const long double slip = std::sqrt(dot(u, u));
  const long double t = 2 * slip / (7 * mu_s * g);
  const long double half = mu_s * g * t * t / 2 / slip;
  const Vec2<long double> rolls = v - (2.0L / 7) * u;
  const long double speed = std::sqrt(dot(rolls, rolls));
  const long double t_roll = speed / (mu_r * g);
  return {t,
          t_roll,
          {ball.position.x + t * v.x - half * u.x + t_roll / 2 * rolls.x,
           ball.position.y + t * v.y - half * u.y + t_roll / 2 * rolls.y}};
}

NamedScene slides_and_rolls(std::string name, Scene<double> scene) {
  const SlideAndRoll formula = slide_and_roll(scene.balls[0]);
  const auto times = [formula](const Simulation<double>& result) -> Finding {
    if (sequence(result) != "tran0:ro tran0:st") {
      return {false, sequence(result)};
    }
    const auto slide = static_cast<double>(formula.slide_time);
    const auto both = static_cast<double>(formula.slide_time + formula.roll_time);
    return all_of(
        {near("slides", result.events[0].t, slide, 1e-15 * slide + 1e-320),
         near("rests at", result.events[1].t, both, 1e-15 * both + 1e-320),
         last_place(result,
                    {static_cast<double>(formula.end.x), static_cast<double>(formula.end.y)},
                    2e-16)});
  };
  return runs(std::move(name), "times and place of (13), (17)", std::move(scene), times);
}

NamedScene spins_out(double w_z) {
  const double t = std::abs(w_z) / (5 * *cloth.mu_spin * gravity / (2 * ball_radius));  // (10)
  return runs("pure side spin of " + in_words(w_z), "stops on its spot at " + in_words(t) + " s",
              with(on_table(), 0, {0.5, 0.5}, {}, {0, 0, w_z}),
              [t](const Simulation<double>& result) -> Finding {
                if (sequence(result) != "tran0:st") {
                  return {false, sequence(result)};
                }
                return all_of({near("at", result.events[0].t, t, 1e-15 * t),
                               last_place(result, {0.5, 0.5}, 0)});
              });
}

Scene<double> crossing(Scene<double> scene) {
  return with(std::move(scene), 0, {0.5, 0.5}, {1, 0.7}, {9, -4, 30});
}

}  // namespace

void add_free_motion(std::vector<NamedScene>& out) {
  out.push_back(slides_and_rolls("free slide and roll",
                                 with(on_table(), 0, {0.5, 0.6}, {0.25, 0.15}, {3, -5, 12})));
  out.push_back(slides_and_rolls("stun", with(on_table(), 0, {0.5, 0.5}, {0, 0.5})));
  out.push_back(
      slides_and_rolls("spinning on the spot", with(on_table(), 0, {0.5, 0.5}, {}, {20, 0, 0})));
  out.push_back(comes_as("free roll", "tran0:st", rolling(on_table(), 0, {0.5, 0.5}, {0.2, 0.1})));
  const double v = 0.8;
  const double slip = 3.5 * v;  // all of v is lost when the slip is
  const double way = v * v / (2 * cloth.mu_slide * gravity);
  out.push_back(runs("draw without roll-out", "stops dead where the slide ends",
                     with(on_table(), 0, {0.5, 0.5}, {v, 0}, {0, -(slip - v) / ball_radius, 0}),
                     [way](const Simulation<double>& r) -> Finding {
                       if (sequence(r) != "tran0:st") {
                         return {false, sequence(r)};
                       }
                       return last_place(r, {0.5 + way, 0.5}, 2e-16);
                     }));
  out.push_back(spins_out(40));
  out.push_back(spins_out(-40));
  Scene<double> ends_while_sliding = with(on_table(), 0, {0.3, 0.5}, {0.4, 0}, {0, 0, 1});
  out.push_back(comes_as("side spin that ends in the slide", "tran0:ro tran0:st",
                         std::move(ends_while_sliding)));
  out.push_back(comes_as("side spin that outlives the roll", "tran0:ro tran0:sp tran0:st",
                         with(on_table(), 0, {0.5, 0.5}, {0.2, 0}, {0, 0, 300})));
}

void add_frictions_and_speeds(std::vector<NamedScene>& out) {
  const SimulationOptions long_enough{.t_max = 1e3};
  Scene<double> slides = crossing(closed_box());
  slides.materials.mu_slide = 0;
  out.push_back(ends("mu_s = 0", slides, Ending::t_max, long_enough));
  Scene<double> rolls = crossing(closed_box());
  rolls.materials.mu_roll = 0;
  out.push_back(ends("mu_r = 0", rolls, Ending::t_max, long_enough));
  Scene<double> spins = with(on_table(), 0, {0.5, 0.5}, {}, {0, 0, 5});
  spins.materials.mu_spin = 0;
  out.push_back(runs(
      "mu_sp = 0", "spins on, no event to come", spins, [](const Simulation<double>& r) -> Finding {
        return {
            r.events.empty() && r.balls[0].angular_velocity.z == 5 && r.ending == Ending::at_rest,
            sequence(r) + ", w_z " + in_words(r.balls[0].angular_velocity.z)};
      }));
  const Scene<double> none = crossing(frictionless_box());
  out.push_back(ends("no friction at all, t_max", none, Ending::t_max, long_enough));
  out.push_back(
      ends("no friction at all, event limit", none, Ending::event_limit, {.event_limit = 1000}));
  for (const double mu : {5e-324, 1e-300, 1e-9}) {
    Scene<double> slick = crossing(closed_box());
    slick.materials.mu_slide = slick.materials.mu_roll = mu;
    slick.materials.mu_spin = mu;
    out.push_back(ends("mu_s, mu_r, mu_sp = " + in_words(mu), slick, Ending::t_max, long_enough));
  }
  for (double Materials::*mu : {&Materials::mu_slide, &Materials::mu_roll}) {
    Scene<double> rough = crossing(on_table());
    rough.materials.*mu = 1e6;
    out.push_back(ends(mu == &Materials::mu_slide ? "mu_s = 1e6" : "mu_r = 1e6", rough));
  }
  Scene<double> rough = with(crossing(on_table()), 1, {0.5 + ball_diameter + 1e-9, 0.5});
  rough.materials.mu_slide = rough.materials.mu_roll = 1e6;
  rough.materials.ball_friction = ConstantFriction{1e6};
  out.push_back(ends("every friction 1e6", std::move(rough)));
  for (const double v :
       {5e-324, 1e-310, 1e-160, 1e-30, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    out.push_back(
        slides_and_rolls("speed " + in_words(v), with(on_table(), 0, {0.5, 0.5}, {v, 0})));
  }
  for (const double v : {1.0, 10.0, 100.0, 1e3}) {
    out.push_back(ends("speed " + in_words(v), with(on_table(), 0, {0.5, 0.5}, {v, 0.8 * v})));
  }
}

}  // namespace poolhall::test_support
