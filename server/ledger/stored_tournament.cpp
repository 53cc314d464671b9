#include "server/ledger/stored_tournament.hpp"

#include <algorithm>

namespace poolhall::ledger {

namespace {

storage::Expected<std::vector<Entered>> entered_of(storage::Reader& reader, std::string_view id) {
  const auto entries = reader.entries(id);
  if (!entries) {
    return tl::unexpected(entries.error());
  }
  std::vector<Entered> entered;
  for (const storage::EntryRecord& entry : *entries) {
    const auto agent = reader.agent(entry.agent);
    if (!agent) {
      return tl::unexpected(agent.error());
    }
    if (*agent) {
      entered.push_back({(*agent)->name, {entry.from_round, entry.until_round}});
    }
  }
  return entered;
}

}  // namespace

storage::Expected<std::optional<StoredTournament>> stored_tournament(storage::Reader& reader,
                                                                     std::string_view id,
                                                                     storage::UnixMicros until) {
  const auto is_seen = [until](const std::optional<storage::UnixMicros>& finished) {
    return until == no_horizon || (finished && *finished <= until);
  };
  const auto tournaments = reader.tournaments();
  if (!tournaments) {
    return tl::unexpected(tournaments.error());
  }
  const auto record = std::find_if(tournaments->begin(), tournaments->end(),
                                   [&](const auto& one) { return one.id == id; });
  if (record == tournaments->end()) {
    return std::nullopt;
  }
  const auto settings = settings::parse_tournament(record->settings, record->id);
  if (!settings) {
    return tl::unexpected(
        storage::StorageError{storage::StorageFault::unreadable, settings::text(settings.error())});
  }
  const auto matches = reader.matches_of(id);
  if (!matches) {
    return tl::unexpected(matches.error());
  }
  StoredTournament stored{*record, TournamentBook(*settings)};
  const auto entered = entered_of(reader, id);
  if (!entered) {
    return tl::unexpected(entered.error());
  }
  stored.book.set_field(*entered);
  for (const storage::MatchRecord& match : *matches) {
    const auto games = reader.games_of(match.id);
    if (!games) {
      return tl::unexpected(games.error());
    }
    std::vector<ScoredGame> scored;
    for (const storage::GameRecord& game : *games) {
      if (const auto counts = scored_game(match, game); counts && is_seen(game.finished)) {
        scored.push_back(*counts);
      }
    }
    stored.book.take(
        match.pairing.value_or(0), scored,
        match.over && is_seen(match.finished) ? MatchStage::over : MatchStage::going_on);
  }
  stored.book.plan();
  return stored;
}

}  // namespace poolhall::ledger
