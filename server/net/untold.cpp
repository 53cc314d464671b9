#include "server/net/untold.hpp"

#include <algorithm>
#include <utility>

#include "server/net/matches.hpp"
#include "server/net/notices.hpp"
#include "server/net/session.hpp"

namespace poolhall::net {

namespace {

// Keys that one line tells; each takes up to 300 bytes.
constexpr std::size_t seeds_in_a_line = 2'000;

protocol::TournamentOver tournament_over_of(const storage::TournamentRecord& tournament,
                                            const std::vector<storage::FinalStanding>& standings) {
  protocol::TournamentOver over{tournament.wire_id, tournament.id, {}};
  for (const storage::FinalStanding& row : standings) {
    over.standings.push_back(
        {row.rank, row.agent, row.points, row.games, row.wins, row.losses, row.draws});
  }
  return over;
}

}  // namespace

// What the database has for one agent.
struct Untold::Stored {
  struct Match {
    storage::MatchRecord match;
    std::vector<storage::GameRecord> games;
  };
  std::vector<storage::GameRecord> games;
  std::vector<Match> matches;
  std::vector<protocol::TournamentOver> tournaments;
  std::map<std::string, protocol::TournamentId> wire_ids;
};

storage::Expected<Untold::Stored> Untold::stored(storage::Reader& reader, storage::AgentId agent,
                                                 std::size_t most) {
  Stored found;
  auto games = reader.unacknowledged_by(agent, most);
  const auto matches = reader.untold_matches(agent, most);
  const auto tournaments = reader.untold_tournaments(agent, most);
  const auto known = reader.tournaments();
  if (!games || !matches) {
    return tl::unexpected(games ? matches.error() : games.error());
  }
  if (!tournaments || !known) {
    return tl::unexpected(tournaments ? known.error() : tournaments.error());
  }
  found.games = std::move(*games);
  for (const storage::TournamentRecord& tournament : *known) {
    found.wire_ids[tournament.id] = tournament.wire_id;
  }
  for (const storage::MatchRecord& match : *matches) {
    auto played = reader.games_of(match.id);
    if (!played) {
      return tl::unexpected(played.error());
    }
    found.matches.push_back({match, std::move(*played)});
  }
  for (const storage::TournamentRecord& tournament : *tournaments) {
    const auto standings = reader.final_standings(tournament.id);
    if (!standings) {
      return tl::unexpected(standings.error());
    }
    found.tournaments.push_back(tournament_over_of(tournament, *standings));
  }
  return found;
}

void Untold::prepare(storage::AgentId agent, Prepared then) {
  if (ends_[agent].read) {
    then({});
    return;
  }
  archive_.read([agent, most = limits_.untold_ends](
                    storage::Reader& reader) { return stored(reader, agent, most); },
                [this, agent, then = std::move(then)](const storage::Expected<Stored>& found) {
                  if (!found) {
                    then(tl::unexpected(found.error()));
                    return;
                  }
                  take_up(agent, *found);
                  then({});
                });
}

void Untold::take_up(storage::AgentId agent, const Stored& stored) {
  Ends& ends = ends_[agent];
  const auto all = [most = limits_.untold_ends](const auto& found) { return found.size() < most; };
  ends.read = all(stored.games) && all(stored.matches) && all(stored.tournaments);
  for (const storage::GameRecord& game : stored.games) {
    ends.games.emplace(game.id, game);
  }
  for (const Stored::Match& match : stored.matches) {
    std::optional<protocol::TournamentId> tournament;
    if (match.match.tournament) {
      const auto id = stored.wire_ids.find(*match.match.tournament);
      tournament = id == stored.wire_ids.end() ? std::nullopt : std::optional{id->second};
    }
    ends.matches.emplace(match.match.id,
                         match_over_of(match.match, match.games, agent, tournament));
  }
  for (const protocol::TournamentOver& over : stored.tournaments) {
    ends.tournaments.emplace(over.tournament, over);
  }
}

// The oldest go: the next login reads what the database has then.
template <class Map>
void Untold::keep_within_bound(Ends& ends, Map& kept) const {
  while (kept.size() > limits_.untold_ends) {
    kept.erase(kept.begin());
    ends.read = false;
  }
}

void Untold::game_over(const storage::GameRecord& game) {
  storage::GameRecord kept = game;
  kept.initial_state.clear();  // only its end is told again
  for (const storage::AgentId agent : game.agents) {
    Ends& ends = ends_[agent];
    ends.games.emplace(game.id, kept);
    keep_within_bound(ends, ends.games);
  }
}

void Untold::match_over(const storage::MatchRecord& match,
                        const std::vector<storage::GameRecord>& games,
                        std::optional<protocol::TournamentId> tournament) {
  for (const storage::AgentId agent : match.agents) {
    const protocol::MatchOver over = match_over_of(match, games, agent, tournament);
    Ends& ends = ends_[agent];
    ends.matches.emplace(match.id, over);
    keep_within_bound(ends, ends.matches);
    if (const auto session = session_of(agent)) {
      for (const protocol::MatchOver& part : in_parts(over)) {
        session->push(part);
      }
    }
  }
}

void Untold::tournament_over(const std::vector<storage::AgentId>& agents,
                             const protocol::TournamentOver& over) {
  for (const storage::AgentId agent : agents) {
    Ends& ends = ends_[agent];
    ends.tournaments.insert_or_assign(over.tournament, over);
    keep_within_bound(ends, ends.tournaments);
    if (const auto session = session_of(agent)) {
      session->push(over);
    }
  }
}

// Not more than half of the queue: what goes on is told after it and has to fit too.
void Untold::tell(Session& session, storage::AgentId agent) const {
  const auto found = ends_.find(agent);
  if (found == ends_.end()) {
    return;
  }
  const auto push = [&](const auto& over) {
    if (session.connection().queued_bytes() < limits_.output_queue_bytes / 2) {
      session.push(over);
    }
  };
  for (const auto& [id, game] : found->second.games) {
    push(over_of(game));
  }
  for (const auto& [id, match] : found->second.matches) {
    for (const protocol::MatchOver& part : in_parts(match)) {
      push(part);
    }
  }
  for (const auto& [id, tournament] : found->second.tournaments) {
    push(tournament);
  }
}

std::vector<protocol::GameListing> Untold::listings(storage::AgentId agent) const {
  std::vector<protocol::GameListing> listings;
  const auto found = ends_.find(agent);
  if (found == ends_.end()) {
    return listings;
  }
  for (const auto& [id, game] : found->second.games) {
    const Seat seat = game.agents[0] == agent ? Seat::first : Seat::second;
    protocol::GameListing listing;
    listing.game = id;
    listing.match = game.match;
    listing.seat = seat;
    listing.opponent = book_.name_of(game.agents[rules::index(rules::other(seat))]);
    listing.status = protocol::GameStatus::over;
    listings.push_back(std::move(listing));
  }
  return listings;
}

void Untold::acknowledged(storage::AgentId agent, const protocol::Ended& what) {
  const auto found = ends_.find(agent);
  if (found == ends_.end()) {
    return;
  }
  if (const auto* game = std::get_if<protocol::GameId>(&what)) {
    found->second.games.erase(*game);
  } else if (const auto* match = std::get_if<protocol::MatchId>(&what)) {
    found->second.matches.erase(*match);
  } else {
    found->second.tournaments.erase(std::get<protocol::TournamentId>(what));
  }
}

protocol::MatchOver Untold::match_over_of(const storage::MatchRecord& match,
                                          const std::vector<storage::GameRecord>& games,
                                          storage::AgentId reader,
                                          std::optional<protocol::TournamentId> tournament) const {
  const std::size_t own = match.agents[0] == reader ? 0 : 1;
  const std::array<double, 2> points = points_of(match, games);
  protocol::MatchOver over;
  over.match = match.id;
  over.tournament = tournament;
  over.opponent = book_.name_of(match.agents[1 - own]);
  over.own_points = points[own];
  over.opponent_points = points[1 - own];
  for (const storage::GameRecord& game : games) {
    over.seeds.push_back(seeds_of(game));
  }
  return over;
}

std::shared_ptr<Session> Untold::session_of(storage::AgentId agent) {
  const Agent* known = book_.find(agent);
  return known == nullptr ? nullptr : known->session.lock();
}

std::vector<protocol::MatchOver> in_parts(const protocol::MatchOver& over) {
  std::vector<protocol::MatchOver> parts;
  for (std::size_t from = 0; from == 0 || from < over.seeds.size(); from += seeds_in_a_line) {
    const std::size_t to = std::min(over.seeds.size(), from + seeds_in_a_line);
    protocol::MatchOver& part = parts.emplace_back(over);
    part.seeds.assign(over.seeds.begin() + static_cast<std::ptrdiff_t>(from),
                      over.seeds.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return parts;
}

std::array<double, 2> points_of(const storage::MatchRecord& match,
                                const std::vector<storage::GameRecord>& games) {
  std::array<double, 2> points{};
  for (const storage::GameRecord& game : games) {
    const auto outcome = ledger::scored_game(match, game);
    if (!outcome) {
      continue;
    }
    if (outcome->winner) {
      points[*outcome->winner] += 1;
    } else {
      points[0] += 0.5;
      points[1] += 0.5;
    }
  }
  return points;
}

}  // namespace poolhall::net
