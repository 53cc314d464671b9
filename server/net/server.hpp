// The tournament server as one object: listeners, games, house bots, database.
//
//   Server server{{.settings = load_server_settings(file).value()}};
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
#include <vector>

#include <tl/expected.hpp>

#include "server/net/match_host.hpp"
#include "server/settings/server_settings.hpp"

namespace poolhall::net {

enum class Signals : std::uint8_t { handled, left_alone };  // left alone: SIGTERM is the caller's

struct Endpoint {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;  // 0: a free one
};
// "127.0.0.1:7777", "[::1]:7777"; nothing if it is neither.
[[nodiscard]] std::optional<Endpoint> parse_endpoint(const std::string& text);
[[nodiscard]] std::string to_string(const Endpoint& endpoint);
// Why these ports must not be open: others could read what goes over them. One line.
[[nodiscard]] std::optional<std::string> exposed(const settings::ServerSettings& settings);
// Whether only this machine can connect to it.
[[nodiscard]] bool is_loopback(const Endpoint& endpoint);

// What to do when the page's port is taken.
enum class PagePort : std::uint8_t { as_given, or_a_free_one };

struct ServerOptions {
  settings::ServerSettings settings;  // port 0 picks a free one; an empty `http` is no page
  std::optional<std::filesystem::path> ready_file{};
  Signals signals = Signals::handled;
  PagePort page_port = PagePort::as_given;
  StoredTournaments stored_tournaments = StoredTournaments::left_alone;
  std::filesystem::path program = "/proc/self/exe";  // that plays house bots: `program bot NAME`
  std::vector<std::string> house_bots{"random", "greedy", "planner"};  // that may be challenged
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
  [[nodiscard]] std::optional<Endpoint> tls_endpoint() const;
  [[nodiscard]] std::optional<Endpoint> http_endpoint() const;
  [[nodiscard]] std::optional<Endpoint> https_endpoint() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poolhall::net
