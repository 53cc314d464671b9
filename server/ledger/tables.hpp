// The tables of a tournament as text for people, CSV for spreadsheets and JSON for programs.
//
//   std::cout << table_text("cup", book, Table::standings, TableForm::csv);
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/json_writer.hpp"
#include "server/ledger/tournament_book.hpp"

namespace poolhall::ledger {

enum class Table : std::uint8_t { standings, crosstable };
enum class TableForm : std::uint8_t { text, csv, json };
[[nodiscard]] std::optional<Table> table(std::string_view name);
[[nodiscard]] std::optional<TableForm> table_form(std::string_view name);

// The table that every form shows: on the page, as text, CSV and JSON.
[[nodiscard]] tournament::Standings standings(const TournamentBook& book);

// Ends with a line's end.
[[nodiscard]] std::string table_text(const std::string& id, const TournamentBook& book, Table table,
                                     TableForm form);

// How an SPRT stands, an object.
void write_sprt(protocol::JsonWriter& out, const ratings::SprtState& state);

// FIDE's TRF16; nothing unless it is a Swiss tournament.
[[nodiscard]] std::optional<std::string> trf_text(const std::string& id,
                                                  const TournamentBook& book);

}  // namespace poolhall::ledger
