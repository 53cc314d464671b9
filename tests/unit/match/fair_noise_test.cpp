#include "server/match/fair_noise.hpp"

#include <gtest/gtest.h>

#include <set>

#include "server/match/chain.hpp"
#include "server/match/sha256.hpp"

namespace poolhall::match {
namespace {

using protocol::GameId;

GameKey counting_key() {
  GameKey key;
  for (std::size_t i = 0; i < key.size(); ++i)
    key[i] = static_cast<std::uint8_t>(i + 1);
  return key;
}

// Expected values by Python's hmac, hashlib, struct and statistics.NormalDist (also AS 241), from
// the layouts that fair_noise.hpp documents.
TEST(FairNoise, gives_the_deviates_that_another_program_computes_from_the_key) {
  const std::array<double, 5> first{1.0153808453955881, -0.3172704670641857, 2.0194990348918345,
                                    0.995503909705422, -1.8921879142244924};
  const std::array<double, 5> third{-1.875900049848158, -0.3225650457448677, -1.0677498637401064,
                                    0.1880457073527023, 0.7133657693511858};
  const auto d = shot_deviates(counting_key(), {GameId{17}, rules::Seat::first, 1});
  const auto e = shot_deviates(counting_key(), {GameId{17}, rules::Seat::second, 3});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(d[i], first[i], 1e-15 * 4) << i;
    EXPECT_NEAR(e[i], third[i], 1e-15 * 4) << i;
  }
}

TEST(FairNoise, draws_the_variable_factor_from_the_key) {
  const auto noise = game_noise("variable", counting_key(), GameId{17}).value();
  EXPECT_DOUBLE_EQ(noise.a, 0.5 * 3.174313653820416);
  EXPECT_DOUBLE_EQ(noise.v, 0.075 * 3.174313653820416);
}

TEST(FairNoise, commits_to_the_documented_bytes) {
  const Digest commitment = commit({.game = GameId{17},
                                    .key = counting_key(),
                                    .noise = protocol::noise_preset("olympiad").value(),
                                    .rack_seed = 99,
                                    .rack_gap = 1e-4,
                                    .rack_jitter = 0});
  EXPECT_EQ(to_hex(commitment), "150d91844aa01ea3f1d5dd9216d9e8c7f31b59298ac0cf06e9eec0cdfe9a4ba2");
}

TEST(FairNoise, seeds_racks_below_two_to_the_53) {
  EXPECT_EQ(rack_seed(12345, 2), 3351015901186757U);
  for (std::uint64_t rack = 0; rack < 1000; ++rack)
    EXPECT_LT(rack_seed(1, rack), std::uint64_t{1} << 53);
}

TEST(FairNoise, knows_its_tracks_and_no_others) {
  const GameKey key = counting_key();
  EXPECT_EQ(game_noise("none", key, GameId{1}), protocol::NoiseParams{});
  EXPECT_EQ(game_noise("olympiad", key, GameId{1}),
            (protocol::NoiseParams{0.5, 0.5, 0.1, 0.125, 0.075}));
  EXPECT_EQ(game_noise("high", key, GameId{1})->a, 2.5);
  EXPECT_EQ(game_noise("low", key, GameId{1})->theta, 0.05);
  EXPECT_EQ(game_noise("loud", key, GameId{1}), std::nullopt);
}

TEST(FairNoise, never_draws_a_key_twice) {
  std::set<GameKey> keys;
  for (int i = 0; i < 1000; ++i)
    keys.insert(draw_key());
  EXPECT_EQ(keys.size(), 1000U);
}

TEST(FairNoise, shares_no_deviate_between_games_seats_shots_and_keys) {
  std::set<double> seen;
  GameKey other = counting_key();
  other[31] ^= 1;
  for (const GameKey& key : {counting_key(), other})
    for (const std::int64_t game : {1, 256})
      for (const rules::Seat seat : {rules::Seat::first, rules::Seat::second})
        for (const std::uint32_t shot : {1U, 256U, 65536U})
          for (const double deviate : shot_deviates(key, {GameId{game}, seat, shot}))
            seen.insert(deviate);
  EXPECT_EQ(seen.size(), 2U * 2 * 2 * 3 * 5);
}

TEST(Sha256, agrees_with_published_examples) {
  const std::string_view abc = "abc";
  const std::vector<std::uint8_t> bytes(abc.begin(), abc.end());
  EXPECT_EQ(to_hex(sha256(bytes)),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2
  const std::string_view key = "Jefe";
  const std::string_view data = "what do ya want for nothing?";
  const std::vector<std::uint8_t> k(key.begin(), key.end());
  const std::vector<std::uint8_t> d(data.begin(), data.end());
  EXPECT_EQ(to_hex(hmac_sha256(k, d)),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");  // RFC 4231, 2
}

}  // namespace
}  // namespace poolhall::match
