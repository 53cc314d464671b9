// The number of the reference: 100 decimal digits (Boost.Multiprecision).
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace poolhall::physics::reference {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                             boost::multiprecision::et_off>;

}  // namespace poolhall::physics::reference
