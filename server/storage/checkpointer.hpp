// Moves what is committed from SQLite's write-ahead log into the database file, on a thread and a
// connection of its own, so that no commit waits for it. What is durable does not change: a commit
// is in the log, on the disk, before anybody is told.
//
//   auto checkpointer = Checkpointer::start(file, {});
//   connection.on_log_growth([&](int pages) { (*checkpointer)->log_has(pages); });
//   (*checkpointer)->begin_writing();  // BEGIN, ..., COMMIT
//   (*checkpointer)->end_writing();
//
// A log that grows all the time is never moved as a whole, and so never begun anew. Therefore each
// run has two parts: most of it beside the writer, then the little that came meanwhile while the
// writer waits for its turn. That is what bounds the log.
#pragma once

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

 private:
  Checkpointer(std::unique_ptr<SqliteConnection> connection, CheckpointOptions options);
  void run();
  // Whether everything that is in the log is in the database file too.
  [[nodiscard]] bool move_all();
  [[nodiscard]] bool move_once();

  std::unique_ptr<SqliteConnection> connection_;
  CheckpointOptions options_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  bool due_ = false;
  bool stopping_ = false;
  bool writing_ = false;
  bool writers_wait_ = false;
  std::thread thread_;
};

}  // namespace poolhall::storage
