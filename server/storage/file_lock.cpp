#include "server/storage/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace poolhall::storage {
namespace {

std::string owner(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
  std::string pid(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  pid.erase(pid.find_last_not_of(" \n") + 1);
  return pid.empty() ? "unknown" : pid;
}

std::string words(int error) {
  return std::generic_category().message(error);
}

}  // namespace

Expected<FileLock> FileLock::take(const std::filesystem::path& file) {
  const std::string beside = file.string() + ".lock";
  const int descriptor = open(beside.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return tl::unexpected(
        StorageError{StorageFault::cannot_open, beside + ": cannot be opened: " + words(errno)});
  }
  FileLock lock(descriptor);
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      return tl::unexpected(
          StorageError{StorageFault::cannot_open, beside + ": cannot be locked: " + words(errno)});
    }
    return tl::unexpected(StorageError{
        StorageFault::locked,
        file.string() + ": locked by another server (process " + owner(descriptor) + ")"});
  }
  const std::string pid = std::to_string(getpid()) + "\n";
  // Only told to people who find the file locked: that it cannot be written is no failure.
  if (ftruncate(descriptor, 0) == 0)
    static_cast<void>(!pwrite(descriptor, pid.data(), pid.size(), 0));
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0)
    close(descriptor_);
}

}  // namespace poolhall::storage
