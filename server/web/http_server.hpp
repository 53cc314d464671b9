// HTTP and WebSocket for people and their tools, on a thread of its own that gives way to games:
// thousands who watch cost those who play next to nothing.
//
//   HttpServer http{{.sources = sources, .publisher = publisher}};
//   if (auto port = http.open(address, 0); !port) die(port.error());
//   if (auto port = http.open(other, 0, &certificate); !port) die(port.error());   // HTTPS too
//   http.start();
//   http.feed().publish(game_topic(17), message);   // from any thread
//   http.stop();                                    // joins the thread
#pragma once

#include <atomic>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <thread>

#include <tl/expected.hpp>

#include "server/web/live_feed.hpp"
#include "server/web/site.hpp"

namespace poolhall::web {

class Wire;

class HttpServer {
 public:
  struct Options {
    Sources sources;
    LiveFeed::Publisher publisher;
    std::string name{};  // of the host, beside those of its addresses and certificates
  };

  explicit HttpServer(Options options);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // Before start(); may be called more than once. The port that it is, where 0 was asked for; the
  // error is one line. With `tls`, which must outlive this, it is HTTPS.
  [[nodiscard]] tl::expected<std::uint16_t, std::string> open(
      const std::string& host, std::uint16_t port, boost::asio::ssl::context* tls = nullptr);
  void start();
  void stop();

  // The web thread's, and threads for what takes longer.
  [[nodiscard]] boost::asio::io_context& io() { return io_; }
  [[nodiscard]] boost::asio::thread_pool& workers() { return workers_; }
  [[nodiscard]] LiveFeed& feed() { return feed_; }
  [[nodiscard]] std::size_t spectators() const { return spectators_; }

 private:
  // An address that is listened on.
  struct Door {
    boost::asio::ip::tcp::acceptor acceptor;
    std::string host;
    boost::asio::ssl::context* tls;  // null: plain
  };
  struct Visitor {
    std::string address;
    const Door& door;
  };

  boost::asio::awaitable<void> accept_loop(Door& door);
  void welcome(boost::asio::ip::tcp::socket socket, const Door& door);
  boost::asio::awaitable<void> serve(Wire wire, Visitor visitor);
  boost::asio::awaitable<void> spectate(Wire wire, Request request, Visitor visitor);
  boost::asio::awaitable<Page> page_for(const Request& request, const Visitor& visitor);
  [[nodiscard]] bool is_own_host(std::string_view host, const Door& door) const;
  // Why a request that says it was made for this host, by a page of that origin, is not answered.
  [[nodiscard]] std::optional<Page> why_not(const Request& request, const Visitor& visitor) const;

  boost::asio::io_context io_{1};
  boost::asio::thread_pool workers_;
  Site site_;
  std::string name_;
  LiveFeed feed_;
  std::list<Door> doors_;
  std::size_t open_ = 0;
  std::map<std::string, std::size_t> open_from_;  // by address
  std::atomic<std::size_t> spectators_ = 0;
  std::thread thread_;
};

}  // namespace poolhall::web
