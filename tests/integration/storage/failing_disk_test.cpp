// A disk that does not take the database file any more (fsync fails), while the log beside it can
// still be written.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "sample_records.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::storage {
namespace {

// As long as it lives, database files that are opened fail to be brought to the disk: once, when it
// has been told so. As with Linux, the next fsync knows nothing of what the failed one left.
class FailingDisk {
 public:
  FailingDisk() : system_(sqlite3_vfs_find(nullptr)), failing_(*system_) {
    real_open = system_->xOpen;
    fails = false;
    refused = 0;
    failing_.zName = "failing-disk";
    failing_.xOpen = open;
    sqlite3_vfs_register(&failing_, 1);
  }
  ~FailingDisk() {
    sqlite3_vfs_unregister(&failing_);
    sqlite3_vfs_register(system_, 1);
  }
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;

  static void fail() { fails = true; }
  [[nodiscard]] static int refusals() { return refused; }

 private:
  static int open(sqlite3_vfs* vfs, sqlite3_filename name, sqlite3_file* file, int flags,
                  int* got) {
    const int code = real_open(vfs, name, file, flags, got);
    if (code == SQLITE_OK && (flags & SQLITE_OPEN_MAIN_DB) != 0) {
      real_methods = file->pMethods;
      methods = *real_methods;
      methods.xSync = sync;
      file->pMethods = &methods;
    }
    return code;
  }
  static int sync(sqlite3_file* file, int flags) {
    if (!fails.exchange(false)) {
      return real_methods->xSync(file, flags);
    }
    ++refused;
    return SQLITE_IOERR_FSYNC;
  }

  static inline int (*real_open)(sqlite3_vfs*, sqlite3_filename, sqlite3_file*, int,
                                 int*) = nullptr;
  static inline const sqlite3_io_methods* real_methods = nullptr;
  static inline sqlite3_io_methods methods{};
  static inline std::atomic<bool> fails = false;
  static inline std::atomic<int> refused = 0;
  sqlite3_vfs* system_;
  sqlite3_vfs failing_;
};

// The disk keeps of the database file what it had before; nothing of what was stored may be gone.
TEST(FailingDisk, LosesNothingThatIsInTheLog) {
  const test_support::TemporaryDirectory directory;
  const std::filesystem::path file = directory / "test.db";
  const std::filesystem::path on_disk = directory / "on_disk.db";
  constexpr std::int64_t agents = 400;
  {
    const FailingDisk disk;
    auto database = open_sqlite(file, {.pages = 20, .log_pages = 100}).value();
    std::filesystem::copy_file(file, on_disk);
    FailingDisk::fail();
    for (std::int64_t id = 1; id <= agents; ++id) {
      ASSERT_TRUE(database->begin());
      AgentRecord agent = sample_agent(id, "agent-" + std::to_string(id));
      agent.token_hash[1] = static_cast<std::uint8_t>(id >> 8U);
      ASSERT_TRUE(database->add_agent(agent));
      ASSERT_TRUE(database->commit());
    }
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    while (FailingDisk::refusals() == 0 && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    EXPECT_GT(FailingDisk::refusals(), 0);
  }
  std::filesystem::copy_file(on_disk, file, std::filesystem::copy_options::overwrite_existing);
  auto again = open_sqlite(file).value();
  EXPECT_EQ(again->agents().value().size(), static_cast<std::size_t>(agents));
  EXPECT_TRUE(again->check_structure().value().empty());
}

}  // namespace
}  // namespace poolhall::storage
