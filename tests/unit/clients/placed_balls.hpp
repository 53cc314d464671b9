// Tables with a few balls on them for a bot to think about, and what comes of its shots without
// noise.
//
//   const auto state = table_with({{0, {0.558, 1.118}}, {1, {0.2, 1.9}}, {8, {0.9, 1.2}}});
//   EXPECT_TRUE(played_exactly(info(), state, shot).legal);
#pragma once

#include <initializer_list>
#include <string_view>

#include "clients/bots/pot_lines.hpp"
#include "clients/cpp/player.hpp"
#include "protocol/shot_path.hpp"

namespace poolhall::bots {

inline client::GameInfo info(std::string_view noise = "olympiad") {
  return {.game = "1",
          .table = physics::preset_table("olympiad").value(),
          .materials = physics::preset_materials("olympiad").value(),
          .noise = protocol::noise_preset(noise)};
}

struct Placed {
  unsigned id = 0;
  Point at;
};

// The first player has solids; every ball that is not named is down.
inline rules::GameState table_with(std::initializer_list<Placed> balls,
                                   rules::TurnKind kind = rules::TurnKind::shot) {
  using rules::Whereabouts;
  const client::GameInfo game = info();
  rules::GameState state = rules::new_game({}, game.table, game.materials);
  state.kind = kind;
  state.turn = 9;
  rules::EightBallMemory memory;
  memory.first_seat_group = rules::Group::solids;
  state.memory = memory;
  for (auto& ball : state.balls) {
    ball.where = Whereabouts::pocketed;
    ball.pocket = PocketId::foot_left;
  }
  for (const auto& [id, at] : balls) {
    state.balls[id] = {BallId{static_cast<std::uint8_t>(id)}, Whereabouts::on_table, at, {}};
  }
  return state;
}

inline rules::Ruling played_exactly(const client::GameInfo& game, const rules::GameState& state,
                                    const client::Shot& shot) {
  const auto ready =
      protocol::ready_shot(state, shot.call, shot.cue_ball, shot.stroke, game.table, game.materials)
          .value();
  return protocol::play_shot(ready).value().ruling;
}

}  // namespace poolhall::bots
