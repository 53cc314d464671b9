#include "physics/samples.hpp"

#include <Random123/philox.h>

namespace poolhall::physics {

RandomWords random_words(std::uint64_t seed, std::uint64_t sample, std::uint32_t place) {
  const r123::Philox4x32::ctr_type counter{
      {static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(sample >> 32), place, 0}};
  const r123::Philox4x32::key_type key{
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto words = r123::Philox4x32{}(counter, key);
  return {words[0] | (std::uint64_t{words[1]} << 32), words[2] | (std::uint64_t{words[3]} << 32)};
}

ShotDeviates sample_deviates(std::uint64_t seed, std::uint64_t sample) {
  ShotDeviates deviates{};
  for (std::uint32_t i = 0; i < deviates.size(); i += 2) {
    const RandomWords words = random_words(seed, sample, i / 2);
    deviates[i] = normal_quantile(uniform_deviate(words.first));
    if (i + 1 < deviates.size()) {
      deviates[i + 1] = normal_quantile(uniform_deviate(words.second));
    }
  }
  return deviates;
}

}  // namespace poolhall::physics
