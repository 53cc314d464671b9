// The real program as a child process, on a free port.
//
//   ServerProcess server{directory};            // its database is directory/server.db
//   WireClient client{server.port()};
//   server.kill();                              // SIGKILL, waited for
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace poolhall::net_tests {

class ServerProcess {
 public:
  explicit ServerProcess(const std::filesystem::path& directory,
                         const std::vector<std::string>& more_arguments = {},
                         const std::vector<std::string>& environment = {});
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  void kill();
  // SIGTERM; the exit code, or -1 when a signal ended it.
  int terminate();
  // Waits for its own end.
  int wait();

 private:
  pid_t pid_ = 0;
  std::uint16_t port_ = 0;
};

}  // namespace poolhall::net_tests
