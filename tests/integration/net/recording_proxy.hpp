// Stands between a client program and the server and writes down what they say to each other
// (tests/support/session_recorder.hpp). One connection at a time.
//
//   RecordingProxy proxy{server.port()};
//   run("bot 127.0.0.1:" + std::to_string(proxy.port()));
#pragma once

#include <cstdint>
#include <thread>

namespace poolhall::net_tests {

class RecordingProxy {
 public:
  explicit RecordingProxy(std::uint16_t server);
  ~RecordingProxy();
  RecordingProxy(const RecordingProxy&) = delete;
  RecordingProxy& operator=(const RecordingProxy&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  void serve() const;
  void pass_on(int client) const;

  std::uint16_t server_;
  int listener_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

}  // namespace poolhall::net_tests
