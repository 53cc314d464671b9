// Noise that nobody can predict and everybody can check afterwards.
//
//   GameKey drawn = draw_key();                            // 32 bytes of the system's generator
//   Digest commitment = commit({id, drawn, noise, rack});  // told before the first turn
//   GameKey key = mixed_key(drawn, secrets);               // with what the agents have revealed
//   ShotDeviates d = shot_deviates(key, {id, Seat::first, 3});   // of that seat's third shot
//
// Layouts. All integers are unsigned and big-endian, all reals IEEE-754 binary64 big-endian.
//
// Message of one random number (14 bytes), authenticated with HMAC-SHA-256 under the key; the first
// 8 bytes of the code, as an integer, are 64 random bits:
//   0   8  game id
//   8   1  seat: 0 or 1 for a shot's deviates; 2 or 3 for those that a pair of games shares, under
//          the key and id of the pair's first game; 255 for what belongs to no seat
//   9   4  shot: number of this seat's shot in the game, from 1; 0 with seat 255
//   13  1  i: 0 a, 1 b, 2 theta, 3 phi, 4 v; with seat 255: 0 the factor of `variable`
// 64 bits become u = (bits >> 11 + 0.5) 2^-53 and a normal deviate by Wichura's AS 241.
//
// The key of the deviates is the drawn key if no agent has revealed anything; else HMAC-SHA-256
// under the drawn key of 66 bytes: for each seat 1 and its 32 bytes, or 33 zeros. The factor of
// `variable` is drawn under the drawn key: it is told before anything is revealed.
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

// What the agents have revealed, by seat.
using AgentSecrets = std::array<std::optional<Digest>, 2>;
[[nodiscard]] GameKey mixed_key(const GameKey& drawn, const AgentSecrets& secrets);
// Whether these are the bytes that the agent had committed to.
[[nodiscard]] bool is_committed(const Digest& commitment, const Digest& secret);

enum class Stream : std::uint8_t { own, shared };
struct ShotIndex {
  protocol::GameId game{};
  rules::Seat seat = rules::Seat::first;
  std::uint32_t shot = 1;
  Stream stream = Stream::own;
};
[[nodiscard]] physics::ShotDeviates shot_deviates(const GameKey& key, const ShotIndex& index);

// The noise of one game on a track: none, low, olympiad, high, or variable (olympiad times a
// factor between 0 and 5, drawn from the key). Nothing if there is no such track.
[[nodiscard]] std::optional<protocol::NoiseParams> game_noise(std::string_view track,
                                                              const GameKey& key,
                                                              protocol::GameId game);

[[nodiscard]] std::uint64_t rack_seed(std::uint64_t match_seed, std::uint64_t rack);
// Which rack of its match a game has. A game played again has a new one.
[[nodiscard]] std::uint64_t rack_number(std::uint32_t game, std::uint32_t attempt,
                                        storage::Mirror mirror);

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
