// What a bot author writes: a Player looks at the table once a turn and says what to do. Pure
// strategy: no socket, no thread, no clock; the same Player plays on a server (client.hpp) or
// inside one process.
//
//   class Straight : public client::Player {
//     client::Move choose(const client::TurnView& turn) override {
//       if (turn.state.kind == rules::TurnKind::decision) return turn.state.options.front();
//       return client::Shot{.stroke = {.theta = 5, .phi = 90, .v = 3}};
//     }
//   };
//
// Strokes and their noise are in mm, degrees and m/s, as on the wire; everything else is SI.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "protocol/units.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"

namespace poolhall::client {

// What is fixed for a game.
struct GameInfo {
  std::string game{};                     // the server's id
  rules::Seat seat = rules::Seat::first;  // this player's
  std::string opponent{};
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  physics::Table table{};
  physics::Materials materials{};
  std::optional<protocol::NoiseParams> noise{};  // unset: the tournament does not tell
  std::chrono::microseconds increment{};         // added to the clock after each finished turn
  std::optional<std::chrono::microseconds> shot_cap{};  // a longer turn is lost
};

// What both have left when the player is asked.
struct Clock {
  std::chrono::microseconds own{std::chrono::minutes{10}};
  std::chrono::microseconds opponent{std::chrono::minutes{10}};
};

// A shot that either player has made, as far as this client was told.
struct SeenShot {
  protocol::ShotParams intended{};
  protocol::ShotParams executed{};
  bool moved = false;  // noise had made it impossible: the nearest possible shot was played
};

// A turn of this player. The references hold as long as the call to Player::choose.
struct TurnView {
  const GameInfo& info;
  const rules::GameState& state;
  Clock clock{};
  std::uint32_t refusals = 0;         // of this turn so far
  std::span<const SeenShot> shots{};  // of the game so far, both players'
};

struct Shot {
  protocol::ShotParams stroke{};
  std::optional<physics::Vec2<double>> cue_ball{};  // m; required with the ball in hand
  rules::Call call{};
};

// Give the game up.
struct Concede {};

using Move = std::variant<Shot, rules::Decision, Concede>;

class Player {
 public:
  Player() = default;
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  virtual ~Player() = default;

  // Called once for each of this player's turns, and again in a turn whose last move was refused.
  [[nodiscard]] virtual Move choose(const TurnView& turn) = 0;
};

// Makes the Player of one game, so that games that run at the same time share nothing.
using PlayerFactory = std::function<std::unique_ptr<Player>(const GameInfo&)>;

// A factory from a function that chooses by the turn alone.
[[nodiscard]] PlayerFactory player_from(std::function<Move(const TurnView&)> choose);

}  // namespace poolhall::client
