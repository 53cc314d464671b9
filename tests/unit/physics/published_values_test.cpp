// Figures that others have published and that a shot simulated here must show.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "physics/contact_cluster.hpp"
#include "physics/motion.hpp"
#include "physics/simulator.hpp"

namespace poolhall::physics {
namespace {

constexpr double degree = std::numbers::pi / 180;

// A cue ball with velocity along +y meets a resting ball at a cut angle (degrees).
Scene<double> cut_shot(double cut, const Materials& materials, double speed, double roll) {
  Scene<double> scene;
  scene.table = *preset_table("olympiad");
  scene.materials = materials;
  const double radius = materials.ball_radius;
  scene.balls.count = 2;
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {0.5, 0.8};
  scene.balls[0].velocity = {0, speed};
  scene.balls[0].angular_velocity = {-roll * speed / radius, 0, 0};
  scene.balls[0] = settled(scene.balls[0], radius);
  scene.balls[1].id = BallId{1};
  const double reach = 2 * radius;
  scene.balls[1].position = {0.5 + reach * std::sin(cut * degree),
                             0.8 + reach * std::cos(cut * degree)};
  return scene;
}

Materials without_ball_friction() {
  Materials m = *preset_materials("olympiad");
  m.ball_friction = ConstantFriction{0};
  return m;
}

// Degrees between the cue ball's first heading and that when it rolls again after the hit.
double deflection(double cut) {
  const auto result = simulate(cut_shot(cut, without_ball_friction(), 0.6, 1), {});
  EXPECT_TRUE(result);
  for (const auto& event : result->events) {
    if (event.type == EventType::transition && event.after[0].id == cue_ball) {
      const Vec2<double> v = event.after[0].velocity;
      return std::atan2(std::abs(v.x), v.y) / degree;
    }
  }
  return 0;
}

TEST(PublishedValues, RollingCueBallIsDeflectedByAtMost33Point7Degrees) {
  // Alciatore, "30 degree rule", TP 3.3: 33.749 degrees at most, 33.67 for the half-ball hit.
  double most = 0;
  for (double cut = 1; cut < 89; cut += 0.25) {
    most = std::max(most, deflection(cut));
  }
  EXPECT_NEAR(most, 33.749, 2e-3);
  EXPECT_NEAR(deflection(30), 33.67, 0.01);
}

TEST(PublishedValues, RollingCueBallGoesOffNear30DegreesForQuarterToThreeQuarterBallHits) {
  // Between a 1/4-ball and a 3/4-ball hit: cut angles of 48.6 to 14.5 degrees.
  for (double cut = 14.5; cut <= 48.6; cut += 1) {
    EXPECT_GT(deflection(cut), 26) << cut;
    EXPECT_LT(deflection(cut), 34) << cut;
  }
}

TEST(PublishedValues, StunnedCueBallLeavesAtRightAnglesToTheObjectBall) {
  for (double cut = 5; cut < 85; cut += 5) {
    const auto result = simulate(cut_shot(cut, without_ball_friction(), 2, 0), {});
    ASSERT_TRUE(result);
    const auto& hit = result->events.front();
    ASSERT_EQ(hit.type, EventType::ball_collision);
    EXPECT_NEAR(dot(hit.after[0].velocity, hit.after[1].velocity), 0, 1e-13);
  }
}

// Alciatore TP A.14: throw of the object ball, radians, for speed v, cut angle and the cue ball's
// roll (1 follow, 0 stun, -1 draw) without side spin.
double alciatore_throw(double v, double cut, double roll) {
  const double across = v * std::sin(cut);
  const double along = v * std::cos(cut);
  const double slip = std::hypot(across, roll * v * std::cos(cut));
  const double mu = 9.951e-3 + 0.108 * std::exp(-1.088 * slip);
  return std::atan(std::min(mu * along / slip, 1.0 / 7) * across / along);
}

TEST(PublishedValues, ThrowAgainstCutAngleIsAlciatores) {
  Materials m = without_ball_friction();
  m.ball_friction = AlciatoreFriction{};
  for (const double roll : {0.0, 1.0, -1.0}) {
    for (const double speed : {0.447, 1.341, 3.129}) {  // 1, 3 and 7 mph
      for (double cut = 5; cut <= 85; cut += 5) {
        const auto result = simulate(cut_shot(cut, m, speed, roll), {});
        ASSERT_TRUE(result);
        const Vec2<double> v = result->events.front().after[1].velocity;
        const double found = cut * degree - std::atan2(v.x, v.y);
        EXPECT_NEAR(found, alciatore_throw(speed, cut * degree, roll), 1e-12)
            << speed << " m/s, " << cut << " degrees, roll " << roll;
      }
    }
  }
}

// Velocities right after a cue ball meets a rack with this gap head-on at 8 m/s.
ContactCluster<double>::Balls broken_rack(double gap, ContactModel model) {
  const Materials m = *preset_materials("modern");
  const auto c = coefficients<double>(m);
  ContactCluster<double>::Balls balls{};
  const double pitch = c.diameter + gap;
  std::size_t n = 1;
  for (int row = 0; row < 5; ++row) {
    for (int i = 0; i <= row; ++i, ++n) {
      balls[n].id = BallId{static_cast<std::uint8_t>(n)};
      balls[n].position = {pitch * (i - row / 2.0), pitch * row * std::numbers::sqrt3 / 2};
    }
  }
  balls[0].position = {0.002, -std::sqrt(c.reach_squared - 4e-6)};
  balls[0].velocity = {0, 8};
  ContactCluster<double> cluster(c);
  cluster.gather(balls, 0xffff, 0, 1, model);
  cluster.resolve(balls, m.ball_friction, model);
  return balls;
}

double rms_difference(const ContactCluster<double>::Balls& p,
                      const ContactCluster<double>::Balls& q) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2<double> d = p[i].velocity - q[i].velocity;
    sum += dot(d, d);
  }
  return std::sqrt(sum / static_cast<double>(p.size()));
}

TEST(Racks, ComeApartAlikeForAllGapsBelowTheThreshold) {
  const auto touching = broken_rack(0, ContactModel::cluster);
  EXPECT_LT(rms_difference(touching, broken_rack(1e-12, ContactModel::cluster)), 1e-9);
  for (const double gap : {1e-9, 1e-7, 1e-5, 1e-4}) {
    EXPECT_LT(rms_difference(touching, broken_rack(gap, ContactModel::cluster)), 1e3 * gap) << gap;
  }
}

TEST(Racks, ComeApartAsOverElasticSprings) {
  for (const double gap : {0.0, 1e-4}) {
    const double off = rms_difference(broken_rack(gap, ContactModel::cluster),
                                      broken_rack(gap, ContactModel::hertz));
    EXPECT_LT(off / 8, 0.15) << gap;
  }
}

// A spinning cue ball meets balls 3 and 6 of a frozen triangle at once. Friction from the slip
// before the impact once added a tenth of a percent to the energy of the whole.
TEST(Racks, WinNoEnergyByTheirFriction) {
  for (const double friction : {0.01, 0.2, 1e6}) {
    Scene<double> scene;
    scene.table = *preset_table("olympiad");
    scene.materials = *preset_materials("olympiad");
    scene.materials.ball_friction = ConstantFriction{friction};
    const std::array<Vec2<double>, 7> places{{{0.6440169783106526, 1.5334561812509202},
                                              {0.558, 1.5},
                                              {0.529375, 1.549579954366659},
                                              {0.5866250000000001, 1.549579954366659},
                                              {0.50075, 1.5991599087333181},
                                              {0.558, 1.5991599087333181},
                                              {0.6152500000000001, 1.5991599087333181}}};
    for (const auto& place : places) {
      scene.balls[scene.balls.count].id = BallId{static_cast<std::uint8_t>(scene.balls.count)};
      scene.balls[scene.balls.count++].position = place;
    }
    scene.balls[0].velocity = {-0.4736566998019942, 0.6818784307209917};
    scene.balls[0].angular_velocity = {-9.035395305479094, -1.4980828655776557, 17.604189701887066};
    scene.balls[0] = settled(scene.balls[0], scene.materials.ball_radius);
    const auto whole = simulate(scene, {.t_max = 0.2});
    ASSERT_TRUE(whole);
    for (const auto& event : whole->events) {
      const auto before = simulate(scene, {.t_max = event.t * (1 - 1e-12)});
      const auto after = simulate(scene, {.t_max = event.t * (1 + 1e-12)});
      ASSERT_TRUE(before && after);
      EXPECT_LE(after->energy.end - after->energy.added_by_separation,
                (before->energy.end - before->energy.added_by_separation) * (1 + 1e-9))
          << friction << " at " << event.t;
    }
  }
}

// The more it spins, the more of a ball's friction on two others would drive them on.
TEST(Racks, TakeFrictionThatChangesWithoutAJump) {
  Materials m = *preset_materials("modern");
  m.ball_restitution = 0.95;
  const auto c = coefficients<double>(m);
  ContactCluster<double> cluster(c);
  double last = 0;
  for (int i = 0; i <= 4000; ++i) {
    const double spin = 1.66 * i / 4000;
    ContactCluster<double>::Balls balls{};
    balls[0].id = BallId{13};
    balls[0].position = {-c.diameter * std::cos(0.3587), c.diameter * std::sin(0.3587)};
    balls[0].velocity = {3.7, -1.45};
    balls[0].angular_velocity = {-25.58 * spin, 7.447 * spin, -75.06 * spin};
    balls[1].id = BallId{0};
    balls[2].id = BallId{6};
    balls[2].position = {c.diameter * std::cos(0.0577), c.diameter * std::sin(0.0577)};
    cluster.gather(balls, 7, 0, 1, ContactModel::cluster);
    cluster.resolve(balls, m.ball_friction, ContactModel::cluster);
    ASSERT_LT(std::abs(balls[1].angular_velocity.z - last), 0.02) << spin;
    last = balls[1].angular_velocity.z;
  }
  EXPECT_GT(last, 1);
}

}  // namespace
}  // namespace poolhall::physics
