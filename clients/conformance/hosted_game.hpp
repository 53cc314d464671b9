// A game as the hostile server keeps it: real table, rules and physics, no sockets and no clock of
// its own. Every message that it makes is one that the real server could send.
//
//   HostedGame game({.id = GameId{7}, .seat = rules::Seat::first}, detail);
//   send(game.start()); send(game.turn());
//   auto played = game.judge(shot);            // tl::expected<Played, protocol::Error>
//   if (played) { game.store(*played); reply(played->told); }
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "protocol/messages.hpp"

namespace poolhall::conformance {

using protocol::Outgoing;

struct GamePlan {
  protocol::GameId id{};
  protocol::MatchId match{};
  std::optional<protocol::TournamentId> tournament{};
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  rules::Seat seat = rules::Seat::first;  // the bot's
  std::string opponent = "hostile";
  std::string table = "olympiad";
  std::string materials = "olympiad";
  std::optional<protocol::NoiseParams> noise = protocol::noise_preset("olympiad");  // unset: hidden
  protocol::ClockSettings clock{};
  std::chrono::milliseconds left{10'000};            // on both clocks, at every turn
  std::uint64_t seed = 20261130;                     // of the rack and of the opponent's shots
  std::optional<rules::GameState> position{};        // unset: a fresh rack
  std::optional<protocol::Hex256> own_commitment{};  // the bot's, if it has sent one
};

// A turn that can be stored, and what is told of it.
struct Played {
  std::variant<protocol::GameShot<Outgoing>, protocol::GameDecision<Outgoing>> told;
  rules::GameState next;
};

class HostedGame {
 public:
  HostedGame(GamePlan plan, protocol::EventDetail detail);

  [[nodiscard]] protocol::GameId id() const { return plan_.id; }
  [[nodiscard]] const GamePlan& plan() const { return plan_; }
  [[nodiscard]] const rules::GameState& state() const { return state_; }
  [[nodiscard]] const physics::Table& table() const { return table_; }
  [[nodiscard]] const physics::Materials& materials() const { return materials_; }
  [[nodiscard]] bool is_bots_turn() const { return !state_.result && state_.to_move == plan_.seat; }
  void set_detail(protocol::EventDetail detail) { detail_ = detail; }

  [[nodiscard]] protocol::GameStart<Outgoing> start() const;
  [[nodiscard]] protocol::GameSnapshot<Outgoing> snapshot() const;
  [[nodiscard]] protocol::GameTurn<Outgoing> turn() const;
  [[nodiscard]] protocol::GameOver over() const;
  [[nodiscard]] protocol::GameListing listing() const;

  // What the server would make of the bot's answer to the turn that is due.
  [[nodiscard]] protocol::Expected<Played> judge(const protocol::Shot& shot) const;
  [[nodiscard]] protocol::Expected<Played> judge(const protocol::Decide& decide) const;
  // The answer is durable.
  void store(const Played& played);
  // One more refusal in this turn.
  void refused() { ++refusals_; }
  [[nodiscard]] std::uint32_t refusals() const { return refusals_; }
  // The turn is lost without a shot.
  [[nodiscard]] protocol::GameTurnLost<Outgoing> lose_turn(rules::FoulCode code);
  void end(const rules::GameResult& result);

  // The answer to a shot or decision of a turn that is over: its first reply again, or
  // conflicting_shot, or stale_turn.
  [[nodiscard]] protocol::Expected<protocol::Reply<Outgoing>> again(
      const protocol::Shot& shot) const;
  [[nodiscard]] protocol::Expected<protocol::Reply<Outgoing>> again(
      const protocol::Decide& decide) const;

  // The opponent's turn, played at random so that the game goes on and, where that can be brought
  // about, the bot is to move. Stored already.
  [[nodiscard]] Played opponent_plays();

 private:
  [[nodiscard]] protocol::GameTerms<Outgoing> terms() const;
  [[nodiscard]] protocol::ClockReading clock() const;
  [[nodiscard]] protocol::Error error(protocol::ErrorCode code, std::string field,
                                      std::string reason) const;
  [[nodiscard]] protocol::Expected<Played> play(const protocol::Shot& shot, rules::Seat by) const;

  GamePlan plan_;
  protocol::EventDetail detail_;
  physics::Table table_;
  physics::Materials materials_;
  rules::GameState state_;
  std::uint32_t refusals_ = 0;
  std::map<std::uint32_t, std::pair<protocol::Request, Played>> stored_;  // the bot's, by turn
};

// Milliseconds since 1970, the server's time_ms.
[[nodiscard]] std::int64_t time_ms();

}  // namespace poolhall::conformance
