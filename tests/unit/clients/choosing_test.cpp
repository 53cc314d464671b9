#include "clients/bots/choosing.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "placed_balls.hpp"

namespace poolhall::bots::choosing_tests {
namespace {

using rules::Decision;
using rules::TurnKind;

const auto no_worth = [](const rules::GameState&) { return 0.0; };
const auto no_shot = [] { return std::optional<client::Shot>{}; };

Dice dice() {
  return {Dice::key(1, "choosing"), 0};
}

rules::GameState after_a_bad_break() {
  auto state = rules::new_game({}, info().table, info().materials);
  state.kind = TurnKind::decision;
  state.to_move = rules::other(state.breaker);
  state.options = {Decision::accept, Decision::rerack_chooser_breaks,
                   Decision::rerack_breaker_breaks};
  return state;
}

TEST(ChosenMove, IsTheDecisionOfMostWorth) {
  const auto game = info();
  const auto state = after_a_bad_break();
  const auto likes = [&](TurnKind kind, rules::Seat mover) {
    const auto worth = [=](const rules::GameState& next) {
      return next.kind == kind && next.to_move == mover ? -1.0 : -2.0;
    };
    return std::get<Decision>(chosen_move({game, state}, {worth, no_shot}, dice()));
  };
  const rules::Seat chooser = state.to_move;
  EXPECT_EQ(likes(TurnKind::shot, chooser), Decision::accept);
  EXPECT_EQ(likes(TurnKind::break_shot, chooser), Decision::rerack_chooser_breaks);
  EXPECT_EQ(likes(TurnKind::break_shot, other(chooser)), Decision::rerack_breaker_breaks);
}

TEST(ChosenMove, IsTheBestShotUntilThatIsRefused) {
  const auto game = info();
  const auto state = table_with({{0, {0.558, 1.118}}, {1, {0.2, 1.9}}, {8, {0.9, 1.2}}});
  const client::Shot best{.stroke = {.theta = 5, .phi = 12.5, .v = 1.25}};
  const Thoughts thoughts{no_worth, [&] { return std::optional(best); }};
  const auto phi = [&](std::uint32_t refusals) {
    const client::Move move = chosen_move({game, state, {}, refusals}, thoughts, dice());
    return std::get<client::Shot>(move).stroke.phi;
  };
  EXPECT_EQ(phi(0), best.stroke.phi);
  EXPECT_NE(phi(1), best.stroke.phi);
}

TEST(ChosenMove, IsARandomShotWhereNoneWasFound) {
  const auto game = info();
  const auto state = table_with({{0, {0.558, 1.118}}, {1, {0.2, 1.9}}, {8, {0.9, 1.2}}});
  const client::Move move = chosen_move({game, state}, {no_worth, no_shot}, dice());
  EXPECT_TRUE(std::holds_alternative<client::Shot>(move));
}

TEST(ChosenMove, ConcedesWhereNothingMayBeChosen) {
  const auto game = info();
  auto state = after_a_bad_break();
  state.options.clear();
  const client::Move move = chosen_move({game, state}, {no_worth, no_shot}, dice());
  EXPECT_TRUE(std::holds_alternative<client::Concede>(move));
}

}  // namespace
}  // namespace poolhall::bots::choosing_tests
