// What a server says to an agent in an 8-ball game that has just begun: for tests of clients.
//
//   send(encode_notification(scripted_start(GameId{17}), 1));
//   send(encode_notification(scripted_turn(GameId{17}, 1), 2));
#pragma once

#include <cstdint>

#include "protocol/messages.hpp"

namespace poolhall::test_support {

[[nodiscard]] rules::GameState scripted_opening();
[[nodiscard]] protocol::GameStart<protocol::Outgoing> scripted_start(protocol::GameId game);
[[nodiscard]] protocol::GameTurn<protocol::Outgoing> scripted_turn(protocol::GameId game,
                                                                   std::uint32_t turn);
[[nodiscard]] protocol::GameOver scripted_over(protocol::GameId game);

}  // namespace poolhall::test_support
