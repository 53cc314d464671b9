// The SQLite implementation: WAL, foreign keys, synchronous=FULL, numbered migrations.
//
//   auto database = open_sqlite("poolhall.db");          // the server: owns the file
//   auto reader = open_sqlite_reader("poolhall.db");     // beside it, or alone
//
// One process owns the file: it holds a lock on `<file>.lock`, which the system takes away when
// the process ends, however it ends.
#pragma once

#include <filesystem>
#include <memory>

#include "server/storage/database.hpp"

namespace poolhall::storage {

struct CheckpointOptions {
  // The write-ahead log's length from which on it is moved into the database file, beside the
  // commits, in pages of 4 KiB. More at a time keeps the disk from the commits for longer: with
  // 8,192 the slowest of 100 shots took four times as long.
  int pages = 500;
};

// Creates the file if there is none, and brings an older schema up to date.
[[nodiscard]] Expected<std::unique_ptr<Database>> open_sqlite(const std::filesystem::path& file,
                                                              CheckpointOptions checkpoints = {});

// Never writes and takes no ownership; the file must exist and have this program's schema.
[[nodiscard]] Expected<std::unique_ptr<Reader>> open_sqlite_reader(
    const std::filesystem::path& file);

}  // namespace poolhall::storage
