// The tournament server as one object: listeners, games, house bots, database.
//
//   Server server{options};
//   if (auto started = server.start(); !started) die(started.error());   // one line
//   server.post([&](MatchHost& host) { host.start_match(order); });
//   server.run();   // until SIGTERM, SIGINT or stop(); 0 when it ended in order
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "server/net/match_host.hpp"

namespace poolhall::net {

enum class Registration : std::uint8_t { open, closed };
enum class Signals : std::uint8_t { handled, left_alone };  // left alone: SIGTERM is the caller's

struct Endpoint {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;  // 0: a free one
};
// "127.0.0.1:7777", "[::1]:7777"; nothing if it is neither.
[[nodiscard]] std::optional<Endpoint> parse_endpoint(const std::string& text);
[[nodiscard]] std::string to_string(const Endpoint& endpoint);

struct ServerOptions {
  Endpoint listen{"127.0.0.1", 7777};
  std::optional<Endpoint> http{};
  std::filesystem::path database = "poolhall.db";
  std::optional<std::filesystem::path> ready_file{};
  Registration registration = Registration::open;
  Signals signals = Signals::handled;
  std::string server_name = "poolhall";
  std::filesystem::path program = "/proc/self/exe";  // that plays house bots: `program bot NAME`
  std::uint32_t max_house_bots = 16;
  std::uint32_t worker_threads = 0;  // 0: one a core
  std::uint32_t max_connections = 16'384;
};

class Server {
 public:
  explicit Server(ServerOptions options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Opens the database, takes up unfinished games, listens, writes the ready file. The error is
  // one line for a person.
  [[nodiscard]] tl::expected<void, std::string> start();
  // Serves on the calling thread until it is stopped; the program's exit code.
  [[nodiscard]] int run();

  // These may be called from any thread, once started.
  void stop();  // in order: shots in flight finish, everyone is told
  void post(std::function<void(MatchHost&)> work);
  [[nodiscard]] Endpoint agents_endpoint() const;
  [[nodiscard]] std::optional<Endpoint> http_endpoint() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poolhall::net
