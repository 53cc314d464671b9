#include "tests/bench/pair_classes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/samples.hpp"

namespace poolhall::bench {

namespace {

using physics::Vec2;

constexpr double slide_acceleration = 0.2 * 9.81;   // m/s^2
constexpr double roll_acceleration = 0.015 * 9.81;  // m/s^2
constexpr double two_r = 2 * 0.028575;              // m

class Dice {
 public:
  Dice(PairClass pair_class, std::uint64_t seed, std::uint64_t index)
      : seed_(seed),
        sample_(index * pair_classes.size() + static_cast<std::uint64_t>(pair_class)) {}

  double between(double low, double high) {
    const auto word = physics::random_words(seed_, sample_, next_++).first;
    return low + (high - low) * static_cast<double>(word >> 11) * 0x1p-53;
  }
  double power_of_ten(double low, double high) { return std::pow(10.0, between(low, high)); }
  double sign() { return chance(0.5) ? 1 : -1; }
  bool chance(double share) { return between(0, 1) < share; }
  Vec2<double> direction() {
    const double angle = between(0, 2 * std::numbers::pi);
    return {std::cos(angle), std::sin(angle)};
  }
  Vec2<double> place() { return {between(0.03, 1.08), between(0.03, 2.2)}; }

 private:
  std::uint64_t seed_;
  std::uint64_t sample_;
  std::uint32_t next_ = 0;
};

Vec2<double> turned_left(const Vec2<double>& p) {
  return {-p.y, p.x};
}

// A ball that rolls or slides with velocity v, and how long it does so.
double give_motion(Disc& disc, const Vec2<double>& v, Dice& dice) {
  disc.velocity = v;
  const double speed = length(v);
  if (dice.chance(0.5)) {
    disc.acceleration = (-roll_acceleration / speed) * v;
    return speed / roll_acceleration;
  }
  disc.acceleration = slide_acceleration * dice.direction();
  return dice.between(0.01, 1.5);
}

DiscPair moving_pair(Dice& dice) {
  DiscPair pair;
  do {
    pair.first.position = dice.place();
    pair.second.position = dice.place();
  } while (length(pair.second.position - pair.first.position) < two_r + 1e-4);
  Vec2<double> heading = dice.direction();
  if (dice.chance(0.7)) {
    const Vec2<double> way = pair.second.position - pair.first.position;
    const double off = dice.between(-1.5, 1.5) * two_r / length(way);
    heading = (1 / length(way)) * way + off * turned_left(way);
    heading = (1 / length(heading)) * heading;
  }
  const double one = give_motion(pair.first, dice.power_of_ten(-0.5, 0.8) * heading, dice);
  const double two = give_motion(pair.second, dice.power_of_ten(-1.5, 0) * dice.direction(), dice);
  pair.horizon = std::min(one, two);
  return pair;
}

// `closing`: -1 for a pair that recedes.
DiscPair touching_pair(Dice& dice, double closing) {
  DiscPair pair;
  const Vec2<double> n = dice.direction();
  pair.first.position = dice.place();
  pair.second.position = pair.first.position + two_r * n;
  const double one = give_motion(pair.first, dice.power_of_ten(-2, 0.7) * dice.direction(), dice);
  if (dice.chance(0.1)) {
    // Without any relative velocity the accelerations decide.
    pair.second.velocity = pair.first.velocity;
    pair.second.acceleration = pair.first.acceleration - closing * dice.power_of_ten(-3, 0.3) * n;
    pair.horizon = one;
    return pair;
  }
  const Vec2<double> relative = -closing * dice.power_of_ten(-6, 0.7) * n +
                                dice.sign() * dice.power_of_ten(-6, 0.3) * turned_left(n);
  const double two = give_motion(pair.second, pair.first.velocity + relative, dice);
  pair.horizon = std::min(one, two);
  return pair;
}

DiscPair grazing_pair(Dice& dice) {
  DiscPair pair;
  const Vec2<double> n = dice.direction();
  const double t = dice.between(0.02, 1.5);
  pair.first.position = dice.place();
  give_motion(pair.first, dice.power_of_ten(-1, 0.7) * dice.direction(), dice);
  // Seen from the first the second passes at right angles to n when it is closest; fast enough for
  // that to be the closest and not the furthest point.
  const Vec2<double> relative = dice.sign() * dice.between(0.6, 5) * turned_left(n);
  const Vec2<double> bend = dice.chance(0.3)
                                ? Vec2<double>{}
                                : dice.between(0, 2 * slide_acceleration) * dice.direction();
  const double miss = dice.sign() * dice.power_of_ten(-18, -15);
  pair.second.acceleration = pair.first.acceleration + bend;
  pair.second.velocity = pair.first.velocity + (relative - t * bend);
  const Vec2<double> back = t * relative - (t * t / 2) * bend;
  pair.second.position = pair.first.position + ((two_r + miss) * n - back);
  pair.horizon = t * dice.between(1.05, 2);
  return pair;
}

// A rolling ball whose way ends about where it would meet another one.
DiscPair slow_pair(Dice& dice) {
  DiscPair pair;
  const Vec2<double> n = dice.direction();
  const double gap = dice.power_of_ten(-14, -3);
  pair.first.position = dice.place();
  pair.second.position = pair.first.position + (two_r + gap) * n;
  const double nearly = dice.sign() * dice.power_of_ten(-16, -0.3);
  const double speed = std::sqrt(2 * roll_acceleration * gap * (1 + nearly));
  const Vec2<double> off =
      dice.chance(0.5) ? Vec2<double>{} : dice.between(-0.3, 0.3) * turned_left(n);
  const Vec2<double> heading = (1 / length(n + off)) * (n + off);
  pair.first.velocity = speed * heading;
  pair.first.acceleration = -roll_acceleration * heading;
  pair.horizon = speed / roll_acceleration;
  if (dice.chance(0.3)) {
    const double other = dice.power_of_ten(-9, -3);
    const Vec2<double> along = dice.direction();
    pair.second.velocity = other * along;
    pair.second.acceleration = -roll_acceleration * along;
    pair.horizon = std::min(pair.horizon, other / roll_acceleration);
  }
  return pair;
}

DiscPair near_equal_pair(Dice& dice) {
  DiscPair pair;
  const Vec2<double> n = dice.direction();
  const double gap = dice.chance(0.1) ? 0 : dice.power_of_ten(-15, -1);
  pair.first.position = dice.place();
  pair.second.position = pair.first.position + (two_r + gap) * n;
  const double duration =
      give_motion(pair.first, dice.power_of_ten(-1, 0.7) * dice.direction(), dice);
  const double speed = length(pair.first.velocity);
  const double size = length(pair.first.acceleration);
  pair.second.velocity = pair.first.velocity;
  pair.second.acceleration = pair.first.acceleration;
  if (!dice.chance(0.1)) {
    const Vec2<double> towards = dice.chance(0.5) ? -1.0 * n : dice.direction();
    pair.second.velocity = pair.second.velocity + speed * dice.power_of_ten(-16, -3) * towards;
  }
  if (!dice.chance(0.4)) {
    const Vec2<double> towards = dice.chance(0.5) ? -1.0 * n : dice.direction();
    pair.second.acceleration =
        pair.second.acceleration + size * dice.power_of_ten(-16, -3) * towards;
  }
  pair.horizon = dice.chance(0.1) ? dice.power_of_ten(0, 4) : duration;
  return pair;
}

double denormal(Dice& dice) {
  return std::ldexp(std::floor(std::pow(2.0, dice.between(0, 40))), -1074);
}

double extreme_size(Dice& dice, double low, double high) {
  const double kind = dice.between(0, 1);
  return kind < 0.15 ? 0 : kind < 0.3 ? denormal(dice) : dice.power_of_ten(low, high);
}

DiscPair extreme_pair(Dice& dice) {
  DiscPair pair;
  const Vec2<double> n = dice.chance(0.2) ? Vec2<double>{1, 0} : dice.direction();
  pair.first.position = dice.chance(0.3) ? Vec2<double>{} : dice.place();
  const double kind = dice.between(0, 1);
  const double gap = kind < 0.2   ? 0
                     : kind < 0.3 ? -dice.power_of_ten(-16, -9)
                                  : dice.power_of_ten(-15, 2);
  pair.second.position = pair.first.position + (two_r + gap) * n;
  if (dice.chance(0.1)) {
    pair.second.position = pair.second.position + denormal(dice) * dice.direction();
  }
  for (Disc* disc : {&pair.first, &pair.second}) {
    const double towards = disc == &pair.first ? 1 : -1;
    disc->velocity =
        extreme_size(dice, -9, 3) * (dice.chance(0.5) ? towards * n : dice.direction());
    disc->acceleration =
        extreme_size(dice, -6, 7) * (dice.chance(0.3) ? -towards * n : dice.direction());
  }
  const double scale = dice.between(0, 1);
  pair.horizon = scale < 0.2   ? dice.power_of_ten(-300, -9)
                 : scale < 0.7 ? dice.power_of_ten(-9, 4)
                               : dice.power_of_ten(4, 60);
  return pair;
}

}  // namespace

const char* name(PairClass pair_class) {
  switch (pair_class) {
    case PairClass::moving:
      return "moving, moving";
    case PairClass::touching_receding:
      return "touching, receding";
    case PairClass::touching_approaching:
      return "touching, approaching";
    case PairClass::grazing:
      return "grazing to 1e-15 m";
    case PairClass::slow:
      return "slow";
    case PairClass::near_equal:
      return "near-equal motion";
    case PairClass::extreme:
      return "extremes";
  }
  return "";
}

DiscPair random_pair(PairClass pair_class, std::uint64_t seed, std::uint64_t index) {
  Dice dice(pair_class, seed, index);
  switch (pair_class) {
    case PairClass::moving:
      return moving_pair(dice);
    case PairClass::touching_receding:
      return touching_pair(dice, -1);
    case PairClass::touching_approaching:
      return touching_pair(dice, 1);
    case PairClass::grazing:
      return grazing_pair(dice);
    case PairClass::slow:
      return slow_pair(dice);
    case PairClass::near_equal:
      return near_equal_pair(dice);
    case PairClass::extreme:
      return extreme_pair(dice);
  }
  return {};
}

}  // namespace poolhall::bench
