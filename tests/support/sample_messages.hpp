// What a server says to an agent in an 8-ball game that has just begun: for tests of clients.
//
//   send(encode_notification(sample_game_start(GameId{17}), 1));
//   send(encode_notification(sample_break_turn(GameId{17}, 1), 2));
#pragma once

#include <cstdint>

#include "protocol/messages.hpp"

namespace poolhall::test_support {

[[nodiscard]] rules::GameState sample_opening();
[[nodiscard]] protocol::GameStart<protocol::Outgoing> sample_game_start(protocol::GameId game);
[[nodiscard]] protocol::GameTurn<protocol::Outgoing> sample_break_turn(protocol::GameId game,
                                                                       std::uint32_t turn);
[[nodiscard]] protocol::GameOver sample_game_over(protocol::GameId game);

}  // namespace poolhall::test_support
