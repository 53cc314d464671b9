#include "physics/noise.hpp"

#include <cmath>

#include "physics/math.hpp"
#include "physics/noise_presets.hpp"

namespace poolhall::physics {
namespace {

constexpr double millimetre = 1000;  // in a metre, divided by

template <std::size_t n>
double rational(double x, const std::array<double, n>& top, const std::array<double, n>& bottom) {
  double p = top[n - 1];
  double q = bottom[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) {
    p = p * x + top[i];
    q = q * x + bottom[i];
  }
  return p / q;
}

// Wichura 1988, PPND16: |p - 1/2| <= 0.425, argument 0.180625 - q^2.
double central(double x) {
  constexpr std::array<double, 8> a{3.3871328727963666080e0,  1.3314166789178437745e+2,
                                    1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                    4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                    3.3430575583588128105e+4, 2.5090809287301226727e+3};
  constexpr std::array<double, 8> b{1.0,
                                    4.2313330701600911252e+1,
                                    6.8718700749205790830e+2,
                                    5.3941960214247511077e+3,
                                    2.1213794301586595867e+4,
                                    3.9307895800092710610e+4,
                                    2.8729085735721942674e+4,
                                    5.2264952788528545610e+3};
  return rational(x, a, b);
}

// r <= 5, argument r - 1.6.
double near_tail(double x) {
  constexpr std::array<double, 8> c{1.42343711074968357734e0,  4.63033784615654529590e0,
                                    5.76949722146069140550e0,  3.64784832476320460504e0,
                                    1.27045825245236838258e0,  2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr std::array<double, 8> d{1.0,
                                    2.05319162663775882187e0,
                                    1.67638483018380384940e0,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9};
  return rational(x, c, d);
}

// r > 5, argument r - 5.
double far_tail(double x) {
  constexpr std::array<double, 8> e{6.65790464350110377720e0,  5.46378491116411436990e0,
                                    1.78482653991729133580e0,  2.96560571828504891230e-1,
                                    2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr std::array<double, 8> f{1.0,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};
  return rational(x, e, f);
}

}  // namespace

std::optional<NoiseLevel> preset_noise(std::string_view name) {
  const double degree = pi<double>() / 180;
  for (const NoisePreset& preset : noise_presets()) {
    if (preset.name != name)
      continue;
    const ShotParameters<double>& d = preset.deviations;
    return NoiseLevel{d.a / millimetre, d.b / millimetre, d.theta * degree, d.phi * degree, d.v};
  }
  return std::nullopt;
}

NoiseLevel scaled(const NoiseLevel& level, double factor) {
  return {factor * level.a, factor * level.b, factor * level.theta, factor * level.phi,
          factor * level.speed};
}

CueShot<double> with_noise(const CueShot<double>& intended, const NoiseLevel& level,
                           const ShotDeviates& deviates) {
  const double degree = pi<double>() / 180;
  ShotParameters<double> executed = intended.given;
  executed.a += level.a * millimetre * deviates[0];
  executed.b += level.b * millimetre * deviates[1];
  executed.theta += level.theta / degree * deviates[2];
  executed.phi = std::fmod(executed.phi, 360.0) + level.phi / degree * deviates[3];
  executed.v += level.speed * deviates[4];
  return cue_shot(executed);
}

double normal_quantile(double p) {
  const double q = p - 0.5;
  if (q >= -0.425 && q <= 0.425)
    return q * central(0.180625 - q * q);
  const double r = square_root(-natural_logarithm(q < 0 ? p : 1 - p));
  const double size = r <= 5 ? near_tail(r - 1.6) : far_tail(r - 5);
  return q < 0 ? -size : size;
}

double uniform_deviate(std::uint64_t bits) {
  // The half is rounded away in the upper half of the interval, and up to 1 in its last place.
  const double deviate = (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
  return deviate < 1 ? deviate : 1 - 0x1p-53;
}

}  // namespace poolhall::physics
