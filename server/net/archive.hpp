// Reads of the database that keep nobody waiting: each runs on a worker thread with a reader of
// its own, and its answer comes back on the network thread.
//
//   archive.read([id](storage::Reader& reader) { return reader.game(id); },
//                [](storage::Expected<std::optional<storage::GameRecord>> game) { ... });
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "server/storage/database.hpp"

namespace poolhall::net {

class Archive {
 public:
  Archive(std::filesystem::path database, boost::asio::io_context& io,
          boost::asio::thread_pool& workers)
      : database_(std::move(database)), io_(io), workers_(workers) {}

  template <class Work, class Then>
  void read(Work work, Then then) {
    boost::asio::post(workers_, [this, work = std::move(work), then = std::move(then)]() mutable {
      auto result = with_reader(work);
      boost::asio::post(io_, [then = std::move(then), result = std::move(result)]() mutable {
        then(std::move(result));
      });
    });
  }

 private:
  template <class Work>
  auto with_reader(Work& work) -> decltype(work(std::declval<storage::Reader&>())) {
    auto reader = borrow();
    if (!reader) {
      return tl::unexpected(reader.error());
    }
    auto result = work(**reader);
    give_back(std::move(*reader));
    return result;
  }

  [[nodiscard]] storage::Expected<std::unique_ptr<storage::Reader>> borrow();
  void give_back(std::unique_ptr<storage::Reader> reader);

  std::filesystem::path database_;
  boost::asio::io_context& io_;
  boost::asio::thread_pool& workers_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<storage::Reader>> idle_;
};

}  // namespace poolhall::net
