// What a client remembers of one game, across connections: whose turn, what is being thought
// about, and the answer that the server has not confirmed yet. No sockets, no threads: it is told
// what happened and says what to do next.
//
//   GameDesk desk(info, factory(info));
//   switch (desk.turn_came(task)) { case Step::think: ...; case Step::send: send(*desk.answer()); }
//   desk.move_chosen(key, move);
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "clients/cpp/player.hpp"
#include "protocol/messages.hpp"

namespace poolhall::client {

// One attempt at one turn: a refused move makes another.
struct TurnKey {
  std::uint32_t turn = 0;
  std::uint32_t refusals = 0;

  friend auto operator<=>(const TurnKey&, const TurnKey&) = default;
};

struct TurnTask {
  TurnKey key;
  rules::GameState state;
  Clock clock;
  std::vector<SeenShot> shots{};  // of the game so far
};

class GameDesk {
 public:
  enum class Step : std::uint8_t {
    nothing,
    think,  // about task(), with player(); then move_chosen
    send,   // answer(); the same shot_id and content as often as need be
  };

  GameDesk(GameInfo info, std::unique_ptr<Player> player);

  // The server says that it is this player's turn, perhaps again after a new login.
  [[nodiscard]] Step turn_came(TurnTask task);
  // The player has chosen. Nothing to send if that turn is over meanwhile; another one may have
  // come to think about.
  [[nodiscard]] Step move_chosen(TurnKey key, const Move& move);
  // The server refused the answer and the turn goes on: think again.
  [[nodiscard]] Step refused(TurnKey key);
  // The server told of a shot, this player's or the other's.
  void shot_seen(const SeenShot& shot) { shots_.push_back(shot); }
  // The server has stored the answer, or the turn is over for another reason.
  void turn_over(std::uint32_t turn);

  [[nodiscard]] const GameInfo& info() const { return info_; }
  [[nodiscard]] const std::shared_ptr<Player>& player() const { return player_; }
  [[nodiscard]] const std::optional<TurnTask>& task() const { return task_; }
  [[nodiscard]] const std::optional<protocol::Request>& answer() const { return answer_; }

 private:
  [[nodiscard]] Step think_unless_busy();
  [[nodiscard]] protocol::Request request_for(TurnKey key, const Move& move) const;

  GameInfo info_;
  std::shared_ptr<Player> player_;  // shared with the thread that thinks
  std::optional<TurnTask> task_{};
  std::optional<protocol::Request> answer_{};  // to task_
  std::vector<SeenShot> shots_{};
  bool is_thinking_ = false;
};

// The id of the game that `info` is about, as it was on the wire.
[[nodiscard]] protocol::GameId game_id(const GameInfo& info);

// What the server tells of a game, in a player's terms.
[[nodiscard]] GameInfo game_info(const protocol::GameTerms<protocol::Received>& terms);

}  // namespace poolhall::client
