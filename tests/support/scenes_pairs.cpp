// Two balls: head-on, cut, thrown, grazing, touching, overlapping, side by side, in each other's
// way.
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr double degree = std::numbers::pi / 180;

Scene<double> with_ball_friction(Scene<double> scene, double mu) {
  scene.materials.ball_friction = ConstantFriction{mu};
  return scene;
}

// A stunned cue ball moving along +y touches ball 1 at that cut angle.
Scene<double> cut(double degrees, double speed, double mu) {
  const double angle = degrees * degree;
  Scene<double> scene = with_ball_friction(on_table(), mu);
  scene = with(std::move(scene), 0, {0.5, 0.8}, {0, speed});
  return with(std::move(scene), 1,
              {0.5 + ball_diameter * std::sin(angle), 0.8 + ball_diameter * std::cos(angle)});
}

NamedScene throws(const char* name, double degrees, double mu, double expected) {
  return runs(name, "throw of " + in_words(expected / degree) + " degrees", cut(degrees, 1, mu),
              [=](const Simulation<double>& r) -> Finding {
                const auto* hit = first_of(r, EventType::ball_collision);
                if (hit == nullptr) {
                  return {false, sequence(r)};
                }
                const Vec2<double> v = hit->after[1].velocity;
                const double line = degrees * degree;
                // The object ball is thrown towards where the cue ball's slip drags it.
                const double off = line - std::atan2(v.x, v.y);
                return near("radians", off, expected, 1e-14);
              });
}

// Ball 0 passes ball 1 on its left at a distance of 2R + `miss`.
NamedScene grazes(double miss, bool hits) {
  // Rolling exactly along y: its path has no other number than x.
  const Scene<double> scene =
      rolling(with(with_ball_friction(on_table(), 0), 1, {0.25 + (ball_diameter + miss), 1.0}), 0,
              {0.25, 0.8}, {0, 0.5});
  return runs("grazing, the discs " + in_words(-miss) + " m deep", hits ? "a contact" : "none",
              scene, [=](const Simulation<double>& r) -> Finding {
                const auto* hit = first_of(r, EventType::ball_collision);
                return {(hit != nullptr) == hits, sequence(r)};
              });
}

// Both balls leave a head-on collision as e and the separation speed say.
NamedScene meets_head_on(double speed, double restitution) {
  Scene<double> scene = with(with(with_ball_friction(on_table(), 0), 0, {0.3, 0.5}, {speed, 0}), 1,
                             {0.3 + ball_diameter, 0.5});
  scene.materials.ball_restitution = restitution;
  const double apart = std::max(restitution * speed, scene.materials.separation_speed);
  return runs("head-on at " + in_words(speed) + " m/s, e " + in_words(restitution),
              "leaves at " + in_words((speed + apart) / 2), scene,
              [=](const Simulation<double>& r) -> Finding {
                const auto* hit = first_of(r, EventType::ball_collision);
                if (hit == nullptr || hit->t > 1e-15) {
                  return {false, sequence(r)};
                }
                const double scale = speed + apart;
                return all_of(
                    {near("ball 1", hit->after[1].velocity.x, (speed + apart) / 2, 1e-15 * scale),
                     near("ball 0", hit->after[0].velocity.x, (speed - apart) / 2, 1e-15 * scale)});
              });
}

Finding meets_at_once(const Simulation<double>& r) {
  return {!r.events.empty() && r.events.front().type == EventType::ball_collision &&
              r.events.front().t < 1e-15,
          sequence(r)};
}

Finding never_meets(const Simulation<double>& r) {
  return {first_of(r, EventType::ball_collision) == nullptr, sequence(r)};
}

// Numbers that are sums of powers of two, and a cloth that keeps them so: a slide at 7/4 m/s takes
// 1/4 s and 3/8 m, a roll at 1/4 m/s 2 s and 1/4 m, to the last bit.
NamedScene transition_at_contact(std::string name, const std::string& events, double speed,
                                 double way, bool rolls) {
  Scene<double> scene = closed_box();
  scene.materials.ball_radius = 1.0 / 32;
  scene.materials.gravity = 8;
  scene.materials.mu_slide = 0.25;
  scene.materials.mu_roll = 1.0 / 64;
  const Vec2<double> from{0.25, 0.5};
  scene = rolls ? rolling(std::move(scene), 0, from, {speed, 0})
                : with(std::move(scene), 0, from, {speed, 0});
  scene = with(std::move(scene), 1, {from.x + way + 1.0 / 16, 0.5});
  return runs(std::move(name), events + " at one instant", std::move(scene),
              [events](const Simulation<double>& r) -> Finding {
                const std::string found = sequence(r);
                const bool at_once =
                    r.events.size() < 2 || r.events[0].t == r.events[1].t || found == events;
                return {at_once && found.starts_with(events), found};
              });
}

void add_contacts_at_the_start(std::vector<NamedScene>& out) {
  const Vec2<double> one{0.25, 0.5}, other{0.25 + ball_diameter, 0.5};
  out.push_back(
      comes_as("touching and receding", "tran1:ro tran1:st",
               with(with(on_table(), 1, {0.5, 0.5}, {-0.4, 0}), 2, {0.5 + ball_diameter, 0.5})));
  out.push_back(runs("touching and approaching", "contact at t = 0",
                     with(with(on_table(), 1, one, {0.4, 0}), 2, other), meets_at_once));
  // The left ball spins towards the right one: no closing speed, but a closing acceleration.
  out.push_back(runs("touching, closing acceleration only", "contact at t = 0",
                     with(with(on_table(), 1, one, {}, {0, 30, 0}), 2, other), meets_at_once));
  out.push_back(
      runs("touching, opening acceleration only", "no contact",
           with(with(on_table(), 1, {0.5, 0.5}, {}, {0, -10, 0}), 2, {0.5 + ball_diameter, 0.5}),
           never_meets));
  out.push_back(runs("one ulp of overlap, approaching", "contact at t = 0",
                     with(with(on_table(), 1, one, {1, 0}), 2, {std::nextafter(other.x, 0), 0.5}),
                     meets_at_once));
  out.push_back(runs("one ulp of overlap, receding", "no contact",
                     with(with(on_table(), 1, {0.5, 0.5}, {-0.4, 0}), 2,
                          {std::nextafter(0.5 + ball_diameter, 0), 0.5}),
                     never_meets));
  out.push_back(comes_as("one ulp of overlap, at rest", "nothing",
                         with(with(on_table(), 1, one), 2, {std::nextafter(other.x, 0), 0.5})));
  out.push_back(is_refused("gross overlap", Fault::overlap, "/balls/1/x",
                           with(with(on_table(), 1, one), 2, {other.x - 1e-6, 0.5})));
  out.push_back(is_refused("one in the other", Fault::overlap, "/balls/1/x",
                           with(with(on_table(), 1, one), 2, one)));
}

}  // namespace

void add_pairs(std::vector<NamedScene>& out) {
  for (const double speed : {1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
    out.push_back(meets_head_on(speed, 1));
  }
  out.push_back(meets_head_on(5e-324, 1));
  out.push_back(meets_head_on(1, 0.5));
  out.push_back(meets_head_on(1, 0));
  out.push_back(runs(
      "90-degree rule", "v0 . v1 = 0", cut(30, 2, 0), [](const Simulation<double>& r) -> Finding {
        const auto& e = r.events.front();
        return near("v0 . v1", dot(e.after[0].velocity, e.after[1].velocity), 0, 1e-14);
      }));
  // Slip: tan(throw) = mu. Stick: a seventh of the tangential speed goes over.
  out.push_back(throws("throw in slip", 45, 0.06, std::atan(0.06)));
  out.push_back(throws("throw in stick", 15, 0.06, std::atan(std::tan(15 * degree) / 7)));
  out.push_back(grazes(-1e-15, true));
  out.push_back(grazes(1e-15, false));
  out.push_back(grazes(-1e-12, true));
  out.push_back(grazes(1e-12, false));
  add_contacts_at_the_start(out);
  out.push_back(
      transition_at_contact("slide ends in the contact", "tran0:ro ball0+1", 1.75, 0.375, false));
  out.push_back(transition_at_contact("roll ends in the contact", "tran0:st", 0.25, 0.25, true));
}

void add_lines_and_followers(std::vector<NamedScene>& out) {
  for (const Vec2<double>& v : {Vec2<double>{0, 1}, Vec2<double>{0.3, 0.4}}) {
    out.push_back(
        runs("side by side at (" + in_words(v.x) + ", " + in_words(v.y) + ") m/s", "no contact",
             rolling(rolling(on_table(), 1, {0.4, 0.5}, v), 2, {0.4 + ball_diameter, 0.5}, v),
             never_meets));
  }
  out.push_back(runs("one behind the other at one speed", "no contact",
                     rolling(rolling(on_table(), 1, {0.5, 0.4}, {0, 0.3}), 2,
                             {0.5, 0.4 + ball_diameter}, {0, 0.3}),
                     never_meets));
  out.push_back(
      ends("rolling at each other, touching", rolling(rolling(on_table(), 1, {0.5, 0.5}, {0.5, 0}),
                                                      2, {0.5 + ball_diameter, 0.5}, {-0.5, 0})));
  for (const double restitution : {1.0, 0.5, 0.0}) {
    Scene<double> pusher = rolling(rolling(on_table(), 1, {0.3, 0.5}, {0.5, 0}), 2,
                                   {0.3 + ball_diameter, 0.5}, {0.4, 0});
    pusher.materials.ball_restitution = restitution;
    NamedScene zeno = ends("Zeno pair: a roller pushes a slower one, e " + in_words(restitution),
                           std::move(pusher), Ending::at_rest, {.event_limit = 5000});
    out.push_back(std::move(zeno));
  }
  for (const double degrees : {0.0, 90.0}) {
    const bool across = degrees == 0;
    const Vec2<double> target = across ? Vec2<double>{0.8, 0.5} : Vec2<double>{0.5, 0.8};
    out.push_back(
        runs("dead-straight follow at " + in_words(degrees), "both stay on their line",
             struck(with(with(on_table(), 0, {0.5, 0.5}), 1, target), {0, 12, 12, degrees, 1.5}),
             [across](const Simulation<double>& r) -> Finding {
               const bool hit = first_of(r, EventType::ball_collision) != nullptr;
               bool straight = true;
               for (const auto& b : r.balls) {
                 straight = straight && (across ? b.position.y : b.position.x) == 0.5;
               }
               return {hit && straight, sequence(r)};
             }));
  }
}

}  // namespace poolhall::test_support
