#include "server/match/verify.hpp"

#include "server/match/chain.hpp"
#include "server/match/game_check.hpp"

namespace poolhall::match {
namespace {

// A value that could not be read: its column stands before the colon.
Difference unreadable(protocol::GameId game, std::optional<std::uint32_t> turn,
                      const storage::StorageError& error) {
  const std::size_t colon = error.reason.find(':');
  if (error.fault != storage::StorageFault::unreadable || colon == std::string::npos)
    return {game, turn, "row", error.reason};
  return {game, turn, error.reason.substr(0, colon), error.reason.substr(colon + 2)};
}

std::optional<Difference> check_turns(storage::Reader& reader, GameCheck& check,
                                      protocol::GameId id) {
  std::optional<Difference> found;
  const auto read = reader.each_turn(id, [&](const storage::TurnRecord& row) {
    found = check.turn(row);
    return !found;
  });
  if (!found && !read)
    found = unreadable(id, check.turns() + 1, read.error());
  return found;
}

Difference no_such_game(protocol::GameId id) {
  return {id, std::nullopt, "id", "there is no such game"};
}

std::optional<Difference> check_match(const storage::MatchRecord& match, protocol::GameId game) {
  if (!match.seal || *match.seal == seal(match))
    return std::nullopt;
  return Difference{game, std::nullopt, "seal",
                    "stored " + to_hex(*match.seal) + ", expected " + to_hex(seal(match)),
                    match.id};
}

// The match's row, and the game that shares its deviates.
tl::expected<GameCheck::Around, Difference> read_around(storage::Reader& reader,
                                                        const storage::GameRecord& game) {
  GameCheck::Around around;
  auto match = reader.match(game.match);
  if (!match) {
    Difference difference = unreadable(game.id, std::nullopt, match.error());
    difference.match = game.match;
    return tl::unexpected(difference);
  }
  if (!*match)
    return tl::unexpected(Difference{game.id, std::nullopt, "match", "there is no such match"});
  around.match = std::move(*match);
  if (auto found = check_match(*around.match, game.id))
    return tl::unexpected(*found);
  if (!game.shared_from)
    return around;
  auto first = reader.game(*game.shared_from);
  if (!first)
    return tl::unexpected(unreadable(*game.shared_from, std::nullopt, first.error()));
  around.shared_from = std::move(*first);
  return around;
}

std::optional<Difference> check_game(storage::Reader& reader, const storage::GameRecord& game,
                                     VerifyReport& report) {
  const auto around = read_around(reader, game);
  if (!around)
    return around.error();
  GameCheck check(game, *around);
  std::optional<Difference> found = check.beginning();
  if (!found)
    found = check_turns(reader, check, game.id);
  if (!found)
    found = check.end();
  report.turns += check.turns();
  report.shots += check.shots_played_again();
  report.other_version += check.other_version();
  return found;
}

void verify_in_snapshot(storage::Reader& reader, protocol::GameId id, VerifyReport& report) {
  const auto game = reader.game(id);
  if (!game || !*game) {
    report.differences.push_back(game ? no_such_game(id)
                                      : unreadable(id, std::nullopt, game.error()));
    return;
  }
  report.unfinished += (*game)->over ? 0 : 1;
  if (auto found = check_game(reader, **game, report))
    report.differences.push_back(std::move(*found));
}

}  // namespace

void verify_game(storage::Reader& reader, protocol::GameId id, VerifyReport& report) {
  ++report.games;
  // A game may go on while it is verified: its row and its turns must be of one moment.
  const auto read = reader.consistently([&] { verify_in_snapshot(reader, id, report); });
  if (!read)
    report.differences.push_back({id, std::nullopt, "row", read.error().reason});
}

storage::Expected<VerifyReport> verify(storage::Reader& reader, const VerifyOptions& options) {
  VerifyReport report;
  const auto findings = reader.check_structure();
  if (!findings)
    return tl::unexpected(findings.error());
  report.structure = *findings;
  std::vector<protocol::GameId> games;
  if (options.only) {
    games.push_back(*options.only);
  } else {
    const auto ids = reader.game_ids();
    if (!ids)
      return tl::unexpected(ids.error());
    games = *ids;
  }
  for (const protocol::GameId id : games) {
    verify_game(reader, id, report);
    if (options.progress)
      options.progress(report);
  }
  return report;
}

}  // namespace poolhall::match
