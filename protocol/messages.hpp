// Every message of the protocol as a value. README.md beside this file is the reference for bot
// authors; codec.hpp makes lines of these and reads them.
//
// What the server sends contains big parts (states, events, tables). On the way out they are text
// that was made once (Outgoing); on the way in they are values (Received):
//
//   GameTurn<Outgoing> turn{.game = id, .state = RawJson{encode_state(state)}, ...};
//   GameTurn<Received> seen = ...;  seen.state.balls
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "physics/event_log.hpp"
#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "protocol/errors.hpp"
#include "protocol/events_json.hpp"
#include "protocol/ids.hpp"
#include "protocol/limits.hpp"
#include "protocol/raw_json.hpp"
#include "protocol/state_json.hpp"
#include "protocol/units.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::protocol {

inline constexpr int protocol_version = 1;

struct Outgoing {
  using State = RawJson;
  using Events = RawJson;
  using RulingPart = RawJson;
  using TablePart = RawJson;
  using MaterialsPart = RawJson;
};
struct Received {
  using State = rules::GameState;
  using Events = physics::EventLog<double>;
  using RulingPart = RulingReport;
  using TablePart = physics::Table;
  using MaterialsPart = physics::Materials;
};

// 32 bytes as 64 hexadecimal digits in lower case: tokens, commitments, secrets, checksums.
struct Hex256 {
  std::string text;

  friend bool operator==(const Hex256&, const Hex256&) = default;
};

// 1..limits.name_length characters of A-Z a-z 0-9 . _ -; not "." and "..", which would be lost from
// the page's addresses.
[[nodiscard]] bool is_agent_name(std::string_view text, const Limits& limits);
// The names of noise levels that may be asked for: none, low, olympiad, high, variable.
[[nodiscard]] bool is_noise_name(std::string_view text);

// ---- What agents ask ----

struct ClientInfo {
  std::string name;
  std::string version;
};

struct Hello {
  int least_protocol = protocol_version;
  int most_protocol = protocol_version;
  std::string name;
  std::optional<ClientInfo> client{};
  EventDetail detail = EventDetail::full;
};

struct Register {
  std::string name;
  std::optional<Hex256> token{};  // unset: the server makes one
};

struct Login {
  Hex256 token;
};

struct TournamentList {};
struct TournamentJoin {
  TournamentId tournament{};
};
struct TournamentLeave {
  TournamentId tournament{};
};

struct ClockSettings {
  std::int64_t game_ms = 600'000;
  std::int64_t increment_ms = 0;
  std::optional<std::int64_t> shot_ms{};  // cap on one turn

  friend bool operator==(const ClockSettings&, const ClockSettings&) = default;
};

struct Challenge {
  std::string opponent;  // an agent's name, or "house:NAME"
  std::optional<rules::RuleSet> rules{};
  std::optional<std::string> noise{};  // of a preset
  std::optional<ClockSettings> clock{};
  std::optional<ShotId> challenge_id{};  // makes a repeated request the same challenge

  friend bool operator==(const Challenge&, const Challenge&) = default;
};
struct ChallengeAccept {
  ChallengeId challenge{};
};
struct ChallengeDecline {
  ChallengeId challenge{};
};

struct Shot {
  GameId game{};
  std::uint32_t turn = 0;
  ShotId shot_id;
  ShotParams params;
  std::optional<physics::Vec2<double>> cue_ball{};  // m
  rules::Call call{};

  friend bool operator==(const Shot&, const Shot&) = default;
};

struct Decide {
  GameId game{};
  std::uint32_t turn = 0;
  rules::Decision choice = rules::Decision::accept;
};

struct Concede {
  GameId game{};
};
struct Sync {
  GameId game{};
};
// That the end of this is known and need not be told again.
using Ended = std::variant<GameId, MatchId, TournamentId>;
struct Ack {
  Ended what;
};

struct Ping {
  RawJson t{"null"};  // any number, string or null; comes back as it was
};

// The answer to the server's `lag`; the only request that may come without an id.
struct Lag {
  std::int64_t t = 0;
};

// A commitment (SHA-256) to 32 bytes of the agent's own, for the next game that starts.
struct GameReady {
  Hex256 commitment;
};
// Those bytes, once the server's own commitment stands in game.start.
struct GameReveal {
  GameId game{};
  Hex256 secret;
};

using Request = std::variant<Hello, Register, Login, TournamentList, TournamentJoin,
                             TournamentLeave, Challenge, ChallengeAccept, ChallengeDecline, Shot,
                             Decide, Concede, Sync, Ack, Ping, Lag, GameReady, GameReveal>;

// In the order of Request's alternatives.
enum class Method : std::uint8_t {
  hello,
  register_agent,
  login,
  tournament_list,
  tournament_join,
  tournament_leave,
  challenge,
  challenge_accept,
  challenge_decline,
  shot,
  decide,
  concede,
  sync,
  ack,
  ping,
  lag,
  game_ready,
  game_reveal,
};
[[nodiscard]] std::string_view name(Method method);
[[nodiscard]] std::optional<Method> method(std::string_view name);
[[nodiscard]] constexpr Method method_of(const Request& request) {
  return static_cast<Method>(request.index());
}

// ---- Parts of the server's messages ----

enum class GameStatus : std::uint8_t { running, over };
[[nodiscard]] std::string_view name(GameStatus status);
[[nodiscard]] std::optional<GameStatus> game_status(std::string_view name);

// A game of the agent that is unfinished or whose end it has not acknowledged.
struct GameListing {
  GameId game{};
  MatchId match{};
  std::optional<TournamentId> tournament{};
  rules::Seat seat = rules::Seat::first;
  std::string opponent;
  GameStatus status = GameStatus::running;
};

// Both clocks as they stand, from the reader's side; deadline_ms on the server's time_ms scale.
struct ClockReading {
  std::int64_t own_ms = 0;
  std::int64_t opponent_ms = 0;
  std::optional<std::int64_t> deadline_ms{};  // when the running clock will be at zero
};

// What may be done in a turn.
struct LegalDecisions {
  std::vector<rules::Decision> decisions;
};
struct LegalBalls {
  std::vector<rules::BallId> balls;        // that may be called
  std::vector<rules::BallId> first_balls;  // that the cue ball may strike first
  std::vector<rules::Call::Kind> calls;    // kinds of calls that may be made; `none`: no call
};
using Legal = std::variant<LegalBalls, LegalDecisions>;

// What a game is played with.
template <class Form>
struct GameTerms {
  GameId game{};
  MatchId match{};
  std::optional<TournamentId> tournament{};
  rules::Seat seat = rules::Seat::first;  // of the reader
  std::string opponent;
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  typename Form::TablePart table;
  typename Form::MaterialsPart physics;
  std::optional<NoiseParams> noise{};  // unset: "hidden"
  ClockSettings clock;
  std::uint32_t max_refusals = 3;
  Hex256 commitment;                                         // the server's
  std::array<std::optional<Hex256>, 2> agent_commitments{};  // by seat
};

// ---- Notifications ----

struct ChallengeOffer {
  ChallengeId challenge{};
  std::string from;
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::string noise;
  ClockSettings clock;
  std::int64_t expires_ms = 0;  // on the time_ms scale
};

enum class ChallengeOutcome : std::uint8_t { accepted, declined, expired };
[[nodiscard]] std::string_view name(ChallengeOutcome outcome);
[[nodiscard]] std::optional<ChallengeOutcome> challenge_outcome(std::string_view name);

struct ChallengeOver {
  ChallengeId challenge{};
  ChallengeOutcome outcome = ChallengeOutcome::declined;
};

template <class Form>
struct GameStart {
  GameTerms<Form> terms;
  typename Form::State state;
};

// Everything a bot without a memory needs; also the body of sync's reply.
template <class Form>
struct GameSnapshot {
  GameTerms<Form> terms;
  typename Form::State state;
  ClockReading clocks;  // as they stand; the terms' `clock` are the settings
};

template <class Form>
struct GameTurn {
  GameId game{};
  std::uint32_t turn = 0;
  rules::TurnKind kind = rules::TurnKind::shot;
  typename Form::State state;
  ClockReading clock;
  Legal legal;
  std::uint32_t refusals = 0;  // so far in this turn
};

// A shot that was played: to the opponent, and to the shooter as the reply to `shot`.
template <class Form>
struct GameShot {
  GameId game{};
  std::uint32_t turn = 0;
  rules::Seat by = rules::Seat::first;
  ShotId shot_id;
  rules::Call call{};
  std::optional<physics::Vec2<double>> cue_ball{};  // where it was placed
  ShotParams intended;
  ShotParams executed;
  bool moved = false;  // noise had made it impossible: the nearest possible shot was played
  typename Form::RulingPart ruling;
  typename Form::Events events;
  typename Form::State state;  // afterwards
  ClockReading clock;
};

// A decision that was taken: to the opponent, and to its author as the reply to `decide`.
template <class Form>
struct GameDecision {
  GameId game{};
  std::uint32_t turn = 0;
  rules::Seat by = rules::Seat::first;
  rules::Decision choice = rules::Decision::accept;
  typename Form::State state;  // afterwards
  ClockReading clock;
};

// A turn that ended without a shot: the last refusal, or the cap on a shot's time. To both.
template <class Form>
struct GameTurnLost {
  GameId game{};
  std::uint32_t turn = 0;
  rules::Seat by = rules::Seat::first;
  typename Form::RulingPart ruling;
  typename Form::State state;  // afterwards
  ClockReading clock;
};

struct GameOver {
  GameId game{};
  MatchId match{};
  std::optional<rules::Seat> winner{};  // unset: drawn or void
  rules::EndReason reason = rules::EndReason::conceded;
  bool scored = true;
  Hex256 checksum;  // head of the chain of shots
};

// What makes a game's noise checkable, once its match is over.
struct GameSeeds {
  GameId game{};
  Hex256 key;
  std::uint64_t rack_seed = 0;
  std::array<std::optional<Hex256>, 2> agent_secrets{};  // by seat
};

struct MatchOver {
  MatchId match{};
  std::optional<TournamentId> tournament{};
  std::string opponent;
  double own_points = 0;
  double opponent_points = 0;
  std::vector<GameSeeds> seeds;
};

struct StandingRow {
  std::uint32_t rank = 0;
  std::string agent;
  double points = 0;
  std::uint32_t games = 0;
  std::uint32_t wins = 0;
  std::uint32_t losses = 0;
  std::uint32_t draws = 0;
};

struct TournamentOver {
  TournamentId tournament{};
  std::string name;
  std::vector<StandingRow> standings;
};

// Another login with the same token took over. It means: do not reconnect.
struct Superseded {};

// The server's probe of the lag; a client may answer with `lag {t}`.
struct LagProbe {
  std::int64_t t = 0;
};

// The server stops; games go on when it is back.
struct ShuttingDown {
  std::string reason;
};

template <class Form>
using Notification =
    std::variant<ChallengeOffer, ChallengeOver, GameStart<Form>, GameSnapshot<Form>, GameTurn<Form>,
                 GameShot<Form>, GameDecision<Form>, GameTurnLost<Form>, GameOver, MatchOver,
                 TournamentOver, Superseded, LagProbe, ShuttingDown>;

// The methods of notifications, in the order of Notification's alternatives: "challenge.offer",
// "challenge.over", "game.start", "game.state", "game.turn", "game.shot", "game.decision",
// "game.turn_lost", "game.over", "match.over", "tournament.over", "superseded", "lag",
// "shutting_down".
inline constexpr std::size_t notification_count = 14;
[[nodiscard]] std::string_view notification_name(std::size_t index);
[[nodiscard]] std::optional<std::size_t> notification_index(std::string_view name);

// ---- Replies, one for every request ----

struct HelloReply {
  int protocol = protocol_version;
  ClientInfo server;  // name and version
  std::string session;
  Limits limits;
  std::string rules_version;
  std::string physics_version;
  std::int64_t time_ms = 0;
};

// To `register` (with the token) and to `login` (without it).
struct LoginReply {
  std::string agent;
  std::optional<Hex256> token{};
  std::vector<GameListing> games;
};

enum class TournamentStatus : std::uint8_t { open, running, paused, over, aborted };
[[nodiscard]] std::string_view name(TournamentStatus status);
[[nodiscard]] std::optional<TournamentStatus> tournament_status(std::string_view name);

struct TournamentListing {
  TournamentId tournament{};
  std::string name;
  TournamentStatus status = TournamentStatus::open;
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::string format;  // "round_robin", "swiss", ...
  std::vector<std::string> agents;
};
struct TournamentListReply {
  std::vector<TournamentListing> tournaments;
};

enum class Membership : std::uint8_t { joined, left };
[[nodiscard]] std::string_view name(Membership membership);
[[nodiscard]] std::optional<Membership> membership(std::string_view name);

// To `tournament.join` and `tournament.leave`.
struct TournamentReply {
  TournamentId tournament{};
  Membership membership = Membership::joined;
};

// To `challenge`, `challenge.accept` and `challenge.decline`.
enum class ChallengeStatus : std::uint8_t { offered, accepted, declined };
[[nodiscard]] std::string_view name(ChallengeStatus status);
[[nodiscard]] std::optional<ChallengeStatus> challenge_status(std::string_view name);
struct ChallengeReply {
  ChallengeId challenge{};
  ChallengeStatus status = ChallengeStatus::offered;
  std::optional<MatchId> match{};  // once accepted
};

enum class Repetition : std::uint8_t { first_time, duplicate };

template <class Form>
struct ShotReply {
  GameShot<Form> shot;
  Repetition repetition = Repetition::first_time;
};
template <class Form>
struct DecideReply {
  GameDecision<Form> decision;
  Repetition repetition = Repetition::first_time;
};

// To `concede`, `game.reveal`.
struct GameReply {
  GameId game{};
};
struct AckReply {
  Ended what;
};

template <class Form>
struct SyncReply {
  GameSnapshot<Form> snapshot;
  std::optional<GameTurn<Form>> pending{};  // the agent's own turn
  std::optional<GameOver> over{};
};

struct PingReply {
  RawJson t{"null"};
  std::int64_t time_ms = 0;
};

// To `lag` with an id, and to `game.ready`.
struct EmptyReply {};

template <class Form>
using Reply = std::variant<EmptyReply, HelloReply, LoginReply, TournamentListReply, TournamentReply,
                           ChallengeReply, ShotReply<Form>, DecideReply<Form>, GameReply, AckReply,
                           SyncReply<Form>, PingReply>;

}  // namespace poolhall::protocol
