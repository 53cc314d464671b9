#include "weak_disk.hpp"

#include <cstddef>
#include <stdexcept>

namespace poolhall::net_tests {

namespace {

// SQLite's file, which hands everything on to the real one behind it.
struct File {
  sqlite3_file base;
  sqlite3_file* real;
};

sqlite3_file* real(sqlite3_file* file) {
  return reinterpret_cast<File*>(file)->real;
}

template <auto method, class... Arguments>
int handed_on(sqlite3_file* file, Arguments... arguments) {
  return (real(file)->pMethods->*method)(real(file), arguments...);
}

template <auto method, class... Arguments>
int handed_on_unless_failing(sqlite3_file* file, Arguments... arguments) {
  const int failure = WeakDisk::failure();
  return failure != SQLITE_OK ? failure : handed_on<method>(file, arguments...);
}

using Methods = sqlite3_io_methods;

const Methods methods{
    3,
    handed_on<&Methods::xClose>,
    handed_on<&Methods::xRead, void*, int, sqlite3_int64>,
    handed_on_unless_failing<&Methods::xWrite, const void*, int, sqlite3_int64>,
    handed_on<&Methods::xTruncate, sqlite3_int64>,
    handed_on<&Methods::xSync, int>,
    handed_on<&Methods::xFileSize, sqlite3_int64*>,
    handed_on<&Methods::xLock, int>,
    handed_on<&Methods::xUnlock, int>,
    handed_on<&Methods::xCheckReservedLock, int*>,
    handed_on<&Methods::xFileControl, int, void*>,
    handed_on<&Methods::xSectorSize>,
    handed_on<&Methods::xDeviceCharacteristics>,
    handed_on<&Methods::xShmMap, int, int, int, void volatile**>,
    handed_on<&Methods::xShmLock, int, int, int>,
    [](sqlite3_file* file) { real(file)->pMethods->xShmBarrier(real(file)); },
    handed_on<&Methods::xShmUnmap, int>,
    handed_on<&Methods::xFetch, sqlite3_int64, int, void**>,
    handed_on<&Methods::xUnfetch, sqlite3_int64, void*>,
};

sqlite3_vfs* system_disk = nullptr;
sqlite3_vfs weak_disk;

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  auto* const own = reinterpret_cast<File*>(file);
  own->real = reinterpret_cast<sqlite3_file*>(own + 1);
  own->base.pMethods = nullptr;
  const int code = system_disk->xOpen(system_disk, name, own->real, flags, out_flags);
  if (own->real->pMethods != nullptr) {
    own->base.pMethods = &methods;
  }
  return code;
}

}  // namespace

WeakDisk::WeakDisk() {
  system_disk = sqlite3_vfs_find(nullptr);
  weak_disk = *system_disk;
  weak_disk.zName = "weak-disk";
  weak_disk.szOsFile = static_cast<int>(sizeof(File)) + system_disk->szOsFile;
  weak_disk.xOpen = open_file;
  if (sqlite3_vfs_register(&weak_disk, 1) != SQLITE_OK) {
    throw std::runtime_error("the weak disk cannot be registered");
  }
}

WeakDisk::~WeakDisk() {
  sqlite3_vfs_unregister(&weak_disk);
  sqlite3_vfs_register(system_disk, 1);
  work();
}

std::atomic<int>& WeakDisk::failure() {
  static std::atomic<int> code{SQLITE_OK};
  return code;
}

}  // namespace poolhall::net_tests
