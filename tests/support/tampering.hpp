// Damage to a database: one bit of a stored value, or of the file, and what of the games it
// changed.
//
//   Tampering tampering(file);
//   for (const StoredValue& value : tampering.values())
//     if (tampering.flip(value, random)) { ...verify...; tampering.restore(value); }
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/support/raw_sqlite.hpp"

namespace poolhall::test_support {

// A value of a row of one of the tables that games consist of.
struct StoredValue {
  std::string table;
  std::string column;
  std::int64_t row = 0;   // rowid
  std::int64_t game = 0;  // 0: a match's row
  std::int64_t turn = 0;  // 0: a game's row
  int type = SQLITE_NULL;
  std::string bytes;  // integers and reals: their 8 bytes
};

class Tampering {
 public:
  explicit Tampering(const std::filesystem::path& file) : database_(file) {}

  // All that are not null.
  [[nodiscard]] std::vector<StoredValue> values() {
    std::vector<StoredValue> all;
    collect("matches", "rowid, 0, 0", all);
    collect("games", "rowid, id, 0", all);
    collect("turns", "rowid, game, number", all);
    return all;
  }

  // Changes one bit; not where the table would not take the value.
  template <class Random>
  [[nodiscard]] bool flip(const StoredValue& value, Random& random) {
    constexpr int tries = 100;
    for (int i = 0; i < tries && !value.bytes.empty(); ++i) {
      std::string changed = value.bytes;
      changed[random() % changed.size()] ^= static_cast<char>(1U << (random() % 8));
      if (store(value, changed))
        return true;
    }
    return false;
  }

  void restore(const StoredValue& value) {
    if (!store(value, value.bytes))
      throw std::runtime_error("cannot restore " + value.table + "." + value.column);
  }

 private:
  void collect(const std::string& table, const std::string& key, std::vector<StoredValue>& all) {
    sqlite3_stmt* statement = nullptr;
    const std::string sql = "SELECT " + key + ", * FROM " + table;
    sqlite3_prepare_v2(database_.handle(), sql.c_str(), -1, &statement, nullptr);
    constexpr int key_columns = 3;
    while (sqlite3_step(statement) == SQLITE_ROW) {
      for (int i = key_columns; i < sqlite3_column_count(statement); ++i) {
        StoredValue value{.table = table,
                          .column = sqlite3_column_name(statement, i),
                          .row = sqlite3_column_int64(statement, 0),
                          .game = sqlite3_column_int64(statement, 1),
                          .turn = sqlite3_column_int64(statement, 2),
                          .type = sqlite3_column_type(statement, i),
                          .bytes = {}};
        value.bytes = bytes_of(statement, i, value.type);
        if (value.type != SQLITE_NULL)
          all.push_back(std::move(value));
      }
    }
    sqlite3_finalize(statement);
  }

  static std::string bytes_of(sqlite3_stmt* statement, int i, int type) {
    std::string bytes(8, '\0');
    if (type == SQLITE_INTEGER) {
      const std::int64_t integer = sqlite3_column_int64(statement, i);
      std::memcpy(bytes.data(), &integer, 8);
    } else if (type == SQLITE_FLOAT) {
      const double real = sqlite3_column_double(statement, i);
      std::memcpy(bytes.data(), &real, 8);
    } else if (type != SQLITE_NULL) {
      const auto* begin = static_cast<const char*>(sqlite3_column_blob(statement, i));
      bytes.assign(begin, begin + sqlite3_column_bytes(statement, i));
    }
    return bytes;
  }

  static void bind(sqlite3_stmt* statement, int type, const std::string& bytes) {
    if (type == SQLITE_INTEGER) {
      std::int64_t integer = 0;
      std::memcpy(&integer, bytes.data(), 8);
      sqlite3_bind_int64(statement, 1, integer);
    } else if (type == SQLITE_FLOAT) {
      double real = 0;
      std::memcpy(&real, bytes.data(), 8);
      sqlite3_bind_double(statement, 1, real);
    } else if (type == SQLITE_TEXT) {
      sqlite3_bind_text(statement, 1, bytes.data(), static_cast<int>(bytes.size()),
                        SQLITE_TRANSIENT);
    } else {
      sqlite3_bind_blob(statement, 1, bytes.data(), static_cast<int>(bytes.size()),
                        SQLITE_TRANSIENT);
    }
  }

  // The rowid of matches and games is their id: a row with another id is found by that.
  bool store(const StoredValue& value, const std::string& bytes) {
    std::int64_t row = value.row;
    const bool is_rowid = value.column == "id";
    if (is_rowid && moved_to_ != 0)
      row = moved_to_;
    sqlite3_stmt* statement = nullptr;
    const std::string sql =
        "UPDATE " + value.table + " SET " + value.column + " = ?1 WHERE rowid = ?2";
    sqlite3_prepare_v2(database_.handle(), sql.c_str(), -1, &statement, nullptr);
    bind(statement, value.type, bytes);
    sqlite3_bind_int64(statement, 2, row);
    const bool stored =
        sqlite3_step(statement) == SQLITE_DONE && sqlite3_changes(database_.handle()) == 1;
    sqlite3_finalize(statement);
    if (stored && is_rowid) {
      std::memcpy(&moved_to_, bytes.data(), 8);
      moved_to_ = moved_to_ == value.row ? 0 : moved_to_;
    }
    return stored;
  }

  RawSqlite database_;
  std::int64_t moved_to_ = 0;  // where the row is whose id was changed
};

// All stored values of the games in one text; "unreadable" if SQLite cannot read them.
[[nodiscard]] inline std::string all_values(const std::filesystem::path& file) {
  try {
    std::string text;
    for (const StoredValue& value : Tampering(file).values())
      text += value.table + "." + value.column + " " + std::to_string(value.row) + " " +
              std::to_string(value.type) + " " + value.bytes + "\n";
    return text;
  } catch (const std::exception&) {
    return "unreadable";
  }
}

[[nodiscard]] inline std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_database(const std::filesystem::path& file, const std::string& bytes) {
  for (const char* beside : {"-wal", "-shm"})
    std::filesystem::remove(file.string() + beside);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace poolhall::test_support
