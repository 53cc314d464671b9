// What the page's port answers, whatever carries the bytes: the page's files, the JSON API, the
// workbench. The web thread's own; nothing here waits for a game or a disk on it.
//
//   Site site{io, workers, sources};
//   Page page = co_await site.answer(request, "127.0.0.1");
#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/storage/database.hpp"
#include "server/web/admin.hpp"
#include "server/web/page.hpp"
#include "server/web/token_bucket.hpp"

namespace poolhall::web {

using Request = boost::beast::http::request<boost::beast::http::string_body>;

// What pages are made of. All functions are called on the web thread and return at once; their
// `then` is called there too.
struct Sources {
  // Runs `work` with a reader of the database elsewhere.
  std::function<void(std::function<Page(storage::Reader&)> work, Then then)> read;
  // Asked of the thread on which the games are.
  std::function<void(Then then)> health;
  std::function<void(Then then)> metrics;  // Prometheus' text format
  std::function<void(Then then)> live;     // JSON
  std::function<void(AdminRequest request, Then then)> admin;
  std::chrono::milliseconds delay{0};         // what happened since then is not told yet
  std::uint32_t simulations_per_second = 10;  // of the workbench, for each address
};

class Site {
 public:
  Site(boost::asio::io_context& io, boost::asio::thread_pool& workers, Sources sources);
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  [[nodiscard]] boost::asio::awaitable<Page> answer(const Request& request, std::string address);

  // How long a request's body may be, by its target.
  static constexpr std::uint64_t most_body_bytes = 256 * 1024;  // a tournament of 256 entries
  [[nodiscard]] static std::uint64_t body_limit(std::string_view target);

 private:
  struct Kept {
    std::chrono::steady_clock::time_point until{};
    Page page{};
    std::vector<Then> waiting{};  // while it is being made
  };

  [[nodiscard]] boost::asio::awaitable<Page> get(std::string path);
  [[nodiscard]] boost::asio::awaitable<Page> stored(const std::string& path);
  [[nodiscard]] boost::asio::awaitable<Page> simulate(const std::string& body,
                                                      const std::string& path);
  [[nodiscard]] boost::asio::awaitable<Page> admin(const Request& request, const std::string& path);
  void read(const std::string& path, Then then);
  void read_shared(const std::string& path, Then then);
  [[nodiscard]] bool may_simulate(const std::string& address);

  boost::asio::io_context& io_;
  boost::asio::thread_pool& workers_;
  Sources sources_;
  // By path. What is still being made when a host's call is done keeps those who wait for it.
  std::map<std::string, std::shared_ptr<Kept>> kept_;
  std::map<std::string, TokenBucket> simulations_;  // by address
};

}  // namespace poolhall::web
