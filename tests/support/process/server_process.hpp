// The real program as a server in a child process, on free ports.
//
//   ServerProcess server({.program = program, .directory = directory});  // directory/server.db
//   connect(server.port());
//   server.kill();                              // SIGKILL, waited for
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/process/child.hpp"

namespace poolhall::test_support {

struct ServerProcessOptions {
  std::filesystem::path program = "/proc/self/exe";
  std::filesystem::path directory;  // of its database, its log and its ready file
  std::vector<std::string> more_arguments{};
  std::vector<std::string> environment{};
};

class ServerProcess {
 public:
  // Returns when it listens; throws std::runtime_error when it does not.
  explicit ServerProcess(const ServerProcessOptions& options);

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::uint16_t http_port() const { return http_port_; }
  [[nodiscard]] pid_t pid() const { return child_.pid(); }
  [[nodiscard]] bool has_ended() const { return child_.has_ended(); }
  void kill();
  // SIGTERM; the exit code, or -1 when a signal ended it.
  int terminate();
  // Waits for its own end.
  int wait();

 private:
  std::filesystem::path ready_;
  Child child_;
  std::uint16_t port_ = 0;
  std::uint16_t http_port_ = 0;
};

}  // namespace poolhall::test_support
