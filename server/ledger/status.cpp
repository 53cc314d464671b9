#include "server/ledger/status.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace poolhall::ledger {

std::string status_text(const StoredTournament& tournament) {
  const TournamentBook& book = tournament.book;
  const auto& pairings = book.schedule().pairings;
  const auto over = std::count_if(pairings.begin(), pairings.end(), [&](const auto& pairing) {
    return book.is_over(pairing.number);
  });
  const auto left = std::count_if(book.field().begin(), book.field().end(),
                                  [](const auto& span) { return span.until.has_value(); });
  std::string text =
      fmt::format("Tournament {}: {}, {}, {} entries{}\n", tournament.record.id,
                  storage::name(tournament.record.status), name(book.format().kind),
                  book.names().size(), left > 0 ? fmt::format(" ({} withdrawn)", left) : "");
  text +=
      fmt::format("{} of {} matches over{}, {} games scored\n", over, pairings.size(),
                  book.schedule().is_complete ? "" : " that are known so far", book.games().size());
  if (book.schedule().rounds_drawn > 0) {
    text += fmt::format("Rounds drawn: {}\n", book.schedule().rounds_drawn);
  }
  return text + remarks(book);
}

storage::Expected<std::string> list_text(storage::Reader& reader) {
  const auto tournaments = reader.tournaments();
  if (!tournaments) {
    return tl::unexpected(tournaments.error());
  }
  std::string text;
  for (const storage::TournamentRecord& record : *tournaments) {
    const auto settings = settings::parse_tournament(record.settings, record.id);
    text += fmt::format(
        "{:<32}  {:<8}  {}\n", record.id, storage::name(record.status),
        settings ? fmt::format("{}, {} entries", settings->format, settings->entries.size())
                 : std::string("settings of another program"));
  }
  return text.empty() ? "No tournaments.\n" : text;
}

}  // namespace poolhall::ledger
