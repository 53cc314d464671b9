// What the agents of a run were told, and whether the database says the same at the end: nothing
// that was told is lost, nothing is played twice, no game is stuck, every clock and every end is
// right.
//
//   ledger.told_move(line, reader);              // a reply to a shot, a game.shot, ...
//   LedgerFindings findings = ledger.compare(database, agents);
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/ids.hpp"
#include "rules/seat.hpp"
#include "server/storage/records.hpp"

namespace poolhall::fault {

struct LedgerFindings {
  std::uint64_t games = 0;
  std::uint64_t turns = 0;
  std::uint64_t shots = 0;
  std::uint64_t told = 0;          // moves that an agent was told of
  std::uint64_t lost = 0;          // told, and not in the database or not the same there
  std::uint64_t played_twice = 0;  // shots: an id or an index of a seat that comes again
  std::uint64_t gaps = 0;          // turn numbers that do not follow one another
  std::uint64_t stuck = 0;         // games without an end
  std::uint64_t wrong_clocks = 0;
  std::uint64_t untold_ends = 0;      // an agent never heard of its game's end
  std::uint64_t wrong_ends = 0;       // or heard of another checksum
  std::vector<std::string> examples;  // the first few, one line each

  [[nodiscard]] bool sound() const {
    return lost + played_twice + gaps + stuck + wrong_clocks + untold_ends + wrong_ends == 0;
  }
};

class Ledger {
 public:
  // A line that tells a move: the answer to a shot or decision, or what was pushed. `reader` is the
  // seat of the agent that it came to.
  void told_move(std::string_view line, rules::Seat reader);
  void told_over(std::string_view agent, std::string_view line);
  // A game.state after a login: the clocks stand where the last durable turn left them, but for
  // the mover's, which may have run for `since_start`.
  void told_state(std::string_view line, rules::Seat reader, storage::Micros since_start);

  [[nodiscard]] std::uint64_t moves() const { return moves_; }
  [[nodiscard]] bool knows_end(std::string_view agent, std::int64_t game) const;

  // Throws std::runtime_error when the database cannot be read.
  [[nodiscard]] LedgerFindings compare(const std::filesystem::path& database) const;

 private:
  struct Move {
    std::uint32_t turn = 0;
    rules::Seat reader = rules::Seat::first;
    std::uint64_t digest = 0;
  };
  struct Clocks {
    std::uint32_t turn = 0;
    rules::Seat reader = rules::Seat::first;
    std::int64_t own_ms = 0;
    std::int64_t opponent_ms = 0;
    storage::Micros since_start{0};
  };
  struct Game {
    std::vector<Move> moves;
    std::vector<Clocks> clocks;
    std::map<std::string, std::string, std::less<>> ends;  // checksum, by agent
  };

  void compare_game(const storage::GameRecord& game, const std::vector<storage::TurnRecord>& rows,
                    const std::array<std::string, 2>& names, LedgerFindings& findings) const;
  static void compare_moves(const Game& told, const storage::GameRecord& game,
                            const std::vector<storage::TurnRecord>& rows, LedgerFindings& findings);
  static void check_rows(const storage::GameRecord& game,
                         const std::vector<storage::TurnRecord>& rows, LedgerFindings& findings);
  static void check_clocks(const Game& told, const storage::GameRecord& game,
                           const std::vector<storage::TurnRecord>& rows, LedgerFindings& findings);

  std::map<std::int64_t, Game> games_;
  std::uint64_t moves_ = 0;
};

}  // namespace poolhall::fault
