#include "rules/eight_ball_memory.hpp"

namespace poolhall::rules {

std::string_view name(Group group) {
  return group == Group::solids ? "solids" : "stripes";
}

std::optional<Group> group(std::string_view name) {
  if (name == "solids") {
    return Group::solids;
  }
  if (name == "stripes") {
    return Group::stripes;
  }
  return std::nullopt;
}

std::optional<Group> group_of(physics::BallId ball) {
  const unsigned n = physics::number(ball);
  if (n == 0 || n == 8 || n > 15) {
    return std::nullopt;
  }
  return n < 8 ? Group::solids : Group::stripes;
}

std::optional<Group> group_of(const EightBallMemory& memory, Seat seat) {
  if (!memory.first_seat_group || seat == Seat::first) {
    return memory.first_seat_group;
  }
  return *memory.first_seat_group == Group::solids ? Group::stripes : Group::solids;
}

}  // namespace poolhall::rules
