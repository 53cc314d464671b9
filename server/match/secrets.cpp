#include "server/match/secrets.hpp"

#include <algorithm>

namespace poolhall::match {

storage::Expected<Secrets> secrets_of(storage::Reader& reader, const storage::MatchRecord& match) {
  if (!match.over)
    return Secrets::kept;
  if (!match.terms.noise_hidden || !match.tournament)
    return Secrets::told;
  const auto tournaments = reader.tournaments();
  if (!tournaments)
    return tl::unexpected(tournaments.error());
  const bool goes_on =
      std::any_of(tournaments->begin(), tournaments->end(), [&](const auto& tournament) {
        return tournament.id == *match.tournament && !is_over(tournament.status);
      });
  return goes_on ? Secrets::level_kept : Secrets::told;
}

}  // namespace poolhall::match
