// HTTP for people and their tools: /healthz, /metrics, /api/live from what the server knows, the
// rest of /api from the database. GET and HEAD only; nothing here changes anything.
//
//   HttpServer http{io, sources};
//   if (auto bound = http.open(address, port); !bound) die(bound.error());
//   http.start();
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "server/web/admin.hpp"
#include "server/web/pages.hpp"

namespace poolhall::web {

// What pages are made of. All functions are called, and call back, on the network thread.
struct Sources {
  // Runs `work` with a reader of the database elsewhere, then `then` here.
  std::function<void(std::function<Page(storage::Reader&)> work, std::function<void(Page)> then)>
      read;
  std::function<Page()> health;
  std::function<std::string()> metrics;  // Prometheus' text format
  std::function<std::string()> live;     // JSON
  std::function<void(const AdminRequest& request, const Then& then)> admin;
};

class HttpServer {
 public:
  HttpServer(boost::asio::io_context& io, Sources sources);
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  [[nodiscard]] tl::expected<void, std::string> open(const std::string& host, std::uint16_t port);
  void start();
  void stop();
  [[nodiscard]] std::uint16_t port() const;

 private:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  boost::asio::awaitable<void> accept_loop();
  boost::asio::awaitable<void> serve(boost::asio::ip::tcp::socket socket);
  boost::asio::awaitable<Page> page_for(const Request& request);
  boost::asio::awaitable<Page> read(std::string path);
  boost::asio::awaitable<Page> admin(AdminRequest request);
  [[nodiscard]] static bool is_own_origin(std::string_view origin, std::string_view host);
  [[nodiscard]] bool is_own_host(std::string_view host) const;

  boost::asio::io_context& io_;
  Sources sources_;
  boost::asio::ip::tcp::acceptor acceptor_;
  std::string host_;
  std::size_t open_ = 0;
};

}  // namespace poolhall::web
