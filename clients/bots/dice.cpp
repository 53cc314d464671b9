#include "clients/bots/dice.hpp"

#include <Random123/philox.h>

namespace poolhall::bots {

Dice::Key Dice::key(std::uint64_t seed, std::string_view game) {
  // FNV-1a: any fixed spread of the game's name will do, Philox mixes the rest.
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : game) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return {hash ^ (seed * 0x9E3779B97F4A7C15ULL)};
}

std::uint64_t Dice::bits() {
  const std::uint64_t block = drawn_ / 2;
  const r123::Philox4x32::ctr_type counter{
      {stream_, 0, static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(block >> 32)}};
  const r123::Philox4x32::key_type key{
      {static_cast<std::uint32_t>(key_.value), static_cast<std::uint32_t>(key_.value >> 32)}};
  const auto words = r123::Philox4x32{}(counter, key);
  const std::size_t first = drawn_ % 2 == 0 ? 0 : 2;
  ++drawn_;
  return (static_cast<std::uint64_t>(words[first + 1]) << 32) | words[first];
}

double Dice::uniform(double low, double high) {
  return low + (high - low) * physics::uniform_deviate(bits());
}

std::size_t Dice::below(std::size_t bound) {
  // The bias of the remainder is bound / 2^64.
  return static_cast<std::size_t>(bits() % bound);
}

double Dice::normal() {
  return physics::normal_quantile(physics::uniform_deviate(bits()));
}

physics::ShotDeviates Dice::deviates() {
  physics::ShotDeviates result{};
  for (double& deviate : result) {
    deviate = normal();
  }
  return result;
}

}  // namespace poolhall::bots
