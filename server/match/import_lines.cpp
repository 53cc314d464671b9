#include "server/match/import_lines.hpp"

#include <algorithm>
#include <utility>

#include "server/match/chain.hpp"
#include "server/match/fair_noise.hpp"
#include "server/match/record_lines.hpp"
#include "server/match/sha256.hpp"

namespace poolhall::match {
namespace {

using Done = tl::expected<void, ImportError>;

tl::unexpected<ImportError> refused(std::string field, std::string reason) {
  return tl::unexpected(ImportError{0, std::move(field), std::move(reason)});
}

Done from(const storage::Expected<void>& stored) {
  if (stored)
    return {};
  return refused("", stored.error().reason);
}

// One file on its way in. Its lines come in the order in which export_lines writes them.
class Import {
 public:
  explicit Import(storage::Database& database) : database_(database) {}

  Done take(const LineRecord& record) {
    const bool is_header = std::holds_alternative<ExportHeader>(record);
    if (is_header == begun_)
      return begun_ ? refused("/export", "a second beginning")
                    : refused("", "expected the line {\"export\":{\"format\":2}} first");
    begun_ = true;
    return std::visit([this](const auto& one) { return add(one); }, record);
  }

  // After the last line.
  Done finish() { return end_game(); }

  [[nodiscard]] const ImportReport& report() const { return report_; }

 private:
  Done add(const ExportHeader&) { return {}; }

  Done add(const storage::AgentRecord& agent) {
    const auto known = database_.agent(agent.id);
    if (!known)
      return refused("", known.error().reason);
    storage::AgentRecord added = agent;
    if (*known) {
      added.token_hash = (*known)->token_hash;
      return added == **known
                 ? Done{}
                 : refused("/agent/id", "agent " + std::to_string(number(agent.id)) +
                                            " is another one in this database: " + (*known)->name);
    }
    added.token_hash = sha256(draw_key());  // of no token: somebody must give it a new one
    ++report_.agents;
    return from(database_.add_agent(added));
  }

  Done add(const TournamentWithEntries& what) {
    const auto tournaments = database_.tournaments();
    const auto entries = database_.entries(what.tournament.id);
    if (!tournaments || !entries)
      return refused("", tournaments ? entries.error().reason : tournaments.error().reason);
    const auto known = std::find_if(tournaments->begin(), tournaments->end(),
                                    [&](const auto& one) { return one.id == what.tournament.id; });
    if (known != tournaments->end()) {
      const bool is_same = TournamentWithEntries{*known, *entries} == what;
      return is_same ? Done{} : refused("/tournament/id", "this database has another of this name");
    }
    ++report_.tournaments;
    auto added = from(database_.add_tournament(what.tournament));
    for (const storage::EntryRecord& entry : what.entries) {
      if (added)
        added = from(database_.add_entry(entry));
    }
    return added;
  }

  Done add(const storage::MatchRecord& match) {
    if (auto ended = end_game(); !ended)
      return ended;
    if (match.seal && *match.seal != seal(match))
      return refused("/match/seal", "is not the checksum of this line");
    ++report_.matches;
    return from(database_.add_match(match));
  }

  Done add(const storage::GameRecord& game) {
    if (auto ended = end_game(); !ended)
      return ended;
    if (game.seal != seal(game))
      return refused("/game/seal", "is not the checksum of this line");
    game_ = game;
    head_ = first_link(game);
    turns_ = 0;
    ++report_.games;
    return from(database_.add_game(game));
  }

  Done add(const storage::TurnRecord& turn) {
    if (!game_ || turn.game != game_->id)
      return refused("/turn/game", "is not the game before it");
    if (turn.number != ++turns_)
      return refused("/turn/turn",
                     "got " + std::to_string(turn.number) + ", expected " + std::to_string(turns_));
    if (turn.checksum != chained(head_, turn))
      return refused("/turn/checksum", "is not that of this line and the turn before it");
    head_ = turn.checksum;
    ++report_.turns;
    return from(database_.append_turn(turn));
  }

  Done end_game() {
    if (!game_ || (game_->turns == turns_ && game_->head == head_))
      return {};
    return refused("", "game " + std::to_string(number(game_->id)) + " has " +
                           std::to_string(game_->turns) + " turns, " + std::to_string(turns_) +
                           " came before this line");
  }

  storage::Database& database_;
  ImportReport report_;
  bool begun_ = false;
  std::optional<storage::GameRecord> game_{};  // whose turns come
  Digest head_{};
  std::uint32_t turns_ = 0;
};

tl::expected<ImportReport, ImportError> read_all(storage::Database& database, std::istream& lines) {
  Import import(database);
  std::uint64_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto record = read_line(line);
    if (!record)
      return tl::unexpected(ImportError{number, record.error().field, record.error().reason});
    if (auto taken = import.take(*record); !taken)
      return tl::unexpected(ImportError{number, taken.error().field, taken.error().reason});
    if (lines.eof())
      return tl::unexpected(ImportError{number, "", "the line is not ended: the file is cut off"});
  }
  if (number == 0)
    return tl::unexpected(ImportError{0, "", "there is no line"});
  if (auto finished = import.finish(); !finished)
    return tl::unexpected(ImportError{number, "", finished.error().reason});
  return import.report();
}

}  // namespace

tl::expected<ImportReport, ImportError> import_lines(storage::Database& database,
                                                     std::istream& lines) {
  if (auto begun = database.begin(); !begun)
    return tl::unexpected(ImportError{0, "", begun.error().reason});
  auto report = read_all(database, lines);
  if (!report) {
    database.rollback();
    return report;
  }
  if (auto committed = database.commit(); !committed) {
    database.rollback();
    return tl::unexpected(ImportError{0, "", committed.error().reason});
  }
  return report;
}

}  // namespace poolhall::match
