// A database file handled from outside, as another program would: for tests that damage it or hold
// its lock.
//
//   RawSqlite(file).run("UPDATE turns SET moved = 1");
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace poolhall::test_support {

class RawSqlite {
 public:
  explicit RawSqlite(const std::filesystem::path& file) {
    if (sqlite3_open(file.c_str(), &handle_) != SQLITE_OK)
      throw std::runtime_error("cannot open " + file.string());
  }
  RawSqlite(const RawSqlite&) = delete;
  RawSqlite& operator=(const RawSqlite&) = delete;
  ~RawSqlite() { sqlite3_close(handle_); }

  [[nodiscard]] sqlite3* handle() const { return handle_; }

  void run(const std::string& sql) {
    char* message = nullptr;
    if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, &message) == SQLITE_OK)
      return;
    const std::string reason = message != nullptr ? message : "failed";
    sqlite3_free(message);
    throw std::runtime_error(sql + ": " + reason);
  }

  // The first column of the first row, as a text.
  [[nodiscard]] std::string text(const std::string& sql) {
    std::string found;
    const auto keep = [](void* out, int, char** values, char**) {
      *static_cast<std::string*>(out) = values[0] != nullptr ? values[0] : "";
      return 0;
    };
    if (sqlite3_exec(handle_, sql.c_str(), keep, &found, nullptr) != SQLITE_OK)
      throw std::runtime_error(sql);
    return found;
  }

 private:
  sqlite3* handle_ = nullptr;
};

}  // namespace poolhall::test_support
