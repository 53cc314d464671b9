#include "server/match/export_lines.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "server/match/record_lines.hpp"

namespace poolhall::match {
namespace {

using storage::Expected;
using Line = std::function<void(const std::string&)>;

tl::unexpected<storage::StorageError> not_there(const std::string& what) {
  return tl::unexpected(
      storage::StorageError{storage::StorageFault::conflict, "there is no " + what});
}

// Collects first what the wanted matches refer to, then writes.
class Export {
 public:
  Export(storage::Reader& reader, const Line& line) : reader_(reader), line_(line) {}

  Expected<void> run(const ExportPart& part) {
    if (auto chosen = choose(part); !chosen)
      return chosen;
    if (auto read = read_tournaments(part); !read)
      return read;
    line_(header_line());
    if (auto written = write_agents(); !written)
      return written;
    for (const TournamentWithEntries& tournament : tournaments_)
      line_(line_of(tournament));
    for (const storage::MatchRecord& match : matches_) {
      Expected<void> done;
      const auto read = reader_.consistently([&] { done = write_match(match.id); });
      if (!read || !done)
        return read ? done : read;
    }
    return {};
  }

 private:
  Expected<void> choose(const ExportPart& part) {
    is_all_ = !part.tournament && !part.match && !part.game;
    if (part.tournament)
      return choose_all(reader_.matches_of(*part.tournament));
    if (part.match)
      return choose_match(*part.match);
    if (part.game)
      return choose_game(*part.game);
    const auto counters = reader_.counters();
    if (!counters)
      return tl::unexpected(counters.error());
    for (std::int64_t id = 1; id < protocol::number(counters->match); ++id) {
      auto match = reader_.match(protocol::MatchId{id});
      if (!match)
        return tl::unexpected(match.error());
      if (*match)
        matches_.push_back(std::move(**match));
    }
    return {};
  }

  Expected<void> choose_all(Expected<std::vector<storage::MatchRecord>> matches) {
    if (!matches)
      return tl::unexpected(matches.error());
    matches_ = std::move(*matches);
    return {};
  }

  Expected<void> choose_match(protocol::MatchId id) {
    auto match = reader_.match(id);
    if (!match)
      return tl::unexpected(match.error());
    if (!*match)
      return not_there("match " + std::to_string(protocol::number(id)));
    matches_.push_back(std::move(**match));
    return {};
  }

  Expected<void> choose_game(protocol::GameId id) {
    const auto game = reader_.game(id);
    if (!game)
      return tl::unexpected(game.error());
    if (!*game)
      return not_there("game " + std::to_string(protocol::number(id)));
    only_games_.insert(id);
    if ((*game)->shared_from)
      only_games_.insert(*(*game)->shared_from);
    return choose_match((*game)->match);
  }

  [[nodiscard]] bool is_wanted(const storage::TournamentRecord& tournament,
                               const ExportPart& part) const {
    const auto is_of_it = [&](const storage::MatchRecord& match) {
      return match.tournament == tournament.id;
    };
    return is_all_ || part.tournament == tournament.id ||
           std::any_of(matches_.begin(), matches_.end(), is_of_it);
  }

  Expected<void> read_tournaments(const ExportPart& part) {
    auto tournaments = reader_.tournaments();
    if (!tournaments)
      return tl::unexpected(tournaments.error());
    for (storage::TournamentRecord& tournament : *tournaments) {
      if (!is_wanted(tournament, part))
        continue;
      auto entries = reader_.entries(tournament.id);
      if (!entries)
        return tl::unexpected(entries.error());
      for (const storage::EntryRecord& entry : *entries)
        agents_.insert(entry.agent);
      tournaments_.push_back({std::move(tournament), std::move(*entries)});
    }
    if (part.tournament && tournaments_.empty())
      return not_there("tournament " + *part.tournament);
    return {};
  }

  Expected<void> write_agents() {
    for (const storage::MatchRecord& match : matches_)
      agents_.insert(match.agents.begin(), match.agents.end());
    const auto agents = reader_.agents();
    if (!agents)
      return tl::unexpected(agents.error());
    for (const storage::AgentRecord& agent : *agents) {
      if (is_all_ || agents_.contains(agent.id))
        line_(line_of(agent));
    }
    return {};
  }

  // Read again: in one snapshot with its games.
  Expected<void> write_match(protocol::MatchId id) {
    const auto match = reader_.match(id);
    const auto games = reader_.games_of(id);
    if (!match || !games)
      return tl::unexpected(match ? games.error() : match.error());
    const auto told = secrets_of(reader_, **match);
    if (!told)
      return tl::unexpected(told.error());
    const Secrets secrets = *told;
    line_(line_of(**match, secrets));
    for (const storage::GameRecord& game : *games) {
      if (!only_games_.empty() && !only_games_.contains(game.id))
        continue;
      line_(line_of(game, secrets));
      const auto done = reader_.each_turn(game.id, [&](const storage::TurnRecord& turn) {
        line_(line_of(turn));
        return true;
      });
      if (!done)
        return done;
    }
    return {};
  }

  storage::Reader& reader_;
  const Line& line_;
  bool is_all_ = true;
  std::vector<storage::MatchRecord> matches_;
  std::vector<TournamentWithEntries> tournaments_;
  std::set<storage::AgentId> agents_;
  std::set<protocol::GameId> only_games_;  // empty: all
};

}  // namespace

Expected<void> export_lines(storage::Reader& reader, const ExportPart& part, const Line& line) {
  return Export(reader, line).run(part);
}

}  // namespace poolhall::match
