// A number of the normal distribution that 95 % intervals need.
#pragma once

namespace poolhall::ratings {

inline constexpr double normal_quantile_975 = 1.959963984540054;

}  // namespace poolhall::ratings
