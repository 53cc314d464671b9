// What only 8-ball remembers between two shots, and its words: the groups.
//
//   std::optional<Group> mine = group_of(memory, seat);  // nothing while the table is open
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/ball.hpp"
#include "rules/seat.hpp"

namespace poolhall::rules {

// Solids are the balls 1..7, stripes 9..15.
enum class Group : std::uint8_t { solids, stripes };
[[nodiscard]] std::string_view name(Group group);
[[nodiscard]] std::optional<Group> group(std::string_view name);

// The group of an object ball; nothing for the cue ball and the 8.
[[nodiscard]] std::optional<Group> group_of(physics::BallId ball);

struct EightBallMemory {
  // Group of the player in Seat::first; unset while the table is open.
  std::optional<Group> first_seat_group{};

  friend bool operator==(const EightBallMemory&, const EightBallMemory&) = default;
};

// The group of the player in `seat`; nothing while the table is open.
[[nodiscard]] std::optional<Group> group_of(const EightBallMemory& memory, Seat seat);

}  // namespace poolhall::rules
