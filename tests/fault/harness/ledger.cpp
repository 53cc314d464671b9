#include "tests/fault/harness/ledger.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "clients/load/seen_line.hpp"
#include "protocol/codec.hpp"
#include "server/match/chain.hpp"
#include "server/match/clock.hpp"
#include "server/match/game_rows.hpp"
#include "server/net/notices.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::fault {

using rules::Seat;
using storage::Micros;
using storage::TurnRecord;

namespace {

constexpr std::size_t most_examples = 10;

std::uint64_t digest_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return hash;
}

// From whose move it was to the end of the clocks: what every telling of a move says alike.
std::string_view essence(std::string_view line) {
  const std::size_t from = line.find(R"("by":)");
  const std::size_t clock = line.rfind(R"("clock":)");
  if (from == std::string_view::npos || clock == std::string_view::npos) {
    return {};
  }
  return line.substr(from, line.find('}', clock) + 1 - from);
}

// The line that tells this row to that seat; empty for what is told by game.over alone.
std::string line_of(const TurnRecord& row, Seat reader) {
  const net::Side side{reader, protocol::EventDetail::full};
  switch (row.action) {
    case storage::TurnAction::shot:
      return protocol::encode_notification(net::shot_of(row, side), 0);
    case storage::TurnAction::decision:
      return protocol::encode_notification(net::decision_of(row, side), 0);
    case storage::TurnAction::lost_turn:
      return protocol::encode_notification(net::lost_turn_of(row, side), 0);
    default:
      return {};
  }
}

void example(LedgerFindings& findings, std::int64_t game, std::uint32_t turn,
             std::string_view what) {
  if (findings.examples.size() < most_examples) {
    findings.examples.push_back("game " + std::to_string(game) + ", turn " + std::to_string(turn) +
                                ": " + std::string(what));
  }
}

match::GameClock::Balance beginning(const match::ClockSettings& settings) {
  return match::GameClock(settings).balance();
}

std::int64_t whole_ms(Micros time) {
  return std::chrono::floor<std::chrono::milliseconds>(time).count();
}

template <class T>
T must(storage::Expected<T> read) {
  if (!read) {
    throw std::runtime_error(read.error().reason);
  }
  return std::move(*read);
}

}  // namespace

void Ledger::told_move(std::string_view line, Seat reader) {
  const std::string_view told = essence(line);
  const auto game = load::integer_in(line, "game");
  const auto turn = load::integer_in(line, "turn");
  if (told.empty() || !game || !turn) {
    throw std::runtime_error("a move that cannot be read: " + std::string(line.substr(0, 200)));
  }
  games_[*game].moves.push_back({static_cast<std::uint32_t>(*turn), reader, digest_of(told)});
  ++moves_;
}

void Ledger::told_over(std::string_view agent, std::string_view line) {
  games_[load::integer_in(line, "game").value_or(0)].ends.insert_or_assign(
      std::string(agent), std::string(load::word_in(line, "checksum")));
}

void Ledger::told_state(std::string_view line, Seat reader, Micros since_start) {
  Clocks clocks;
  clocks.turn = static_cast<std::uint32_t>(
      load::integer_in(line.substr(line.find(R"("state":)")), "turn").value_or(0));
  clocks.reader = reader;
  const std::string_view tail = line.substr(line.rfind(R"("clocks":)"));
  clocks.own_ms = load::integer_in(tail, "own_ms").value_or(-1);
  clocks.opponent_ms = load::integer_in(tail, "opponent_ms").value_or(-1);
  clocks.since_start = since_start;
  games_[load::integer_in(line, "game").value_or(0)].clocks.push_back(clocks);
}

bool Ledger::knows_end(std::string_view agent, std::int64_t game) const {
  const auto found = games_.find(game);
  return found != games_.end() && found->second.ends.contains(agent);
}

LedgerFindings Ledger::compare(const std::filesystem::path& database) const {
  const auto reader = must(storage::open_sqlite_reader(database));
  LedgerFindings findings;
  std::set<std::int64_t> stored;
  for (const protocol::GameId id : must(reader->game_ids())) {
    const storage::GameRecord game = must(reader->game(id)).value();
    std::vector<TurnRecord> rows;
    must(reader
             ->each_turn(id,
                         [&rows](const TurnRecord& row) {
                           rows.push_back(row);
                           return true;
                         })
             .map([] { return true; }));
    const std::array<std::string, 2> names{must(reader->agent(game.agents[0])).value().name,
                                           must(reader->agent(game.agents[1])).value().name};
    stored.insert(number(id));
    compare_game(game, rows, names, findings);
  }
  for (const auto& [id, told] : games_) {
    if (!stored.contains(id)) {
      findings.told += told.moves.size();
      findings.lost += std::max<std::size_t>(told.moves.size(), 1);
      example(findings, id, 0, "the whole game is not in the database");
    }
  }
  return findings;
}

void Ledger::compare_game(const storage::GameRecord& game, const std::vector<TurnRecord>& rows,
                          const std::array<std::string, 2>& names, LedgerFindings& findings) const {
  ++findings.games;
  findings.turns += rows.size();
  check_rows(game, rows, findings);
  const auto found = games_.find(number(game.id));
  const Game told = found == games_.end() ? Game{} : found->second;
  compare_moves(told, game, rows, findings);
  check_clocks(told, game, rows, findings);
  if (!game.over) {
    ++findings.stuck;
    example(findings, number(game.id), 0, "the game has no end");
    return;
  }
  for (const std::string& name : names) {
    const auto end = told.ends.find(name);
    if (end == told.ends.end()) {
      ++findings.untold_ends;
      example(findings, number(game.id), 0, name + " never heard of the end");
    } else if (end->second != match::to_hex(game.head)) {
      ++findings.wrong_ends;
      example(findings, number(game.id), 0, name + " was told another checksum");
    }
  }
}

void Ledger::check_rows(const storage::GameRecord& game, const std::vector<TurnRecord>& rows,
                        LedgerFindings& findings) {
  std::array<std::uint32_t, 2> shots{};
  std::set<std::pair<std::uint32_t, std::string>> ids;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TurnRecord& row = rows[i];
    if (row.number != i + 1) {
      ++findings.gaps;
      example(findings, number(game.id), row.number, "does not follow the turn before");
    }
    if (!row.shot) {
      continue;
    }
    ++findings.shots;
    const bool new_id = !row.request || ids.emplace(row.number, row.request->json).second;
    if (!new_id || row.shot->index != ++shots[rules::index(row.seat)]) {
      ++findings.played_twice;
      example(findings, number(game.id), row.number, "a shot was played twice");
    }
  }
}

void Ledger::compare_moves(const Game& told, const storage::GameRecord& game,
                           const std::vector<TurnRecord>& rows, LedgerFindings& findings) {
  std::map<std::pair<std::uint32_t, Seat>, std::uint64_t> stored;
  for (const Move& move : told.moves) {
    ++findings.told;
    if (move.turn == 0 || move.turn > rows.size()) {
      ++findings.lost;
      example(findings, number(game.id), move.turn, "was told and is not stored");
      continue;
    }
    const auto key = std::pair(move.turn, move.reader);
    auto found = stored.find(key);
    if (found == stored.end()) {
      const std::string line = line_of(rows[move.turn - 1], move.reader);
      found = stored.emplace(key, digest_of(essence(line))).first;
    }
    if (found->second != move.digest) {
      ++findings.lost;
      example(findings, number(game.id), move.turn, "was told otherwise than it is stored");
    }
  }
}

void Ledger::check_clocks(const Game& told, const storage::GameRecord& game,
                          const std::vector<TurnRecord>& rows, LedgerFindings& findings) {
  const match::ClockSettings settings = match::clock_settings(game.terms);
  std::vector<match::GameClock::Balance> after{beginning(settings)};
  for (const TurnRecord& row : rows) {
    const match::TurnTime time{row.clock.used, row.clock.forgiven};
    const bool played = match::is_played(row.action);
    const bool own_time =
        played || row.action == storage::TurnAction::timeout || row.clock.used > Micros{0};
    auto due = after.back();
    if (own_time) {
      // A game that is conceded or forfeited charges whose turn it was, whoever ended it.
      const auto before = protocol::decode_state(row.state_before);
      const Seat charged = played || !before ? row.seat : before->to_move;
      due = played ? match::after_turn(settings, due, charged, time)
                   : match::after_charge(settings, due, charged, time);
    }
    if (row.clock.left != due.left || row.clock.lag_left != due.lag_left) {
      ++findings.wrong_clocks;
      example(findings, number(game.id), row.number, "the clocks do not follow from the turn");
    }
    after.push_back({row.clock.left, row.clock.lag_left});
  }
  for (const Clocks& clocks : told.clocks) {
    if (clocks.turn == 0 || clocks.turn > after.size()) {
      continue;  // of a game that was over
    }
    const auto& left = after[clocks.turn - 1].left;
    const std::int64_t own = whole_ms(left[rules::index(clocks.reader)]);
    const std::int64_t others = whole_ms(left[rules::index(rules::other(clocks.reader))]);
    const std::int64_t slack = whole_ms(clocks.since_start) + 1;
    const auto within = [slack](std::int64_t told_ms, std::int64_t stored_ms) {
      return told_ms <= stored_ms && told_ms >= stored_ms - slack;
    };
    if (!within(clocks.own_ms, own) || !within(clocks.opponent_ms, others) ||
        (clocks.own_ms != own && clocks.opponent_ms != others)) {
      ++findings.wrong_clocks;
      example(findings, number(game.id), clocks.turn,
              "the clocks after a login are not those of the last stored turn");
    }
  }
}

}  // namespace poolhall::fault
