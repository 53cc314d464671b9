#include "server/match/fair_noise.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "server/match/sha256.hpp"

namespace poolhall::match {
namespace {

constexpr std::uint8_t no_seat = 255;
constexpr std::uint32_t commitment_version = 1;
constexpr double largest_variable_factor = 5;

std::uint64_t first_64_bits(const Digest& digest) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i)
    bits = bits << 8 | digest[i];
  return bits;
}

std::uint64_t random_bits(const GameKey& key, protocol::GameId game, std::uint8_t seat,
                          std::uint32_t shot, std::uint8_t i) {
  Bytes message;
  message.integer(number(game)).fixed(seat).fixed(shot).fixed(i);
  return first_64_bits(hmac_sha256(key, message.bytes()));
}

}  // namespace

GameKey draw_key() {
  GameKey key;
  if (getentropy(key.data(), key.size()) != 0) {
    std::perror("poolhall: no random bytes from the system");
    std::abort();
  }
  return key;
}

GameKey mixed_key(const GameKey& drawn, const AgentSecrets& secrets) {
  if (!secrets[0] && !secrets[1])
    return drawn;
  Bytes message;
  for (const std::optional<Digest>& secret : secrets)
    message.presence(secret.has_value()).raw(secret.value_or(Digest{}));
  return hmac_sha256(drawn, message.bytes());
}

bool is_committed(const Digest& commitment, const Digest& secret) {
  return sha256(secret) == commitment;
}

physics::ShotDeviates shot_deviates(const GameKey& key, const ShotIndex& index) {
  const std::size_t stream = index.stream == Stream::shared ? 2 : 0;
  const auto seat = static_cast<std::uint8_t>(stream + rules::index(index.seat));
  physics::ShotDeviates deviates{};
  for (std::size_t i = 0; i < deviates.size(); ++i) {
    const std::uint64_t bits =
        random_bits(key, index.game, seat, index.shot, static_cast<std::uint8_t>(i));
    deviates[i] = physics::normal_quantile(physics::uniform_deviate(bits));
  }
  return deviates;
}

std::optional<protocol::NoiseParams> game_noise(std::string_view track, const GameKey& key,
                                                protocol::GameId game) {
  if (track != "variable")
    return protocol::noise_preset(track);
  const double uniform = physics::uniform_deviate(random_bits(key, game, no_seat, 0, 0));
  return protocol::scaled(protocol::noise_preset("olympiad").value(),
                          largest_variable_factor * uniform);
}

std::uint64_t rack_seed(std::uint64_t match_seed, std::uint64_t rack) {
  constexpr std::array<std::uint8_t, 4> tag{'r', 'a', 'c', 'k'};
  Bytes message;
  message.raw(tag).fixed(match_seed).fixed(rack);
  return first_64_bits(sha256(message.bytes())) >> 11;
}

std::uint64_t rack_number(std::uint32_t game, std::uint32_t attempt, storage::Mirror mirror) {
  const std::uint64_t rack = mirror == storage::Mirror::none ? game : game / 2;
  return rack + (std::uint64_t{attempt} << 32U);
}

Digest commit(const Committed& what) {
  Bytes layout;
  layout.fixed(commitment_version).integer(number(what.game)).raw(what.key);
  const protocol::NoiseParams& noise = what.noise;
  for (const double sigma : {noise.a, noise.b, noise.theta, noise.phi, noise.v})
    layout.real(sigma);
  layout.fixed(what.rack_seed).real(what.rack_gap).real(what.rack_jitter);
  return sha256(layout.bytes());
}

}  // namespace poolhall::match
