// Ownership of a file by one process, held on a file beside it. The system takes the lock away
// when the process ends, however it ends; the lock file stays and means nothing by itself.
//
//   Expected<FileLock> lock = FileLock::take("poolhall.db");   // locks poolhall.db.lock
#pragma once

#include <filesystem>

#include "server/storage/errors.hpp"

namespace poolhall::storage {

class FileLock {
 public:
  // StorageFault::locked names the process that has it.
  [[nodiscard]] static Expected<FileLock> take(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace poolhall::storage
