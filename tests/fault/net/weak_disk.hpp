// A disk below SQLite that fails when it is told to: every database that is opened while this lives
// writes through it.
//
//   WeakDisk disk;                     // before the server starts
//   disk.fail_with(SQLITE_FULL);       // from now on nothing can be written
//   disk.work();
#pragma once

#include <sqlite3.h>

#include <atomic>

namespace poolhall::net_tests {

class WeakDisk {
 public:
  WeakDisk();
  ~WeakDisk();
  WeakDisk(const WeakDisk&) = delete;
  WeakDisk& operator=(const WeakDisk&) = delete;

  void fail_with(int code) { failure() = code; }
  void work() { failure() = SQLITE_OK; }

  // What every write gives; SQLITE_OK: it is done.
  [[nodiscard]] static std::atomic<int>& failure();
};

}  // namespace poolhall::net_tests
