// One game's logic above the referee: whose turn, which number, what was asked before, refusals,
// clocks, the end. No sockets, no database, no clock reads: instants come as arguments, rows go out
// in the answers.
//
//   Game game = Game::open(record, {}).value();
//   game.begin_turn(now);
//   Answer answer = game.shot(Seat::first, request, {.at = arrived, .lag = lag});
//   if (auto* play_it = std::get_if<Play>(&answer)) {
//     PlayOutcome outcome = play(play_it->job);         // on a worker thread
//     Answer settled = game.settle(std::move(outcome), now);
//     ... Store: write the rows; when they are durable: game.stored(), then tell everyone
//   }
//
// From Play until settle() and from Store until stored() the game takes nothing else: what comes
// meanwhile gets Later.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <tl/expected.hpp>

#include "protocol/errors.hpp"
#include "protocol/messages.hpp"
#include "server/match/clock.hpp"
#include "server/match/game_rows.hpp"
#include "server/match/play_shot.hpp"
#include "server/storage/database.hpp"

namespace poolhall::match {

// When a request's complete line was read, and the lag of its connection.
struct Arrival {
  Instant at{};
  Micros lag{0};
  storage::UnixMicros date{};
  // When the answer is given: from then on a clock runs again. Unset: `at`.
  std::optional<Instant> now{};

  [[nodiscard]] Instant answered() const { return now.value_or(at); }
};

// Answers to a request.

// Run play() on the job, then settle() with its outcome. The clock stands.
struct Play {
  ShotJob job;
};
// Write the row (and the game's, when the turn ended it) in one transaction; when it is durable,
// stored(). The requester then gets the error, or what the row says.
struct Store {
  storage::TurnRecord turn;
  std::optional<storage::GameRecord> game{};
  std::optional<protocol::Error> error{};
};
// The error at once. The game has not changed, but for the count of refusals; the clock runs.
struct Refuse {
  protocol::Error error;
};
// The turn is over: the row with this number decides (repeated_shot, repeated_decision).
struct Past {
  std::uint32_t turn = 0;
};
// The same request is being played or stored: answer this one with the other's result.
struct Join {};
// Something is being played or stored: ask again when that is done.
struct Later {};
// It is so already: answer as for the first time.
struct Done {};

using Answer = std::variant<Play, Store, Refuse, Past, Join, Later, Done>;

enum class Phase : std::uint8_t {
  due,       // begin_turn is awaited, no clock runs
  thinking,  // the player's clock runs
  playing,   // between Play and settle()
  storing,   // between Store and stored()
  over,
};

class Game {
 public:
  // A new game's record and {}, or what the database gave of one that was going on.
  [[nodiscard]] static tl::expected<Game, std::string> open(
      const storage::UnfinishedGame& unfinished);

  [[nodiscard]] const storage::GameRecord& record() const { return record_; }
  [[nodiscard]] const Board& board() const { return *board_; }
  [[nodiscard]] const rules::GameState& state() const { return state_; }
  [[nodiscard]] const std::string& state_json() const { return state_json_; }
  [[nodiscard]] const GameClock& clock() const { return clock_; }
  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] std::uint32_t refusals() const { return refusals_; }
  // Stored ones, by seat.
  [[nodiscard]] const std::array<std::uint32_t, 2>& shots() const { return shots_; }
  // The last durable row.
  [[nodiscard]] const std::optional<storage::TurnRecord>& last_turn() const { return last_turn_; }

  // An agent reveals what it had committed to. The row to be stored before the answer; nothing if
  // it is stored already; or why it contributes nothing.
  [[nodiscard]] protocol::Expected<std::optional<storage::GameRecord>> reveal(
      Seat by, const storage::Digest& secret);
  // It could not be stored: as if it had not been revealed.
  void not_revealed(Seat by);
  // Whether an agent may still reveal what it has committed to.
  [[nodiscard]] bool awaits_reveal() const;

  // Starts the clock of a due turn; of any other nothing changes.
  void begin_turn(Instant now);

  // The server cannot go on for the moment: no clock runs. A request that comes meanwhile is
  // answered as if no time had passed.
  void pause(Instant now);
  void unpause(Instant now);

  [[nodiscard]] Answer shot(Seat by, const protocol::Shot& shot, const Arrival& arrival);
  [[nodiscard]] Answer decide(Seat by, const protocol::Decide& decide, const Arrival& arrival);
  [[nodiscard]] Answer concede(Seat by, const Arrival& arrival);

  // The played job's outcome: Store, or Refuse. `now`: when a refusal is handed out.
  [[nodiscard]] Answer settle(PlayOutcome outcome, Instant now);

  // The answered Store is durable.
  void stored();
  // It could not be stored and never will be: as if it had not been asked; the clock goes on.
  void not_stored(Instant now);

  // When the flag falls, if that lag is forgiven; unset while no clock runs.
  [[nodiscard]] std::optional<Instant> expires(Micros lag) const { return clock_.expires(lag); }
  // Store when the flag has fallen by then; Later when nothing is to be done yet.
  [[nodiscard]] Answer expire(const Arrival& now);

  // The server ends it: forfeit of a seat, or void.
  [[nodiscard]] Answer forfeit(Seat loser, const Arrival& now);
  [[nodiscard]] Answer make_void(const Arrival& now);

  // The game's row with the end acknowledged, to be stored; nothing if it was before.
  [[nodiscard]] std::optional<storage::GameRecord> acknowledge(Seat by);

 private:
  Game() = default;

  // What is being played or stored.
  struct InFlight {
    storage::TurnRecord turn;
    std::optional<rules::GameState> next{};  // once it is being stored
    std::optional<protocol::Shot> shot{};
    std::optional<protocol::Decide> decide{};
  };

  // The answer to who may not act in this turn, or not now.
  [[nodiscard]] std::optional<Answer> turned_away(Seat by, std::uint32_t turn) const;
  // The answer to a shot or decision that meets one in flight.
  [[nodiscard]] Answer meets(const protocol::Shot& shot) const;
  [[nodiscard]] Answer meets(const protocol::Decide& decide) const;
  // Stops the running clock; the answer if the time was over.
  [[nodiscard]] std::optional<Answer> stop_clock(const Arrival& arrival);
  [[nodiscard]] protocol::Error error(protocol::ErrorCode code, std::string field,
                                      std::string reason) const;
  [[nodiscard]] storage::TurnRecord row(storage::TurnAction action, storage::UnixMicros date) const;
  [[nodiscard]] storage::ClockPart clock_part(storage::TurnAction action) const;
  [[nodiscard]] Answer refuse(protocol::Error error, Instant now, storage::UnixMicros date);
  [[nodiscard]] Answer lose_turn(rules::FoulCode code, storage::UnixMicros date,
                                 std::optional<protocol::Error> error);
  [[nodiscard]] Answer end(storage::TurnAction action, Seat seat, const rules::GameResult& result,
                           const Arrival& arrival);
  // Completes the row and begins to wait for stored().
  [[nodiscard]] Answer store(storage::TurnRecord turn, rules::GameState next,
                             std::optional<protocol::Error> error);
  // After a change of what is fixed before the first turn.
  void seal_beginning();
  [[nodiscard]] Answer being_stored(InFlight what, std::optional<protocol::Error> error);

  storage::GameRecord record_;
  std::shared_ptr<const Board> board_;
  rules::GameState state_;
  std::string state_json_;
  GameClock clock_{ClockSettings{}};
  Phase phase_ = Phase::due;
  std::uint32_t refusals_ = 0;
  std::array<std::uint32_t, 2> shots_{};
  storage::Digest head_{};
  std::optional<storage::TurnRecord> last_turn_{};
  std::optional<InFlight> in_flight_{};
};

}  // namespace poolhall::match
