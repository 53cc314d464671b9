// Noise that nobody can predict and everybody can check afterwards.
//
//   GameKey key = draw_key();                                   // 32 bytes of the system's
//   generator Digest commitment = commit({id, key, noise, rack});         // told before the first
//   turn ShotDeviates d = shot_deviates(key, id, Seat::first, 3);    // of that seat's third shot
//
// Layouts. All integers are unsigned and big-endian, all reals IEEE-754 binary64 big-endian.
//
// Message of one random number (14 bytes), authenticated with HMAC-SHA-256 under the key; the first
// 8 bytes of the code, as an integer, are 64 random bits:
//   0   8  game id
//   8   1  seat: 0 or 1 for a shot's deviates, 255 for what belongs to no seat
//   9   4  shot: number of this seat's shot in the game, from 1; 0 with seat 255
//   13  1  i: 0 a, 1 b, 2 theta, 3 phi, 4 v; with seat 255: 0 the factor of `variable`
// 64 bits become u = (bits >> 11 + 0.5) 2^-53 and a normal deviate by Wichura's AS 241.
//
// Commitment (108 bytes), hashed with SHA-256:
//   0   4  version of this layout: 1
//   4   8  game id
//   12  32 key
//   44  40 standard deviations of the game's noise: a, b (mm), theta, phi (degrees), v (m/s)
//   84  8  rack seed
//   92  8  rack gap (m)
//   100 8  rack jitter (m)
//
// Seed of a rack (20 bytes "rack" | match seed, 8 | number of the rack in the match, 8), hashed
// with SHA-256; the first 8 bytes, shifted right by 11, are the seed (below 2^53).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/noise.hpp"
#include "protocol/ids.hpp"
#include "protocol/units.hpp"
#include "rules/game_state.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

using storage::Digest;
using GameKey = std::array<std::uint8_t, 32>;

// From the system's generator. Ends the program if that fails: there is no game without it.
[[nodiscard]] GameKey draw_key();

[[nodiscard]] physics::ShotDeviates shot_deviates(const GameKey& key, protocol::GameId game,
                                                  rules::Seat seat, std::uint32_t shot);

// The noise of one game on a track: none, low, olympiad, high, or variable (olympiad times a
// factor between 0 and 5, drawn from the key). Nothing if there is no such track.
[[nodiscard]] std::optional<protocol::NoiseParams> game_noise(std::string_view track,
                                                              const GameKey& key,
                                                              protocol::GameId game);

[[nodiscard]] std::uint64_t rack_seed(std::uint64_t match_seed, std::uint64_t rack);

struct Committed {
  protocol::GameId game{};
  GameKey key{};
  protocol::NoiseParams noise;
  std::uint64_t rack_seed = 0;
  double rack_gap = 0;     // m
  double rack_jitter = 0;  // m
};
[[nodiscard]] Digest commit(const Committed& what);

}  // namespace poolhall::match
