// JSON lines of export_lines into another database: all of them or none. Ids stay as they are, for
// the checksums cover them; what the database has already must be the same there.
//
//   std::ifstream file("cup.jsonl");
//   auto imported = import_lines(*database, file);
//   if (!imported) say(imported.error().line, imported.error().field, imported.error().reason);
//
// Every checksum, seal and commitment is checked on the way; that the shots are what their
// parameters give is the business of verify().
#pragma once

#include <cstdint>
#include <istream>
#include <string>

#include <tl/expected.hpp>

#include "server/storage/database.hpp"

namespace poolhall::match {

struct ImportError {
  std::uint64_t line = 0;  // from 1; 0: the file as a whole
  std::string field;       // JSON Pointer; empty: the line as a whole
  std::string reason;
};

struct ImportReport {
  std::uint64_t agents = 0;  // that were new here
  std::uint64_t tournaments = 0;
  std::uint64_t matches = 0;
  std::uint64_t games = 0;
  std::uint64_t turns = 0;
};

// The database must be in no transaction.
[[nodiscard]] tl::expected<ImportReport, ImportError> import_lines(storage::Database& database,
                                                                   std::istream& lines);

}  // namespace poolhall::match
