// Balls at rails, in corners, at mouths, jaws and holes.
#include <cmath>
#include <numbers>

#include "tests/support/scene_parts.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

constexpr Vec2<double> frozen{ball_radius, 0.7};  // to the left rail

NamedScene struck_at_the_rail(std::string name, Scene<double> scene,
                              const ShotParameters<double>& shot) {
  return ends(std::move(name), struck(std::move(scene), shot));
}

// A table of powers of two, so that what is to happen at once does so to the last bit.
Scene<double> exact_table(const Pockets& pockets) {
  Scene<double> scene = on_table();
  scene.materials.ball_radius = 1.0 / 32;
  scene.table.width = 1;
  scene.table.length = 2;
  scene.table.pockets = pockets;
  scene.table.head_string = scene.table.foot_spot_x = scene.table.foot_spot_y = 0.5;
  return scene;
}

// Along the bisector into a corner.
NamedScene into_corner(RailId first, RailId second, const Vec2<double>& way) {
  const Scene<double> scene =
      with(exact_table(NoPockets{}), 0, {way.x < 0 ? 0.25 : 0.75, way.y < 0 ? 0.25 : 1.75}, way);
  const std::string expected =
      std::string(name(first)) + ", then " + std::string(name(second)) + ", at one time";
  return runs("both rails of a corner at once", expected, scene,
              [=](const Simulation<double>& r) -> Finding {
                const auto* one = first_of(r, EventType::rail_collision);
                if (one == nullptr || one == &r.events.back()) {
                  return {false, sequence(r)};
                }
                const auto* other = one + 1;
                return {one->rail == first && other->rail == second && other->t - one->t < 1e-15,
                        std::string(name(*one->rail)) + ", " +
                            std::string(other->rail ? name(*other->rail) : "none") + " " +
                            in_words(other->t - one->t) + " s later"};
              });
}

void add_jaws(std::vector<NamedScene>& out) {
  const Scene<double> bar = on_table("bar7");
  const auto& jaws = std::get<Jaws>(bar.table.pockets);
  out.push_back(ends("between the jaws of a corner", with(bar, 0, {0.05, 0.05}, {-0.3, -0.1})));
  out.push_back(ends("between the jaws of a corner, fast", with(bar, 0, {0.06, 0.05}, {-9, 3})));
  out.push_back(ends("across the mouth of a side pocket", with(bar, 0, {0.03, 0.8}, {-0.05, 2})));
  out.push_back(ends("into the point of a side jaw", with(bar, 0, {0.3, 0.92}, {-3, 0})));
  const Vec2<double> hole{-jaws.side.depth, bar.table.length / 2};
  const Vec2<double> rim{hole.x + jaws.side.radius, hole.y};
  out.push_back(comes_as("at rest on a hole's rim", "nothing", with(bar, 0, rim)));
  out.push_back(comes_as("from a hole's rim inwards", "pock0", with(bar, 0, rim, {-0.1, 0})));
  out.push_back(
      comes_as("from a hole's rim outwards", "tran0:ro tran0:st", with(bar, 0, rim, {0.1, 0})));
  for (const double inside : {1e-12, 1e-15, -1e-15, -1e-12}) {
    const bool drops = inside > 0;
    const Scene<double> scene = rolling(bar, 0, {rim.x - inside, rim.y - 0.01}, {0, 0.1});
    out.push_back(runs("tangent to a hole, " + in_words(inside) + " m inside",
                       drops ? "pocketed at the middle" : "passes the middle", scene,
                       [drops, rim](const Simulation<double>& r) -> Finding {
                         const auto& e = r.events.front();
                         const bool fell = e.type == EventType::pocketed &&
                                           std::abs(e.after[0].position.y - rim.y) < 1e-6;
                         return {fell == drops, sequence(r)};
                       }));
  }
}

// Balls 1 and 2 on mirrored ways into the corner at the head's left.
NamedScene two_into_one(std::string name, const Scene<double>& empty) {
  // Side by side they fit into the mouth, just.
  const double aside = ball_radius / std::numbers::sqrt2 + 1e-4;
  const Scene<double> scene = with(with(empty, 1, {0.2 + aside, 0.2 - aside}, {-1, -1}), 2,
                                   {0.2 - aside, 0.2 + aside}, {-1, -1});
  return runs(std::move(name), "mirror images to the end", scene,
              [](const Simulation<double>& r) -> Finding {
                const auto& p = r.balls[0];
                const auto& q = r.balls[1];
                const bool same = p.pocket == q.pocket &&
                                  std::abs(p.position.x - q.position.y) < 1e-9 &&
                                  std::abs(p.position.y - q.position.x) < 1e-9;
                return {same, sequence(r)};
              });
}

}  // namespace

void add_rails(std::vector<NamedScene>& out) {
  out.push_back(comes_as("rolling along a rail that it touches", "pock0",
                         rolling(on_table(), 0, frozen, {0, 1})));
  out.push_back(comes_as("at rest at exactly x = R", "nothing", with(on_table(), 0, frozen)));
  out.push_back(comes_as("from exactly x = R inwards", "tran0:ro tran0:st",
                         with(on_table(), 0, frozen, {0.3, 0})));
  for (const double beyond : {1e-17, 1e-12}) {
    out.push_back(ends("beyond a rail by " + in_words(beyond) + " m, outwards",
                       with(closed_box(), 0, {ball_radius - beyond, 0.7}, {-0.5, 0.1})));
  }
  out.push_back(struck_at_the_rail("frozen to a rail, struck along it",
                                   with(closed_box(), 0, {ball_radius, 1.5}), {0, 0, 0, 90, 2}));
  out.push_back(struck_at_the_rail("frozen to a rail, struck into it",
                                   with(closed_box(), 0, frozen), {0, 0, 5, 180, 2}));
  out.push_back(struck_at_the_rail("frozen to a rail, struck away, cue raised",
                                   with(closed_box(), 0, frozen), {0, 15, 60, 0, 2}));
  for (const double spin : {-60.0, -6.0, 60.0}) {
    out.push_back(ends("frozen to a rail, pressed by w_y " + in_words(spin),
                       with(closed_box(), 0, frozen, {0, 0.3}, {0, spin, 0})));
  }
  const auto inexhaustible = [](const std::string& name, const Cushion& cushion) {
    Scene<double> scene = with(closed_box(), 0, frozen, {0, 0.3}, {0, -60, 5});
    scene.materials.cushion = cushion;
    return ends("pressed to a rail by spin, " + name, std::move(scene));
  };
  out.push_back(inexhaustible("han2005", Han2005Cushion{}));
  out.push_back(inexhaustible("mathavan2010", Mathavan2010Cushion{}));
  out.push_back(inexhaustible("spring", SpringCushion{}));
  out.push_back(
      ends("into a rail that it touches", with(closed_box(), 0, {ball_radius, 0.6}, {-1, 0.2})));
  out.push_back(ends(
      "between a rail and a roller",
      rolling(with(closed_box(), 1, frozen), 2, {frozen.x + ball_diameter, frozen.y}, {-0.5, 0})));
  out.push_back(
      ends("frozen to a rail and to a ball, struck into both",
           struck(with(with(closed_box(), 0, frozen), 1, {frozen.x, frozen.y + ball_diameter}),
                  {0, 0, 10, 120, 3})));
  out.push_back(into_corner(RailId::head, RailId::head_left, {-1, -1}));
  out.push_back(into_corner(RailId::head, RailId::head_right, {1, -1}));
  out.push_back(into_corner(RailId::foot_left, RailId::foot, {-1, 1}));
  out.push_back(into_corner(RailId::foot_right, RailId::foot, {1, 1}));
  out.push_back(comes_as("at rest in a corner, at both rails", "nothing",
                         with(closed_box(), 0, {ball_radius, ball_radius})));
  out.push_back(ends("pressed into a corner by spin",
                     with(closed_box(), 0, {ball_radius, ball_radius}, {}, {40, -40, 0})));
}

void add_pockets(std::vector<NamedScene>& out) {
  const double line = (0.11 / std::numbers::sqrt2 + ball_radius) / 2;
  out.push_back(
      comes_as("at rest on the mouth line", "nothing", with(on_table(), 0, {line, line})));
  out.push_back(comes_as("from the mouth line outwards", "pock0",
                         with(on_table(), 0, {line, line}, {-0.1, -0.1})));
  out.push_back(comes_as("from the mouth line inwards", "tran0:ro tran0:st",
                         with(on_table(), 0, {line, line}, {0.1, 0.1})));
  out.push_back(is_refused("beyond a mouth line", Fault::outside_table, "/balls/0/x",
                           with(on_table(), 0, {line - 1e-6, line})));
  out.push_back(comes_as("along a rail into the end of a corner's mouth", "pock0",
                         rolling(on_table(), 0, {ball_radius, 0.4}, {0, -1})));
  const Scene<double> exact = exact_table(MouthLines{0.125, 0.125});
  const double mouth_end = 1 - 0.0625;
  out.push_back(comes_as("straight into the end of a side mouth", "pock0",
                         rolling(exact, 0, {0.25, mouth_end}, {-1, 0})));
  out.push_back(
      runs("straight at a rail an ulp beside a side mouth", "a rail",
           rolling(exact, 0, {0.25, std::nextafter(mouth_end, 0)}, {-1, 0}),
           [](const Simulation<double>& r) -> Finding {
             return {first_of(r, EventType::rail_collision) == &r.events.front(), sequence(r)};
           }));
  out.push_back(two_into_one("two balls into one mouth at once", on_table()));
  out.push_back(two_into_one("two balls into one hole at once", on_table("bar7")));
  add_jaws(out);
}

}  // namespace poolhall::test_support
