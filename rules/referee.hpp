// The referee: pure functions of state, call and event log. No clock, no I/O, no random numbers
// but the game's own rack seed.
//
//   Expected<GameState> ready = prepare_shot(state, call, cue_ball, table, materials);
//   Expected<Ruling> ruling = judge(*ready, call, simulation.events, table, materials);
//   GameState next = ruling->next;
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "rules/game_state.hpp"

namespace poolhall::rules {

struct Call {
  enum class Kind : std::uint8_t { none, pocket, safety, push_out };
  Kind kind = Kind::none;
  BallId ball{};      // when pocket
  PocketId pocket{};  // when pocket

  friend bool operator==(const Call&, const Call&) = default;
};
[[nodiscard]] std::string_view name(Call::Kind kind);
[[nodiscard]] std::optional<Call::Kind> call_kind(std::string_view name);

// Why something cannot be played, called, placed, decided or read. Stable names on the wire.
enum class RefusalCode : std::uint8_t {
  bad_shot,
  bad_call,
  bad_cue_ball_position,
  bad_decision,
  bad_state,      // an impossible state was given
  bad_event_log,  // the event log does not fit the state
};
[[nodiscard]] std::string_view name(RefusalCode code);

struct Refusal {
  RefusalCode code;
  std::string field;   // JSON Pointer into what was given
  std::string reason;  // one line: what came and what was expected
};
template <class T>
using Expected = tl::expected<T, Refusal>;

enum class FoulCode : std::uint8_t {
  scratch,
  wrong_ball_first,
  no_ball_hit,
  no_rail_after_contact,
  ball_off_table,
  shot_time_exceeded,
  too_many_refusals,
  illegal_break,  // fewer than four balls to a rail and none pocketed
  kitchen,        // from the kitchen, first ball hit inside it
};
[[nodiscard]] std::string_view name(FoulCode code);
[[nodiscard]] std::optional<FoulCode> foul_code(std::string_view name);

struct FoulRecord {
  FoulCode code{};
  std::string rule;                    // clause of rules/README.md, such as "8.6"
  std::string text;                    // in words, for a person
  std::optional<std::size_t> event{};  // index into the event log

  friend bool operator==(const FoulRecord&, const FoulRecord&) = default;
};

struct PocketedBall {
  BallId ball{};
  PocketId pocket{};
  std::size_t event = 0;

  friend bool operator==(const PocketedBall&, const PocketedBall&) = default;
};

// A clause that decided something other than a foul, such as who goes on or how the game ended.
struct Finding {
  std::string rule;                    // clause of rules/README.md
  std::string text;                    // in words, for a person
  std::optional<std::size_t> event{};  // index into the event log

  friend bool operator==(const Finding&, const Finding&) = default;
};

struct Ruling {
  bool legal = true;
  std::vector<FoulRecord> fouls;       // all of them, in the order of the clauses
  std::vector<PocketedBall> pocketed;  // in the order of the log
  std::vector<BallId> driven_off;      // off the table
  std::optional<BallId> first_contact{};
  std::vector<Finding> notes;  // the other clauses that decided, in their order
  GameState next;              // the complete next state, or the end

  friend bool operator==(const Ruling&, const Ruling&) = default;
};

// Whether `state` is possible on this table: no two balls in one place, none outside the rails, one
// cue ball, memory that fits the pocketed balls.
[[nodiscard]] Expected<void> check_state(const GameState& state, const physics::Table& table,
                                         const physics::Materials& materials);

// Whether a game can be played with these settings on this table: numbers in range, a rack that
// fits. `new_game` wants them so. Fields are relative to the settings, or "/table".
[[nodiscard]] Expected<void> check_settings(const GameSettings& settings,
                                            const physics::Table& table,
                                            const physics::Materials& materials);

// The state of a game before its first turn: the balls racked, the cue ball in hand and meanwhile
// in the middle of the kitchen.
[[nodiscard]] GameState new_game(const GameSettings& settings, const physics::Table& table,
                                 const physics::Materials& materials);

// Ids of the balls that may be called in this state.
[[nodiscard]] std::vector<BallId> callable_balls(const GameState& state);

// Ids of the balls that the cue ball may strike first in this state.
[[nodiscard]] std::vector<BallId> legal_first_balls(const GameState& state);

// What may be called in this state: pocket and safety in 8-ball, none in nine-ball (and push_out
// on the shot after the break), none on a break and for a decision.
[[nodiscard]] std::vector<Call::Kind> legal_calls(const GameState& state);

// The state with the cue ball placed, ready for the simulator, or why the shot cannot be played
// so. Whether the stroke itself is possible is physics::check_shot's answer.
[[nodiscard]] Expected<GameState> prepare_shot(const GameState& state, const Call& call,
                                               const std::optional<physics::Vec2<double>>& cue_ball,
                                               const physics::Table& table,
                                               const physics::Materials& materials);

// Judges a shot from its event log. `ready` is what prepare_shot gave. Refuses a log that does not
// fit the state.
[[nodiscard]] Expected<Ruling> judge(const GameState& ready, const Call& call,
                                     const physics::EventLog<double>& events,
                                     const physics::Table& table,
                                     const physics::Materials& materials);

// A turn lost without a shot: the third refusal, or the cap on a shot's time.
[[nodiscard]] Ruling judge_lost_turn(const GameState& state, FoulCode code,
                                     const physics::Table& table,
                                     const physics::Materials& materials);

[[nodiscard]] Expected<GameState> decide(const GameState& state, Decision decision,
                                         const physics::Table& table,
                                         const physics::Materials& materials);

// The game ended otherwise: conceded, timeout, forfeit, void.
[[nodiscard]] GameState ended(const GameState& state, const GameResult& result);

// Balls of a state as the simulator wants them: those on the table, at rest.
[[nodiscard]] physics::BallSet<double> balls_on_table(const GameState& state);

}  // namespace poolhall::rules
