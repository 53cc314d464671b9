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
  // So many new pages (4 KiB) of the write-ahead log are moved into the database file at a time,
  // beside the commits.
  int pages = 500;
  // The length from which on the log is begun anew. A commit has to wait for that, so that it
  // should be rare; after a crash the log is read as a whole, so that it should be short.
  int log_pages = 8'192;
};

// Creates the file if there is none, and brings an older schema up to date.
[[nodiscard]] Expected<std::unique_ptr<Database>> open_sqlite(const std::filesystem::path& file,
                                                              CheckpointOptions checkpoints = {});

// Never writes and takes no ownership; the file must exist and have this program's schema.
[[nodiscard]] Expected<std::unique_ptr<Reader>> open_sqlite_reader(
    const std::filesystem::path& file);

}  // namespace poolhall::storage
