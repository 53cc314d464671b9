// Where the benchmarks of a server put its database: figures of a disk want a disk.
//
//   const std::filesystem::path place = place_on_disk(options.directory);
#pragma once

#include <linux/magic.h>
#include <sys/vfs.h>

#include <filesystem>

namespace poolhall::bench {

[[nodiscard]] inline bool is_in_memory(const std::filesystem::path& directory) {
  struct statfs what {};
  return ::statfs(directory.c_str(), &what) == 0 &&
         (what.f_type == TMPFS_MAGIC || what.f_type == RAMFS_MAGIC);
}

// `wanted`, unless it is empty; else the folder for temporary files, or this one if that is none.
[[nodiscard]] inline std::filesystem::path place_on_disk(const std::filesystem::path& wanted) {
  if (!wanted.empty()) {
    return wanted;
  }
  const std::filesystem::path temporary = std::filesystem::temp_directory_path();
  return is_in_memory(temporary) ? std::filesystem::current_path() : temporary;
}

}  // namespace poolhall::bench
