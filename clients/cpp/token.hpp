// A fresh secret for an agent that has none.
//
//   protocol::Hex256 token = random_token();
#pragma once

#include "protocol/messages.hpp"

namespace poolhall::client {

// 256 bits from the system's generator.
[[nodiscard]] protocol::Hex256 random_token();

}  // namespace poolhall::client
