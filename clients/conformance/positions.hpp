// Odd but legal positions, each the beginning of a game whose first turn is the bot's.
//
//   for (const Position& position : positions()) host.begin(position.plan());
#pragma once

#include <functional>
#include <span>

#include "clients/conformance/conduct.hpp"
#include "clients/conformance/hosted_game.hpp"

namespace poolhall::conformance {

struct Position {
  CheckInfo info;
  GamePlan (*plan)() = nullptr;
};

[[nodiscard]] std::span<const Position> positions();

}  // namespace poolhall::conformance
