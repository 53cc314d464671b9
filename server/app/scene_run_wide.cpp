// The simulator in 128-bit and 100-digit numbers.
#include <ios>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "physics/simulator_impl.hpp"
#include "server/app/scene_run.hpp"

namespace poolhall {

namespace mp = boost::multiprecision;
// 113 bits, the same on every machine and with every compiler.
using Float128 = mp::number<mp::cpp_bin_float_quad::backend_type, mp::et_off>;
using Mp100 = mp::number<mp::cpp_bin_float<100>, mp::et_off>;

namespace protocol {

template <class Backend>
static void write_real(JsonWriter& out, const mp::number<Backend, mp::et_off>& value) {
  using Number = mp::number<Backend, mp::et_off>;
  if (value == 0) {
    out.raw("0");
    return;
  }
  out.raw(value.str(std::numeric_limits<Number>::max_digits10, std::ios_base::scientific));
}

}  // namespace protocol

namespace app {

physics::Expected<SceneRun> run_scene_wide(const protocol::SceneFile& file) {
  return file.precision == protocol::Precision::float128 ? run_scene_in<Float128>(file)
                                                         : run_scene_in<Mp100>(file);
}

}  // namespace app
}  // namespace poolhall
