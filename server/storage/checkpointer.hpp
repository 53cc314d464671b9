// Moves what is committed from SQLite's write-ahead log into the database file, on a thread and a
// connection of its own, so that no commit waits for it. What is durable does not change: a commit
// is in the log, on the disk, before anybody is told.
//
//   auto checkpointer = Checkpointer::start(file, {});
//   connection.on_log_growth([&](int pages) { (*checkpointer)->log_has(pages); });
//   (*checkpointer)->begin_writing();  // BEGIN, ..., COMMIT
//   (*checkpointer)->end_writing();
//
// A log that grows all the time is never moved as a whole, and so never begun anew. Therefore, when
// it has become long, the last little is moved while the writer waits for its turn. SQLite brings
// the database file to the disk only then; so each move before does it by itself, or all of it
// would be left to the moment for which the writer waits. Should the disk refuse that, nothing is
// moved any more and the log is never begun anew: the next start reads all of it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "server/storage/sqlite_database.hpp"

namespace poolhall::storage {

class SqliteConnection;

class Checkpointer {
 public:
  [[nodiscard]] static Expected<std::unique_ptr<Checkpointer>> start(
      const std::filesystem::path& file, CheckpointOptions options);
  ~Checkpointer();
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;

  // After each commit, by the thread that writes.
  void log_has(int pages);
  // Around a transaction, by the thread that writes; waits for the second part of a run. Each may
  // be called again without the other.
  void begin_writing();
  void end_writing();

  // Ends the thread. True if the database file could not be brought to the disk: what was moved
  // into it may be lost, so that the log has to stay, whoever closes it.
  [[nodiscard]] bool stop_and_tell_whether_log_stays();

 private:
  Checkpointer(std::unique_ptr<SqliteConnection> connection, CheckpointOptions options);
  // How much a move has found in the log, and how much of that is in the database file now, in
  // pages; -1: it failed.
  struct Move {
    int in_log = -1;
    int moved = -1;
    [[nodiscard]] bool is_whole() const { return in_log >= 0 && moved == in_log; }
  };
  void run();
  // False if something was in the way: a reader of an older state, a full disk.
  [[nodiscard]] bool move_and_begin_anew();
  [[nodiscard]] Move move();
  [[nodiscard]] Move move_to_disk();
  void keep_log();
  [[nodiscard]] Move move_while_writers_wait();

  std::unique_ptr<SqliteConnection> connection_;
  CheckpointOptions options_;
  bool disk_has_failed_ = false;  // the thread's alone while it runs
  std::atomic<int> moved_ = 0;    // by the last move
  std::mutex mutex_;              // of what follows
  std::condition_variable changed_;
  bool due_ = false;
  bool stopping_ = false;
  bool writing_ = false;
  bool writers_wait_ = false;
  std::thread thread_;
};

}  // namespace poolhall::storage
