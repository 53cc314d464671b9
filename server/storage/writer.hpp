// The one thread that writes. Takes whatever is waiting into one transaction (group commit), and
// tells each caller after the COMMIT that contains its work: what has been told is durable.
//
//   Writer writer(std::move(database), {.deliver = [&](auto work) { asio::post(io, work); },
//                                       .on_health = [&](const WriterHealth& h) { ... }});
//   writer.post([turn](Database& db) { return db.append_turn(turn); },
//               [this](const Expected<void>& stored) { if (stored) tell_everyone(); });
//
// Order is kept: work is run, and its callers are told, in the order of posting. When the disk is
// full, the file locked or broken, nothing is lost: the writer says so (on_health), keeps what it
// has and tries again. Work that cannot succeed (a conflict) is told its error; the rest of its
// group is stored.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "server/storage/database.hpp"

namespace poolhall::storage {

struct WriterHealth {
  std::optional<StorageError> trouble{};  // unset: writing again
  std::uint64_t waiting = 0;              // pieces of work that wait for it
};

struct WriterStatistics {
  std::uint64_t commits = 0;
  std::uint64_t written = 0;  // pieces of work committed
  std::uint64_t largest_group = 0;
  std::uint64_t waiting = 0;
  std::chrono::nanoseconds busy{0};  // running work and committing
};

struct WriterOptions {
  // Runs callbacks where the caller wants them; called from the writer's thread, once for each
  // group. By default they run on the writer's thread.
  std::function<void(std::function<void()>)> deliver{};
  // Delivered like a callback: once when trouble begins or changes, once when it is over.
  std::function<void(const WriterHealth&)> on_health{};
  std::size_t queue_bound = 65'536;
  std::size_t group_bound = 1'024;  // pieces of work in a transaction
  // From the beginning of one commit to the next, where several callers come together: a commit
  // costs about the same whatever is in it. Who comes alone does not wait.
  std::chrono::microseconds between_commits{1'500};
  std::chrono::milliseconds retry_first{50};
  std::chrono::milliseconds retry_longest{2'000};
  // How long stop() goes on trying when the database is in trouble.
  std::chrono::milliseconds patience{5'000};
};

enum class Posted : std::uint8_t {
  accepted,
  full,      // the queue is at its bound: nothing was taken, try later
  stopping,  // stop() was called: nothing was taken
};

class Writer {
 public:
  // Writes through the database and gives no promise yet. May be run more than once (a group is
  // run again after trouble): no effects but on the database.
  using Work = std::function<Expected<void>(Database&)>;
  // Told once: stored durably, or why not.
  using Done = std::function<void(const Expected<void>&)>;

  Writer(std::unique_ptr<Database> database, WriterOptions options);
  ~Writer();  // stop()
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  [[nodiscard]] Posted post(Work work, Done done);

  // Returns when everything posted before is committed and handed to `deliver`, or has been told
  // its error.
  void flush();

  // No more work is taken; what is there is written, then the thread ends.
  void stop();

  [[nodiscard]] WriterStatistics statistics() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poolhall::storage
