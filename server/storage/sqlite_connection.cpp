#include "server/storage/sqlite_connection.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstdint>
#include <system_error>
#include <utility>

#include "server/storage/sqlite_schema.hpp"

namespace poolhall::storage {
namespace {

constexpr int busy_wait_ms = 1000;

StorageFault fault_of(int code) {
  switch (code) {
    case SQLITE_FULL:
      return StorageFault::disk_full;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return StorageFault::busy;
    case SQLITE_CORRUPT:
      return StorageFault::corrupt;
    case SQLITE_NOTADB:
      return StorageFault::not_a_database;
    case SQLITE_IOERR:
      return StorageFault::io_error;
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return StorageFault::read_only;
    case SQLITE_CONSTRAINT:
      return StorageFault::conflict;
    case SQLITE_CANTOPEN:
      return StorageFault::cannot_open;
    default:
      return StorageFault::internal;
  }
}

std::string words(StorageFault fault) {
  switch (fault) {
    case StorageFault::disk_full:
      return "the disk is full";
    case StorageFault::busy:
      return "another program is writing to it";
    case StorageFault::corrupt:
      return "the file is damaged";
    case StorageFault::not_a_database:
      return "the file is not a database";
    case StorageFault::io_error:
      return "it cannot be read or written";
    case StorageFault::read_only:
      return "no permission to write";
    case StorageFault::conflict:
      return "the row contradicts what is stored";
    case StorageFault::cannot_open:
      return "it cannot be opened";
    default:
      return "the database failed";
  }
}

// Noise keys of games that go on are in the file: only its owner may read it. SQLite gives the log
// beside it the same permissions.
void create_for_owner_alone(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor >= 0)
    close(descriptor);
}

}  // namespace

StorageError storage_error(const SQLite::Exception& exception, const std::string& file) {
  const StorageFault fault = fault_of(exception.getErrorCode() & 0xff);
  return {fault, file + ": " + words(fault) + " (" + exception.what() + ")"};
}

SqliteConnection::Use::~Use() {
  statement_->tryReset();
}

SqliteConnection::SqliteConnection(const std::filesystem::path& file, int flags)
    : file_(file.string()), database_(file_, flags, busy_wait_ms) {}

Expected<void> SqliteConnection::check_path(const std::filesystem::path& file, Access access) {
  const auto cannot = [&](const std::string& why) {
    return tl::unexpected(StorageError{StorageFault::cannot_open, file.string() + ": " + why});
  };
  std::error_code ignored;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored))
    return cannot("there is no directory " + folder.string());
  const bool there = std::filesystem::exists(file, ignored);
  if (!there && access == Access::read_only)
    return cannot("there is no such file");
  if (there && !std::filesystem::is_regular_file(file, ignored))
    return cannot("it is not a file");
  return {};
}

Expected<std::unique_ptr<SqliteConnection>> SqliteConnection::open(
    const std::filesystem::path& file, Access access) {
  if (auto checked = check_path(file, access); !checked)
    return tl::unexpected(checked.error());
  if (access == Access::owner)
    create_for_owner_alone(file);
  const int flags = access == Access::read_only ? SQLite::OPEN_READONLY
                                                : SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE;
  try {
    std::unique_ptr<SqliteConnection> connection(new SqliteConnection(file, flags));
    if (auto prepared = connection->prepare(access); !prepared)
      return tl::unexpected(prepared.error());
    return connection;
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(storage_error(exception, file.string()));
  }
}

Expected<int> SqliteConnection::schema_version() {
  const int application = database_.execAndGet("PRAGMA application_id").getInt();
  const int version = database_.execAndGet("PRAGMA user_version").getInt();
  const int objects = database_.execAndGet("SELECT count(*) FROM sqlite_master").getInt();
  const int known = static_cast<int>(migrations().size());
  if (application == 0 && version == 0 && objects == 0)
    return 0;
  if (application != application_id || version < 1) {
    return tl::unexpected(StorageError{
        StorageFault::foreign, file_ + ": a database, but of another program than poolhall"});
  }
  if (version > known) {
    return tl::unexpected(StorageError{StorageFault::newer_schema,
                                       file_ + ": written by a newer poolhall: schema " +
                                           std::to_string(version) + ", this one knows schema " +
                                           std::to_string(known)});
  }
  return version;
}

void SqliteConnection::migrate(int from) {
  const auto all = migrations();
  for (std::size_t i = static_cast<std::size_t>(from); i < all.size(); ++i) {
    database_.exec("BEGIN IMMEDIATE");
    try {
      database_.exec(std::string(all[i]));
      database_.exec("PRAGMA application_id = " + std::to_string(application_id));
      database_.exec("PRAGMA user_version = " + std::to_string(i + 1));
      database_.exec("COMMIT");
    } catch (...) {
      database_.tryExec("ROLLBACK");
      throw;
    }
  }
}

Expected<void> SqliteConnection::prepare(Access access) {
  const Expected<int> version = schema_version();
  if (!version)
    return tl::unexpected(version.error());
  const int known = static_cast<int>(migrations().size());
  if (access == Access::read_only) {
    if (*version == known)
      return {};
    return tl::unexpected(StorageError{
        StorageFault::cannot_open, *version == 0 ? file_ + ": the database is empty"
                                                 : file_ + ": schema " + std::to_string(*version) +
                                                       " is older than " + std::to_string(known) +
                                                       ": start the server on it once"});
  }
  const std::string journal = database_.execAndGet("PRAGMA journal_mode = WAL").getString();
  if (journal != "wal") {
    return tl::unexpected(StorageError{
        StorageFault::cannot_open,
        file_ + ": this file system has no write-ahead log (journal mode " + journal + ")"});
  }
  database_.exec("PRAGMA synchronous = FULL");
  database_.exec("PRAGMA foreign_keys = ON");
  migrate(*version);
  return {};
}

void SqliteConnection::on_log_growth(std::function<void(int)> told) {
  log_growth_ = std::move(told);
  const auto call = [](void* self, sqlite3*, const char*, int pages) {
    static_cast<SqliteConnection*>(self)->log_growth_(pages);
    return SQLITE_OK;
  };
  sqlite3_wal_hook(database_.getHandle(), call, this);
}

void SqliteConnection::keep_log_at_close() {
  sqlite3_db_config(database_.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

SqliteConnection::Use SqliteConnection::prepared(const std::string& sql) {
  auto found = statements_.find(sql);
  if (found == statements_.end())
    found = statements_.try_emplace(sql, database_, sql).first;
  return Use(found->second);
}

}  // namespace poolhall::storage
