// The program that was built, as a server in a child process.
//
//   ServerProcess server{directory};            // its database is directory/server.db
//   WireClient client{server.port()};
//   server.kill();                              // SIGKILL, waited for
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/process/server_process.hpp"

namespace poolhall::net_tests {

class ServerProcess : public test_support::ServerProcess {
 public:
  explicit ServerProcess(const std::filesystem::path& directory,
                         const std::vector<std::string>& more_arguments = {},
                         const std::vector<std::string>& environment = {})
      : test_support::ServerProcess({POOLHALL_PROGRAM, directory, more_arguments, environment}) {}
};

}  // namespace poolhall::net_tests
