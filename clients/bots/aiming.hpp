// Turning the cue until the object ball goes where it should: the straight ghost-ball aim misses
// by throw and by the curve of an elevated cue.
//
//   std::optional<Aimed> aimed = aim(line, wish, balls, table, materials);
#pragma once

#include <cstdint>
#include <optional>

#include "clients/bots/pot_lines.hpp"
#include "clients/bots/stroke.hpp"

namespace poolhall::bots {

struct Aimed {
  protocol::ShotParams stroke{};
  std::uint64_t events = 0;  // simulated on the way
};

// `wish.phi` is ignored. `balls` holds the cue ball in its place. Nothing if no heading sends the
// object ball along the line.
[[nodiscard]] std::optional<Aimed> aim(const PotLine& line, StrokeWish wish,
                                       const physics::BallSet<double>& balls,
                                       const physics::Table& table,
                                       const physics::Materials& materials);

}  // namespace poolhall::bots
