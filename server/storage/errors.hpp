// Why the storage could not do it, in one line for a person.
//
//   if (!opened) die(opened.error().reason);  // "poolhall.db: locked by another server (pid 71)"
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace poolhall::storage {

enum class StorageFault : std::uint8_t {
  cannot_open,     // no such directory, no permission, not a file
  locked,          // another server owns the file
  not_a_database,  // the file is something else
  foreign,         // a database, but not of this program
  newer_schema,    // written by a newer program
  corrupt,         // the file contradicts itself
  disk_full,
  read_only,
  busy,  // another program holds it for the moment
  io_error,
  conflict,    // a constraint: the row exists already, or refers to nothing
  unreadable,  // a stored value is outside its type's range
  internal,
};
[[nodiscard]] std::string_view name(StorageFault fault);

// Whether the trouble is the file's or the disk's rather than the write's: the same write may
// succeed later, when somebody has seen to it.
[[nodiscard]] bool may_pass(StorageFault fault);

struct StorageError {
  StorageFault fault = StorageFault::internal;
  std::string reason;  // one line
};

template <class T>
using Expected = tl::expected<T, StorageError>;

}  // namespace poolhall::storage
