// The noise of a game that does not tell it, from the shots seen so far: each shows what was
// intended and what was played.
//
//   protocol::NoiseParams noise = guessed_noise(turn.shots);
#pragma once

#include <span>

#include "clients/cpp/player.hpp"

namespace poolhall::bots {

// The Olympiad's noise times the likeliest factor. Before any shot the factor is 1, and that counts
// as much as one shot does. Shots that were moved say nothing.
[[nodiscard]] protocol::NoiseParams guessed_noise(std::span<const client::SeenShot> shots);

}  // namespace poolhall::bots
