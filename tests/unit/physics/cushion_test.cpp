#include "physics/cushion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace poolhall::physics {
namespace {

constexpr double radius = 0.028575;

template <class Real>
Ball<Real> ball_at(double speed, double degrees, bool rolls) {
  const Direction<Real> d = direction_of_degrees(Real(degrees));
  Ball<Real> ball;
  ball.velocity = {Real(speed) * d.cosine, Real(speed) * d.sine};
  if (rolls) {
    ball.angular_velocity = {-ball.velocity.y / Real(radius), ball.velocity.x / Real(radius), 0};
  }
  return ball;
}

Materials with_cushion(const Cushion& cushion) {
  Materials m = preset_materials("olympiad").value();
  m.cushion = cushion;
  return m;
}

template <class Real>
Ball<Real> bounced(const Ball<Real>& ball, const Materials& m) {
  const Table table = preset_table("olympiad").value();
  return after_cushion(ball, Vec2<Real>{Real(1), Real(0)}, m, nose_angle<Real>(table, m));
}

double speed_of(const Ball<double>& ball) {
  return std::hypot(ball.velocity.x, ball.velocity.y);
}

double angle_from_normal(const Ball<double>& ball) {
  return std::atan2(ball.velocity.y, -ball.velocity.x) * 180 / std::numbers::pi;
}

double energy_per_mass(const Ball<double>& ball, const Materials& m) {
  const Vec3<double>& w = ball.angular_velocity;
  return dot(ball.velocity, ball.velocity) + 0.4 * m.ball_radius * m.ball_radius * dot(w, w);
}

// Converged values at 1 m/s, e = .85, f = .2, mu_slide = .2, nose at .64 of the diameter.
struct Rebound {
  double degrees;
  bool rolls;
  double speed;
  double angle;
};

class HanRebound : public ::testing::TestWithParam<Rebound> {};
TEST_P(HanRebound, HasThePublishedSpeedAndAngle) {
  const Ball<double> after = bounced(ball_at<double>(1, GetParam().degrees, GetParam().rolls),
                                     with_cushion(Han2005Cushion{}));
  EXPECT_NEAR(speed_of(after), GetParam().speed, 1e-3);
  EXPECT_NEAR(angle_from_normal(after), GetParam().angle, 1e-2);
}
INSTANTIATE_TEST_SUITE_P(Cushion, HanRebound,
                         ::testing::Values(Rebound{0, false, 0.727, 0}, Rebound{0, true, 0.804, 0},
                                           Rebound{30, false, 0.724, 29.55},
                                           Rebound{30, true, 0.768, 26.81},
                                           Rebound{60, true, 0.806, 62.08}));

class MathavanRebound : public ::testing::TestWithParam<Rebound> {};
TEST_P(MathavanRebound, HasTheConvergedSpeedAndAngle) {
  const Ball<double> after = bounced(ball_at<double>(1, GetParam().degrees, GetParam().rolls),
                                     with_cushion(Mathavan2010Cushion{}));
  EXPECT_NEAR(speed_of(after), GetParam().speed, 1e-3);
  EXPECT_NEAR(angle_from_normal(after), GetParam().angle, 1e-2);
}
TEST_P(MathavanRebound, AgreesWithLongDouble) {
  const Materials m = with_cushion(Mathavan2010Cushion{});
  const auto narrow = bounced(ball_at<double>(1, GetParam().degrees, GetParam().rolls), m);
  const auto wide = bounced(ball_at<long double>(1, GetParam().degrees, GetParam().rolls), m);
  EXPECT_NEAR(narrow.velocity.x, static_cast<double>(wide.velocity.x), 1e-13);
  EXPECT_NEAR(narrow.velocity.y, static_cast<double>(wide.velocity.y), 1e-13);
  EXPECT_NEAR(narrow.angular_velocity.x, static_cast<double>(wide.angular_velocity.x), 5e-12);
  EXPECT_NEAR(narrow.angular_velocity.y, static_cast<double>(wide.angular_velocity.y), 5e-12);
  EXPECT_NEAR(narrow.angular_velocity.z, static_cast<double>(wide.angular_velocity.z), 5e-12);
}
TEST_P(MathavanRebound, DoesNotDependOnTheUnitOfSpeed) {
  const Materials m = with_cushion(Mathavan2010Cushion{});
  const auto at_one = bounced(ball_at<double>(1, GetParam().degrees, GetParam().rolls), m);
  for (const double factor : {1e-9, 1e-3, 1e3}) {
    const auto other = bounced(ball_at<double>(factor, GetParam().degrees, GetParam().rolls), m);
    EXPECT_NEAR(other.velocity.x / factor, at_one.velocity.x, 1e-12);
    EXPECT_NEAR(other.velocity.y / factor, at_one.velocity.y, 1e-12);
    EXPECT_NEAR(other.angular_velocity.z / factor, at_one.angular_velocity.z, 1e-10);
  }
}
INSTANTIATE_TEST_SUITE_P(Cushion, MathavanRebound,
                         ::testing::Values(Rebound{0, false, 0.759, 0}, Rebound{0, true, 0.804, 0},
                                           Rebound{30, false, 0.730, 23.65},
                                           Rebound{30, true, 0.781, 24.16},
                                           Rebound{60, true, 0.807, 58.58}));

// The equations of the source as they stand, with angles and ten thousand explicit steps: an
// independent, slow oracle for an impact in which no contact sticks.
Ball<double> mathavan_step_by_step(const Ball<double>& before, const Materials& m) {
  const auto& cushion = std::get<Mathavan2010Cushion>(m.cushion);
  const double sine = 0.28;
  const double cosine = 0.96;
  const double r = m.ball_radius;
  double vx = before.velocity.x;
  double vy = before.velocity.y;
  double wx = before.angular_velocity.x;
  double wy = before.angular_velocity.y;
  double wz = before.angular_velocity.z;
  const double h = vx / 200000;
  double work = 0;
  double goal = -1;  // of the work, in the restitution phase
  while (goal < 0 || work > goal) {
    const double at_nose = std::atan2(vy + r * (wz * cosine - wx * sine), vx * sine + r * wy);
    const double at_cloth = std::atan2(vy + r * wx, vx - r * wy);
    const double g1 = -cushion.friction * std::cos(at_nose);
    const double g2 = -cushion.friction * std::sin(at_nose);
    const double normal = std::max(0.0, sine + g1 * cosine);
    const double k1 = -m.mu_slide * normal * std::cos(at_cloth);
    const double k2 = -m.mu_slide * normal * std::sin(at_cloth);
    const double old = vx;
    vx += h * (-cosine + g1 * sine + k1);
    vy += h * (g2 + k2);
    wx += h * 2.5 / r * (k2 - g2 * sine);
    wy += h * 2.5 / r * (g1 - k1);
    wz += h * 2.5 / r * g2 * cosine;
    work += h * cosine * (old + vx) / 2;
    if (goal < 0 && vx <= 0) {
      goal = (1 - cushion.restitution * cushion.restitution) * work;
    }
  }
  Ball<double> after = before;
  after.velocity = {vx, vy};
  after.angular_velocity = {wx, wy, wz};
  return after;
}

TEST(Mathavan2010, AgreesWithTheSourcesEquationsStepByStep) {
  const Materials m = with_cushion(Mathavan2010Cushion{});
  for (const double side : {-60.0, -20.0, 25.0, 80.0}) {
    Ball<double> ball = ball_at<double>(1.5, 55, true);
    ball.angular_velocity.z = side;
    const auto fine = bounced(ball, m);
    const auto slow = mathavan_step_by_step(ball, m);
    EXPECT_NEAR(fine.velocity.x, slow.velocity.x, 3e-5) << side;
    EXPECT_NEAR(fine.velocity.y, slow.velocity.y, 3e-5) << side;
    EXPECT_NEAR(fine.angular_velocity.x, slow.angular_velocity.x, 3e-3) << side;
    EXPECT_NEAR(fine.angular_velocity.y, slow.angular_velocity.y, 3e-3) << side;
    EXPECT_NEAR(fine.angular_velocity.z, slow.angular_velocity.z, 3e-3) << side;
  }
}

TEST(Mathavan2010, EndsAndGainsNoEnergyAtExtremes) {
  for (const double mu : {0.0, 1e-9, 0.5, 1.0, 30.0, 1e6}) {
    for (const double cloth : {0.0, 0.2, 1.0, 1e6}) {
      for (const double spin : {-1e4, -3.0, 0.0, 3.0, 1e4}) {
        Materials m = with_cushion(Mathavan2010Cushion{0.85, mu, {}});
        m.mu_slide = cloth;
        Ball<double> ball = ball_at<double>(1, 40, false);
        ball.angular_velocity = {spin, -2 * spin, 0.5 * spin};
        const Ball<double> after = bounced(ball, m);
        EXPECT_TRUE(std::isfinite(energy_per_mass(after, m))) << mu << ' ' << cloth << ' ' << spin;
        EXPECT_LE(energy_per_mass(after, m), energy_per_mass(ball, m) * (1 + 1e-12))
            << mu << ' ' << cloth << ' ' << spin;
        EXPECT_LE(after.velocity.x, 1e-12) << mu << ' ' << cloth << ' ' << spin;
      }
    }
  }
}

TEST(Mathavan2010, WithoutFrictionOnlyTurnsTheNormalSpeed) {
  Materials m = with_cushion(Mathavan2010Cushion{0.7, 0, {}});
  m.mu_slide = 0;
  const Ball<double> before = ball_at<double>(2, 35, true);
  const Ball<double> after = bounced(before, m);
  EXPECT_NEAR(after.velocity.x, -0.7 * before.velocity.x, 5e-14);
  EXPECT_NEAR(after.velocity.y, before.velocity.y, 1e-14);
  EXPECT_EQ(after.angular_velocity, before.angular_velocity);
}

TEST(Mathavan2010, WithoutRestitutionIsWhatLittleRestitutionComesTo) {
  const Materials little = with_cushion(Mathavan2010Cushion{1e-6, 0.14, {}});
  for (const double restitution : {0.0, 1e-12, 1e-8}) {
    const Materials m = with_cushion(Mathavan2010Cushion{restitution, 0.14, {}});
    for (const double degrees : {0.0, 20.0, -60.0}) {
      for (const bool rolls : {false, true}) {
        const Ball<double> ball = ball_at<double>(2, degrees, rolls);
        const Ball<double> after = bounced(ball, m), expected = bounced(ball, little);
        EXPECT_NEAR(after.velocity.x, expected.velocity.x, 1e-5);
        EXPECT_NEAR(after.velocity.y, expected.velocity.y, 1e-5);
        EXPECT_NEAR(after.angular_velocity.x, expected.angular_velocity.x, 1e-3);
        EXPECT_NEAR(after.angular_velocity.y, expected.angular_velocity.y, 1e-3);
        EXPECT_NEAR(after.angular_velocity.z, expected.angular_velocity.z, 1e-3);
      }
    }
  }
}

TEST(Damped, ScalesSpeedsAndSpin) {
  Ball<double> ball = ball_at<double>(2, 30, false);
  ball.angular_velocity = {1, 2, 3};
  const Ball<double> after = bounced(ball, preset_materials("olympiad").value());
  EXPECT_DOUBLE_EQ(after.velocity.x, -0.6 * ball.velocity.x);
  EXPECT_DOUBLE_EQ(after.velocity.y, 0.9 * ball.velocity.y);
  EXPECT_DOUBLE_EQ(after.angular_velocity.x, 0.1);
  EXPECT_DOUBLE_EQ(after.angular_velocity.y, 0.2);
  EXPECT_DOUBLE_EQ(after.angular_velocity.z, 0.3);
}

// z = .0535 is a restitution of .85; about 10 ms of contact at 1.7e4 N/m.
TEST(Spring, ReleasesWithTheRestitutionOfItsDampingRatio) {
  const auto release = spring_release<double>(SpringCushion{}, 0.16301);
  EXPECT_NEAR(release.restitution, 0.85, 1e-4);
  EXPECT_NEAR(release.contact_time, 0.0094, 1e-4);
}

TEST(Spring, UndampedGivesEverythingBack) {
  SpringCushion cushion;
  cushion.damping_ratio = 0;
  const auto release = spring_release<double>(cushion, 0.16301);
  EXPECT_EQ(release.restitution, 1);
  EXPECT_NEAR(release.contact_time, std::numbers::pi / std::sqrt(1.7e4 / 0.16301), 1e-15);
}

// The release integrated in small steps of time.
TEST(Spring, AgreesWithTheIntegratedSpring) {
  for (const double z : {0.02, 0.0535, 0.3, 0.8}) {
    SpringCushion cushion;
    cushion.damping_ratio = z;
    const auto release = spring_release<double>(cushion, 1.0);
    const double w = std::sqrt(cushion.stiffness);
    const double dt = 1e-8;
    double x = 0;
    double v = 1;
    double t = 0;
    while (w * x + 2 * z * v > 0) {  // the force over w
      v -= dt * (w * w * x + 2 * z * w * v);
      x += dt * v;
      t += dt;
    }
    EXPECT_NEAR(release.restitution, -v, 1e-5) << z;
    EXPECT_NEAR(release.contact_time, t, 1e-6) << z;
  }
}

TEST(Spring, IsHansImpactWithItsOwnRestitution) {
  const Ball<double> ball = ball_at<double>(1.3, 40, true);
  const double e = spring_release<double>(SpringCushion{}, 0.16301).restitution;
  const auto spring = bounced(ball, with_cushion(SpringCushion{}));
  const auto han = bounced(ball, with_cushion(Han2005Cushion{e, 0.2, {}}));
  EXPECT_EQ(spring.velocity, han.velocity);
  EXPECT_EQ(spring.angular_velocity, han.angular_velocity);
}

TEST(NoseHeight, IsTheCushionsThenTheTablesThenTheStandard) {
  Table table = preset_table("olympiad").value();
  Materials m = with_cushion(Han2005Cushion{});
  EXPECT_EQ(nose_angle<double>(table, m).sine, 0.28);
  EXPECT_NEAR(nose_angle<double>(table, m).cosine, 0.96, 1e-16);
  table.nose_height = 1.2 * radius;
  EXPECT_NEAR(nose_angle<double>(table, m).sine, 0.2, 1e-15);
  m.cushion = Han2005Cushion{0.85, 0.2, 1.4 * radius};
  EXPECT_NEAR(nose_angle<double>(table, m).sine, 0.4, 1e-15);
}

// Every model, at each of the four sides of a table: the bounce turns with the cushion.
TEST(AfterCushion, IsTheSameAtEverySide) {
  const Table table = preset_table("olympiad").value();
  for (const Cushion& cushion : {Cushion{DampedCushion{}}, Cushion{Han2005Cushion{}},
                                 Cushion{SpringCushion{}}, Cushion{Mathavan2010Cushion{}}}) {
    const Materials m = with_cushion(cushion);
    Ball<double> ball = ball_at<double>(1.7, 33, false);
    ball.angular_velocity = {10, -7, 25};
    Vec2<double> into{1, 0};
    Ball<double> expected = bounced(ball, m);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const auto after = after_cushion(ball, into, m, nose_angle<double>(table, m));
      EXPECT_EQ(after.velocity, expected.velocity);
      EXPECT_EQ(after.angular_velocity, expected.angular_velocity);
      into = {-into.y, into.x};
      for (Ball<double>* b : {&ball, &expected}) {
        b->velocity = {-b->velocity.y, b->velocity.x};
        b->angular_velocity = {-b->angular_velocity.y, b->angular_velocity.x,
                               b->angular_velocity.z};
      }
    }
  }
}

// A mirror turns the velocity along the cushion, and of the spin what is not along it.
TEST(AfterCushion, OfAMirrorImageIsTheMirrorImage) {
  for (const Cushion& cushion : {Cushion{DampedCushion{}}, Cushion{Han2005Cushion{}},
                                 Cushion{SpringCushion{}}, Cushion{Mathavan2010Cushion{}}}) {
    const Materials m = with_cushion(cushion);
    Ball<double> ball = ball_at<double>(1.7, 33, false);
    ball.angular_velocity = {10, -7, 25};
    Ball<double> image = ball;
    image.velocity.y = -ball.velocity.y;
    image.angular_velocity = {-10, -7, -25};
    const auto after = bounced(ball, m);
    const auto image_after = bounced(image, m);
    EXPECT_EQ(image_after.velocity.x, after.velocity.x);
    EXPECT_EQ(image_after.velocity.y, -after.velocity.y);
    EXPECT_EQ(image_after.angular_velocity.x, -after.angular_velocity.x);
    EXPECT_EQ(image_after.angular_velocity.y, after.angular_velocity.y);
    EXPECT_EQ(image_after.angular_velocity.z, -after.angular_velocity.z);
  }
}

}  // namespace
}  // namespace poolhall::physics
