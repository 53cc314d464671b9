// One SQLite connection: opened and migrated, its prepared statements, and its errors as the
// room's own. Inside this room exceptions are SQLite's; `guarded` is the door.
//
//   return guarded([&] { auto use = connection.prepared(sql); Binder(*use) << game; use->exec();
//   });
#pragma once

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "server/storage/errors.hpp"
#include "server/storage/sqlite_rows.hpp"

namespace poolhall::storage {

[[nodiscard]] StorageError storage_error(const SQLite::Exception& exception,
                                         const std::string& file);

class SqliteConnection {
 public:
  enum class Access : std::uint8_t { read_only, owner };

  // Why there cannot be a database, where SQLite's own refusal would not say it.
  [[nodiscard]] static Expected<void> check_path(const std::filesystem::path& file, Access access);

  [[nodiscard]] static Expected<std::unique_ptr<SqliteConnection>> open(
      const std::filesystem::path& file, Access access);

  // A statement in use: reset and free again when this goes out of scope.
  class Use {
   public:
    explicit Use(SQLite::Statement& statement) : statement_(&statement) {}
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use();
    SQLite::Statement* operator->() const { return statement_; }
    SQLite::Statement& operator*() const { return *statement_; }

   private:
    SQLite::Statement* statement_;
  };

  // Prepared once; not to be used twice at a time.
  [[nodiscard]] Use prepared(const std::string& sql);
  [[nodiscard]] SQLite::Database& raw() { return database_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  // Calls this after each commit with the number of pages in the write-ahead log, instead of moving
  // them into the database file now and then.
  void on_log_growth(std::function<void(int)> told);
  // Leaves the write-ahead log as it is when this connection is closed as the last one.
  void keep_log_at_close();

  template <class F>
  [[nodiscard]] auto guarded(F&& work) -> Expected<std::invoke_result_t<F>> {
    try {
      if constexpr (std::is_void_v<std::invoke_result_t<F>>) {
        std::forward<F>(work)();
        return {};
      } else {
        return std::forward<F>(work)();
      }
    } catch (const Unreadable& unreadable) {
      return tl::unexpected(StorageError{StorageFault::unreadable, unreadable.what()});
    } catch (const SQLite::Exception& exception) {
      return tl::unexpected(storage_error(exception, file_));
    }
  }

 private:
  SqliteConnection(const std::filesystem::path& file, int flags);

  [[nodiscard]] Expected<void> prepare(Access access);
  [[nodiscard]] Expected<int> schema_version();
  void migrate(int from);

  std::string file_;
  std::function<void(int)> log_growth_;
  SQLite::Database database_;
  std::map<std::string, SQLite::Statement, std::less<>> statements_;
};

}  // namespace poolhall::storage
