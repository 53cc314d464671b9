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
  std::string text = fmt::format("Tournament {}: {}, {}, {} entries\n", tournament.record.id,
                                 storage::name(tournament.record.status), name(book.format().kind),
                                 book.names().size());
  text +=
      fmt::format("{} of {} matches over{}, {} games scored\n", over, pairings.size(),
                  book.schedule().is_complete ? "" : " that are known so far", book.games().size());
  if (book.schedule().rounds_drawn > 0) {
    text += fmt::format("Rounds drawn: {}\n", book.schedule().rounds_drawn);
  }
  if (const auto sprt = sprt_line(book)) {
    text += *sprt + '\n';
  }
  return text;
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
