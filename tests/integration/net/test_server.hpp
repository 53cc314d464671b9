// A server in this process, on a free port, with a database file of its own.
//
//   TestServer server{directory / "test.db"};
//   WireClient client{server.port()};
//   server.stop();       // as by SIGTERM; the file stays
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "server/net/server.hpp"

namespace poolhall::net_tests {

[[nodiscard]] inline net::ServerOptions test_options(const std::filesystem::path& database) {
  net::ServerOptions options;
  options.settings.listen = "127.0.0.1:0";
  options.settings.http = "";
  options.settings.database = database.string();
  options.settings.worker_threads = 2;
  options.signals = net::Signals::left_alone;
  options.program = POOLHALL_PROGRAM;
  return options;
}

class TestServer {
 public:
  explicit TestServer(const net::ServerOptions& options)
      : server_(std::make_unique<net::Server>(options)) {
    if (const auto started = server_->start(); !started) {
      throw std::runtime_error(started.error());
    }
    thread_ = std::thread([this] { exit_code_ = server_->run(); });
  }
  explicit TestServer(const std::filesystem::path& database) : TestServer(test_options(database)) {}
  ~TestServer() { stop(); }
  TestServer(const TestServer&) = delete;
  TestServer& operator=(const TestServer&) = delete;

  // The exit code that the program would have.
  int stop() {
    if (thread_.joinable()) {
      server_->stop();
      thread_.join();
      server_.reset();
    }
    return exit_code_;
  }

  [[nodiscard]] std::uint16_t port() const { return server_->agents_endpoint().port; }
  [[nodiscard]] net::Server& server() { return *server_; }

 private:
  std::unique_ptr<net::Server> server_;
  std::thread thread_;
  int exit_code_ = -1;
};

}  // namespace poolhall::net_tests
