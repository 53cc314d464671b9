#include "clients/cpp/game_desk.hpp"

#include <charconv>
#include <string>
#include <utility>

namespace poolhall::client {

GameDesk::GameDesk(GameInfo info, std::unique_ptr<Player> player)
    : info_(std::move(info)), player_(std::move(player)) {}

GameDesk::Step GameDesk::turn_came(TurnTask task) {
  const bool is_same = task_ && task_->key == task.key;
  task_ = std::move(task);
  task_->shots = shots_;
  if (!is_same) {
    answer_.reset();
  }
  return answer_ ? Step::send : think_unless_busy();
}

GameDesk::Step GameDesk::think_unless_busy() {
  if (is_thinking_) {
    return Step::nothing;
  }
  is_thinking_ = true;
  return Step::think;
}

GameDesk::Step GameDesk::move_chosen(TurnKey key, const Move& move) {
  is_thinking_ = false;
  if (!task_) {
    return Step::nothing;
  }
  if (task_->key != key) {
    return think_unless_busy();
  }
  answer_ = request_for(key, move);
  return Step::send;
}

GameDesk::Step GameDesk::refused(TurnKey key) {
  if (!task_ || task_->key != key) {
    return Step::nothing;
  }
  answer_.reset();
  ++task_->key.refusals;
  return think_unless_busy();
}

void GameDesk::turn_over(std::uint32_t turn) {
  if (task_ && task_->key.turn <= turn) {
    task_.reset();
    answer_.reset();
  }
}

protocol::Request GameDesk::request_for(TurnKey key, const Move& move) const {
  const protocol::GameId game = game_id(info_);
  if (const auto* shot = std::get_if<Shot>(&move)) {
    const std::string shot_id =
        "\"t" + std::to_string(key.turn) + "r" + std::to_string(key.refusals) + "\"";
    return protocol::Shot{.game = game,
                          .turn = key.turn,
                          .shot_id = {shot_id},
                          .params = shot->stroke,
                          .cue_ball = shot->cue_ball,
                          .call = shot->call};
  }
  if (const auto* choice = std::get_if<rules::Decision>(&move)) {
    return protocol::Decide{.game = game, .turn = key.turn, .choice = *choice};
  }
  return protocol::Concede{.game = game};
}

protocol::GameId game_id(const GameInfo& info) {
  std::int64_t id = 0;
  std::from_chars(info.game.data(), info.game.data() + info.game.size(), id);
  return protocol::GameId{id};
}

GameInfo game_info(const protocol::GameTerms<protocol::Received>& terms) {
  GameInfo info{.game = std::to_string(protocol::number(terms.game)),
                .seat = terms.seat,
                .opponent = terms.opponent,
                .rules = terms.rules,
                .table = terms.table,
                .materials = terms.physics,
                .noise = terms.noise};
  info.increment = std::chrono::milliseconds(terms.clock.increment_ms);
  if (terms.clock.shot_ms) {
    info.shot_cap = std::chrono::milliseconds(*terms.clock.shot_ms);
  }
  return info;
}

}  // namespace poolhall::client
