#include "server/web/table_pages.hpp"

#include <string>

#include "server/ledger/status.hpp"
#include "server/ledger/stored_tournament.hpp"
#include "server/ledger/tables.hpp"

namespace poolhall::web {
namespace {

struct Wanted {
  std::string_view name;
  ledger::TableForm form = ledger::TableForm::json;
  std::string_view content_type = "application/json";
};

Wanted wanted(std::string_view what) {
  if (what.ends_with(".csv")) {
    return {what.substr(0, what.size() - 4), ledger::TableForm::csv, "text/csv"};
  }
  if (what.ends_with(".txt")) {
    return {what.substr(0, what.size() - 4), ledger::TableForm::text, "text/plain"};
  }
  return {.name = what};
}

}  // namespace

Page table_page(storage::Reader& reader, std::string_view tournament, std::string_view what) {
  const Wanted want = wanted(what);
  const auto table = ledger::table(want.name);
  if (!table && what != "trf" && what != "status.txt") {
    return refusal(404, "not_found", "a tournament has standings, crosstable, trf and status.txt");
  }
  const auto stored = ledger::stored_tournament(reader, tournament);
  if (!stored) {
    return refusal(503, "database", stored.error().reason);
  }
  if (!*stored) {
    return refusal(404, "not_found", "there is no such tournament");
  }
  const std::string& id = (*stored)->record.id;
  if (table) {
    return {200, std::string(want.content_type),
            ledger::table_text(id, (*stored)->book, *table, want.form)};
  }
  if (what == "status.txt") {
    return {200, "text/plain", ledger::status_text(**stored)};
  }
  auto trf = ledger::trf_text(id, (*stored)->book);
  if (!trf) {
    return refusal(404, "not_found", "only Swiss tournaments have a TRF");
  }
  return {200, "text/plain", std::move(*trf)};
}

Page tournament_list_page(storage::Reader& reader) {
  const auto text = ledger::list_text(reader);
  return text ? Page{200, "text/plain", *text} : refusal(503, "database", text.error().reason);
}

}  // namespace poolhall::web
