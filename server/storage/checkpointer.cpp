#include "server/storage/checkpointer.hpp"

#include <spdlog/spdlog.h>
#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "server/storage/sqlite_connection.hpp"

namespace poolhall::storage {
namespace {

// After a run that could not move everything (a reader of an older state, a full disk): the next
// one would not find it otherwise at once.
constexpr std::chrono::milliseconds pause_after_failure{500};

}  // namespace

Expected<std::unique_ptr<Checkpointer>> Checkpointer::start(const std::filesystem::path& file,
                                                            CheckpointOptions options) {
  auto connection = SqliteConnection::open(file, SqliteConnection::Access::owner);
  if (!connection)
    return tl::unexpected(connection.error());
  return std::unique_ptr<Checkpointer>(new Checkpointer(std::move(*connection), options));
}

Checkpointer::Checkpointer(std::unique_ptr<SqliteConnection> connection, CheckpointOptions options)
    : connection_(std::move(connection)), options_(options), thread_([this] { run(); }) {}

Checkpointer::~Checkpointer() {
  static_cast<void>(stop_and_tell_whether_log_stays());
}

bool Checkpointer::stop_and_tell_whether_log_stays() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
  return disk_has_failed_;
}

void Checkpointer::log_has(int pages) {
  const int moved = moved_;
  const int news = pages < moved ? pages : pages - moved;  // fewer: it has been begun anew
  if (news < options_.pages)
    return;
  const std::lock_guard lock(mutex_);
  if (!std::exchange(due_, true))
    changed_.notify_all();
}

void Checkpointer::begin_writing() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !writers_wait_; });
  writing_ = true;
}

void Checkpointer::end_writing() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(writing_, false))
    changed_.notify_all();
}

void Checkpointer::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return (due_ && !disk_has_failed_) || stopping_; });
    if (stopping_)
      return;
    lock.unlock();
    const bool moved = move_and_begin_anew();
    lock.lock();
    if (!moved && !disk_has_failed_)
      changed_.wait_for(lock, pause_after_failure, [this] { return stopping_; });
    due_ = false;
  }
}

bool Checkpointer::move_and_begin_anew() {
  Move last = move_to_disk();
  if (last.is_whole() && last.in_log >= options_.log_pages && !disk_has_failed_) {
    static_cast<void>(move_to_disk());  // so that little is left
    if (!disk_has_failed_)
      last = move_while_writers_wait();
  }
  moved_ = std::max(last.moved, 0);
  return last.is_whole();
}

Checkpointer::Move Checkpointer::move_while_writers_wait() {
  std::unique_lock lock(mutex_);
  writers_wait_ = true;  // said first: a busy writer leaves no gap to come between
  changed_.wait(lock, [this] { return !writing_ || stopping_; });
  lock.unlock();
  const Move last = move();
  lock.lock();
  writers_wait_ = false;
  changed_.notify_all();
  return last;
}

Checkpointer::Move Checkpointer::move_to_disk() {
  const Move done = move();
  sqlite3_file* file = nullptr;
  sqlite3_file_control(connection_->raw().getHandle(), "main", SQLITE_FCNTL_FILE_POINTER,
                       static_cast<void*>(&file));
  if (file == nullptr || file->pMethods == nullptr ||
      file->pMethods->xSync(file, SQLITE_SYNC_NORMAL | SQLITE_SYNC_DATAONLY) != SQLITE_OK)
    keep_log();
  return done;
}

// The system forgets what it could not write, and the next fsync knows nothing of it.
void Checkpointer::keep_log() {
  if (std::exchange(disk_has_failed_, true))
    return;
  connection_->keep_log_at_close();
  spdlog::error(
      "{}: it could not be brought to the disk. All that is stored from now on stays in {}-wal "
      "beside it: keep both files together, and look after the disk",
      connection_->file(), connection_->file());
}

Checkpointer::Move Checkpointer::move() {
  Move result;
  sqlite3* const handle = connection_->raw().getHandle();
  const int code = sqlite3_wal_checkpoint_v2(handle, nullptr, SQLITE_CHECKPOINT_PASSIVE,
                                             &result.in_log, &result.moved);
  if (code != SQLITE_OK && sqlite3_extended_errcode(handle) == SQLITE_IOERR_FSYNC)
    keep_log();
  return result;
}

}  // namespace poolhall::storage
