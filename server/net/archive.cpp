#include "server/net/archive.hpp"

#include "server/storage/sqlite_database.hpp"

namespace poolhall::net {

storage::Expected<std::unique_ptr<storage::Reader>> Archive::borrow() {
  {
    const std::lock_guard lock{mutex_};
    if (!idle_.empty()) {
      auto reader = std::move(idle_.back());
      idle_.pop_back();
      return reader;
    }
  }
  return storage::open_sqlite_reader(database_);
}

void Archive::give_back(std::unique_ptr<storage::Reader> reader) {
  const std::lock_guard lock{mutex_};
  idle_.push_back(std::move(reader));
}

}  // namespace poolhall::net
