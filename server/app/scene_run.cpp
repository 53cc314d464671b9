#include "server/app/scene_run.hpp"

namespace poolhall::app {

physics::Expected<SceneRun> run_scene(const protocol::SceneFile& file) {
  switch (file.precision) {
    case protocol::Precision::double_precision:
      return run_scene_in<double>(file);
    case protocol::Precision::long_double:
      return run_scene_in<long double>(file);
    case protocol::Precision::float128:
    case protocol::Precision::mp100:
      break;
  }
  return run_scene_wide(file);
}

}  // namespace poolhall::app
