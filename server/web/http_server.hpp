// HTTP and WebSocket for people and their tools, on a thread of its own that gives way to games:
// thousands who watch cost those who play next to nothing.
//
//   HttpServer http{{.sources = sources, .publisher = publisher}};
//   if (auto bound = http.open(address, port); !bound) die(bound.error());
//   http.start();
//   http.feed().publish(game_topic(17), message);   // from any thread
//   http.stop();                                    // joins the thread
#pragma once

#include <atomic>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdint>
#include <string>
#include <thread>

#include <tl/expected.hpp>

#include "server/web/live_feed.hpp"
#include "server/web/site.hpp"

namespace poolhall::web {

class HttpServer {
 public:
  struct Options {
    Sources sources;
    LiveFeed::Publisher publisher;
  };

  explicit HttpServer(Options options);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  [[nodiscard]] tl::expected<void, std::string> open(const std::string& host, std::uint16_t port);
  void start();
  void stop();
  [[nodiscard]] std::uint16_t port() const;

  // The web thread's, and threads for what takes longer.
  [[nodiscard]] boost::asio::io_context& io() { return io_; }
  [[nodiscard]] boost::asio::thread_pool& workers() { return workers_; }
  [[nodiscard]] LiveFeed& feed() { return feed_; }
  [[nodiscard]] std::size_t spectators() const { return spectators_; }

 private:
  boost::asio::awaitable<void> accept_loop();
  template <class Stream>
  boost::asio::awaitable<void> serve(Stream stream, std::string address);
  template <class Stream>
  boost::asio::awaitable<void> spectate(Stream stream, Request request);
  boost::asio::awaitable<Page> page_for(const Request& request, std::string address);
  [[nodiscard]] bool is_own_host(std::string_view host) const;

  boost::asio::io_context io_{1};
  boost::asio::thread_pool workers_;
  Site site_;
  LiveFeed feed_;
  boost::asio::ip::tcp::acceptor acceptor_;
  std::string host_;
  std::size_t open_ = 0;
  std::atomic<std::size_t> spectators_ = 0;
  std::thread thread_;
};

}  // namespace poolhall::web
