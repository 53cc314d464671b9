// What is kept: one plain struct for each table. Times are microseconds, instants microseconds
// since 1970; lengths metres; the parameters of a stroke in the wire's units.
//
//   TurnRecord turn;
//   turn.game = GameId{17};
//   turn.number = 3;
//   turn.action = TurnAction::shot;
//
// Not for what lives only in memory (sessions, queues, refusals of a turn that goes on). JSON
// parts are text, exactly as it was sent.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "physics/vector.hpp"
#include "protocol/ids.hpp"
#include "protocol/units.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::storage {

using protocol::GameId;
using protocol::MatchId;
using protocol::TournamentId;
enum class AgentId : std::int64_t {};
[[nodiscard]] constexpr std::int64_t number(AgentId id) {
  return static_cast<std::int64_t>(id);
}

using Micros = std::chrono::microseconds;
using Digest = std::array<std::uint8_t, 32>;  // SHA-256

// Microseconds since 1970, by the system's clock: for people, never for a game's clock.
enum class UnixMicros : std::int64_t {};
[[nodiscard]] constexpr std::int64_t number(UnixMicros t) {
  return static_cast<std::int64_t>(t);
}
[[nodiscard]] UnixMicros unix_now();

struct AgentRecord {
  AgentId id{};
  std::string name;                        // unique, whatever the case of its letters
  Digest token_hash{};                     // the token itself is nowhere
  std::optional<std::string> house_bot{};  // played by a process that the server starts
  UnixMicros created{};

  friend bool operator==(const AgentRecord&, const AgentRecord&) = default;
};

enum class TournamentStatus : std::uint8_t { open, running, paused, finished, aborted };
[[nodiscard]] std::string_view name(TournamentStatus status);
[[nodiscard]] std::optional<TournamentStatus> tournament_status(std::string_view name);

struct TournamentRecord {
  std::string id;          // 1-32 of [A-Za-z0-9._-], unique
  TournamentId wire_id{};  // by which agents call it, unique
  std::string title;
  std::string settings;  // the driver's own text
  TournamentStatus status = TournamentStatus::open;
  UnixMicros created{};

  friend bool operator==(const TournamentRecord&, const TournamentRecord&) = default;
};

struct EntryRecord {
  std::string tournament;
  AgentId agent{};
  std::uint32_t place = 0;       // in the order of entering, from 0
  std::uint32_t from_round = 0;  // later for those who came late
  // The first round without it, once it has left; 0: before the tournament began.
  std::optional<std::uint32_t> until_round{};
  std::optional<std::string> house_bot{};    // played by a process that the server starts,
  std::vector<std::string> house_options{};  // with these options,
  std::optional<std::string> command{};      // or with this command

  [[nodiscard]] bool withdrawn() const { return until_round.has_value(); }

  friend bool operator==(const EntryRecord&, const EntryRecord&) = default;
};

// The terms under which a game is played.
struct TermsRecord {
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::string table = "olympiad";      // preset
  std::string materials = "olympiad";  // preset
  std::string noise = "olympiad";      // none, low, olympiad, high, variable
  bool noise_hidden = false;
  double rack_gap = 0;     // m
  double rack_jitter = 0;  // m
  Micros clock{600'000'000};
  Micros increment{0};
  std::optional<Micros> shot_cap{};
  std::uint32_t max_refusals = 3;
  Micros lag_per_turn{100'000};
  Micros lag_per_game{5'000'000};

  friend bool operator==(const TermsRecord&, const TermsRecord&) = default;
};

// What the games 2k and 2k + 1 of a match share.
enum class Mirror : std::uint8_t {
  none,
  rack,   // the rack
  noise,  // the rack, and deviates of shots that both had asked for before either was run
};

[[nodiscard]] std::string_view name(Mirror mirror);
[[nodiscard]] std::optional<Mirror> mirror(std::string_view name);

struct MatchRecord {
  MatchId id{};
  std::optional<std::string> tournament{};  // unset: a challenge
  std::optional<std::uint32_t> pairing{};   // unique in the tournament
  std::optional<std::string> request{};     // unique: what a challenge was asked with
  std::array<AgentId, 2> agents{};          // agents[0] breaks in the first game
  std::uint32_t games = 1;
  TermsRecord terms;
  std::uint64_t seed = 0;  // of the racks
  Mirror mirrored = Mirror::none;
  bool over = false;
  UnixMicros created{};
  std::optional<UnixMicros> finished{};
  std::optional<protocol::ChallengeId> challenge{};  // by which its agents called it
  std::optional<Digest> seal{};  // match::seal over all of the above; unset before schema 2

  friend bool operator==(const MatchRecord&, const MatchRecord&) = default;
};

struct GameRecord {
  GameId id{};
  MatchId match{};
  std::uint32_t number = 0;         // in the match, from 0; a replayed void game keeps it
  std::uint32_t attempt = 0;        // grows when a void or drawn game is played again
  std::array<AgentId, 2> agents{};  // by seat
  TermsRecord terms;
  rules::Seat breaker = rules::Seat::first;
  std::uint64_t rack_seed = 0;  // below 2^53
  Digest key{};                 // of the noise: secret until the match is over
  protocol::NoiseParams noise;  // standard deviations of this game, a factor already in them
  Digest commitment{};
  std::string initial_state;  // JSON
  std::string physics_version;
  std::string rules_version;
  UnixMicros created{};
  // By seat: SHA-256 of the 32 bytes that the agent had committed to when the game was made.
  std::array<std::optional<Digest>, 2> agent_commitments{};
  // Mirrored noise: the pair's first game, whose key gives the shared deviates.
  std::optional<GameId> shared_from{};
  // By seat: those bytes, if they were revealed before the first turn.
  std::array<std::optional<Digest>, 2> agent_secrets{};
  // What grows with the game.
  bool over = false;
  std::optional<rules::GameResult> result{};  // set when over
  std::uint32_t turns = 0;                    // stored rows; exact once over
  Digest head{};                              // checksum of the last row; exact once over
  std::array<bool, 2> acknowledged{};         // by seat: the end was acknowledged
  std::optional<UnixMicros> finished{};
  Digest seal{};  // match::seal over all of the above

  [[nodiscard]] rules::GameSettings settings() const;

  friend bool operator==(const GameRecord&, const GameRecord&) = default;
};

// A scored game in few words, for ratings and lists.
struct ResultRecord {
  GameId game{};
  MatchId match{};
  std::array<AgentId, 2> agents{};  // by seat
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  rules::Seat breaker = rules::Seat::first;
  rules::GameResult result;
  UnixMicros finished{};
};

// What a turn came to. Every turn of a game is one row, the last one too.
enum class TurnAction : std::uint8_t {
  shot,
  decision,
  lost_turn,  // the third refusal, or the cap on a turn's time
  concession,
  timeout,    // game clock at zero
  forfeit,    // did not come, or was withdrawn
  void_game,  // a server fault
};
[[nodiscard]] std::string_view name(TurnAction action);
[[nodiscard]] std::optional<TurnAction> turn_action(std::string_view name);

struct ShotPart {
  std::uint32_t index = 1;  // of this seat's shots in the game, from 1: index of its deviates
  protocol::ShotParams intended;
  protocol::ShotParams executed;  // authoritative: this was simulated
  bool moved = false;  // noise made it impossible, so it was moved to the nearest possible one
  std::optional<physics::Vec2<double>> cue_ball{};  // m, as placed by the player
  rules::Call call;
  std::string events;   // JSON
  bool shared = false;  // its deviates are those of the pair: GameRecord::shared_from

  friend bool operator==(const ShotPart&, const ShotPart&) = default;
};

// The players' clocks after the turn.
struct ClockPart {
  Micros used{0};                // from the turn's start to its end, the server's own time left out
  Micros forgiven{0};            // lag, of `used`
  std::array<Micros, 2> left{};  // by seat
  std::array<Micros, 2> lag_left{};  // by seat

  friend bool operator==(const ClockPart&, const ClockPart&) = default;
};

struct TurnRecord {
  GameId game{};
  std::uint32_t number = 1;  // of the turn, as on the wire
  TurnAction action = TurnAction::shot;
  rules::Seat seat = rules::Seat::first;      // whose turn, or who conceded or forfeits
  std::optional<protocol::ShotId> request{};  // of a shot
  std::string state_before;                   // JSON, as it was sent with the turn
  std::optional<ShotPart> shot{};             // when action is shot
  std::optional<rules::Decision> decision{};  // when action is decision
  std::optional<std::string> ruling{};        // JSON; of shots and lost turns
  std::string state_after;                    // JSON
  std::optional<rules::GameResult> result{};  // when the game ended here
  std::uint32_t refusals = 0;                 // in this turn
  ClockPart clock;
  UnixMicros stored{};
  std::string physics_version;
  std::string rules_version;
  Digest checksum{};  // match::chained over the row before and this

  friend bool operator==(const TurnRecord&, const TurnRecord&) = default;
};

// A line of a tournament's final table.
struct FinalStanding {
  std::uint32_t rank = 1;
  std::string agent;
  double points = 0;
  std::uint32_t games = 0;
  std::uint32_t wins = 0;
  std::uint32_t losses = 0;
  std::uint32_t draws = 0;

  friend bool operator==(const FinalStanding&, const FinalStanding&) = default;
};

// The next free ids; the server that owns the file counts on from here.
struct Counters {
  AgentId agent{1};
  TournamentId tournament{1};
  MatchId match{1};
  GameId game{1};

  friend bool operator==(const Counters&, const Counters&) = default;
};

}  // namespace poolhall::storage
