#include "server/app/commands.hpp"

namespace poolhall::app {

void add_commands(CLI::App& app, int& exit_code) {
  static_cast<void>(app);
  static_cast<void>(exit_code);
}

}  // namespace poolhall::app
