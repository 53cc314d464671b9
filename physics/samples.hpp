// Random numbers for samples: Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011; Random123), keyed by
// the seed, counted by sample and place, so that any sample can be drawn without those before it.
//
//   ShotDeviates d = sample_deviates(seed, 17);  // the 18th sample's five normal deviates
#pragma once

#include <cstdint>

#include "physics/noise.hpp"

namespace poolhall::physics {

// Two words of 64 random bits.
struct RandomWords {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
};

[[nodiscard]] RandomWords random_words(std::uint64_t seed, std::uint64_t sample,
                                       std::uint32_t place);

[[nodiscard]] ShotDeviates sample_deviates(std::uint64_t seed, std::uint64_t sample);

}  // namespace poolhall::physics
