#include "server/storage/errors.hpp"

namespace poolhall::storage {

std::string_view name(StorageFault fault) {
  switch (fault) {
    case StorageFault::cannot_open:
      return "cannot_open";
    case StorageFault::locked:
      return "locked";
    case StorageFault::not_a_database:
      return "not_a_database";
    case StorageFault::foreign:
      return "foreign";
    case StorageFault::newer_schema:
      return "newer_schema";
    case StorageFault::corrupt:
      return "corrupt";
    case StorageFault::disk_full:
      return "disk_full";
    case StorageFault::read_only:
      return "read_only";
    case StorageFault::busy:
      return "busy";
    case StorageFault::io_error:
      return "io_error";
    case StorageFault::conflict:
      return "conflict";
    case StorageFault::unreadable:
      return "unreadable";
    case StorageFault::internal:
      break;
  }
  return "internal";
}

bool may_pass(StorageFault fault) {
  switch (fault) {
    case StorageFault::disk_full:
    case StorageFault::busy:
    case StorageFault::io_error:
    case StorageFault::read_only:
    case StorageFault::cannot_open:
    case StorageFault::corrupt:
      return true;
    default:
      return false;
  }
}

}  // namespace poolhall::storage
