#include "clients/bots/random_bot.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "protocol/shot_path.hpp"

namespace poolhall::bots {
namespace {

client::GameInfo game_number(std::string game = "1") {
  return {.game = std::move(game),
          .table = physics::preset_table("olympiad").value(),
          .materials = physics::preset_materials("olympiad").value(),
          .noise = protocol::noise_preset("olympiad")};
}

rules::GameState state_of_kind(rules::TurnKind kind, const client::GameInfo& game) {
  rules::GameState state = rules::new_game({}, game.table, game.materials);
  state.kind = kind;
  return state;
}

class EveryShotKind : public testing::TestWithParam<rules::TurnKind> {};

TEST_P(EveryShotKind, ItsShotCanAlwaysBePlayed) {
  const client::GameInfo game = game_number();
  rules::GameState state = state_of_kind(GetParam(), game);
  for (std::uint32_t turn = 1; turn <= 200; ++turn) {
    state.turn = turn;
    RandomBot bot(game, 5);
    const client::Move move = bot.choose({game, state});
    ASSERT_TRUE(std::holds_alternative<client::Shot>(move));
    const auto& shot = std::get<client::Shot>(move);
    const auto ready = protocol::ready_shot(state, shot.call, shot.cue_ball, shot.stroke,
                                            game.table, game.materials);
    ASSERT_TRUE(ready) << protocol::request_error(ready.error()).reason;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomBot, EveryShotKind,
                         testing::Values(rules::TurnKind::break_shot, rules::TurnKind::shot,
                                         rules::TurnKind::ball_in_hand,
                                         rules::TurnKind::ball_in_hand_behind_head_string),
                         [](const auto& kind) { return std::string(name(kind.param)); });

TEST(RandomBot, ChoosesOneOfTheDecisionsOffered) {
  const client::GameInfo game = game_number();
  rules::GameState state = state_of_kind(rules::TurnKind::decision, game);
  state.options = {rules::Decision::spot_eight, rules::Decision::rerack_breaker_breaks};
  int spotted = 0;
  for (std::uint32_t turn = 1; turn <= 100; ++turn) {
    state.turn = turn;
    const auto choice = std::get<rules::Decision>(RandomBot(game, 5).choose({game, state}));
    ASSERT_TRUE(choice == state.options[0] || choice == state.options[1]);
    spotted += choice == rules::Decision::spot_eight ? 1 : 0;
  }
  EXPECT_GT(spotted, 20);
  EXPECT_LT(spotted, 80);
}

TEST(RandomBot, TheSameSeedPlaysTheSameShotAndAnotherSeedOrGameAnother) {
  const client::GameInfo game = game_number();
  const rules::GameState state = state_of_kind(rules::TurnKind::shot, game);
  const auto shot = [&](const client::GameInfo& where, std::uint64_t seed) {
    return std::get<client::Shot>(RandomBot(where, seed).choose({where, state})).stroke.phi;
  };
  EXPECT_EQ(shot(game, 5), shot(game, 5));
  EXPECT_NE(shot(game, 5), shot(game, 6));
  EXPECT_NE(shot(game, 5), shot(game_number("2"), 5));
}

TEST(RandomBot, ARefusedShotIsNotRepeated) {
  const client::GameInfo game = game_number();
  const rules::GameState state = state_of_kind(rules::TurnKind::shot, game);
  RandomBot bot(game, 5);
  const auto first = std::get<client::Shot>(bot.choose({game, state, {}, 0}));
  const auto second = std::get<client::Shot>(bot.choose({game, state, {}, 1}));
  EXPECT_NE(first.stroke.phi, second.stroke.phi);
}

}  // namespace
}  // namespace poolhall::bots
