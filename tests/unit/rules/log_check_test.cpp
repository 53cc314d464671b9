#include "rules/log_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "physics/simulator.hpp"
#include "rules/referee.hpp"

namespace poolhall::rules {
namespace {

struct Place {
  unsigned id;
  physics::Vec2<double> at;
};

GameState table_with(const std::vector<Place>& balls, const physics::Table& table,
                     const physics::Materials& materials) {
  GameState state = new_game({}, table, materials);
  state.kind = TurnKind::shot;
  for (BallPlace& ball : state.balls) {
    ball.where = Whereabouts::pocketed;
  }
  for (const auto& [id, at] : balls) {
    state.balls[id] = {BallId{static_cast<std::uint8_t>(id)}, Whereabouts::on_table, at, {}};
  }
  return state;
}

// From a game between bots: the cue ball follows the 9, pressing on it, so that nineteen hops
// are one entry, whose `after` is 1.8 mm from where the first of them happened.
TEST(LogCheck, AcceptsAnEntryThatStandsForManyHops) {
  const auto table = physics::preset_table("olympiad").value();
  const auto materials = physics::preset_materials("olympiad").value();
  const GameState state = table_with({{0, {0.72853649781602736, 1.4566318380199921}},
                                      {2, {0.53202307325628706, 1.8209589913810844}},
                                      {3, {0.65797220485791363, 1.8106739258709936}},
                                      {6, {0.94033698309331659, 1.1589095604442661}},
                                      {8, {0.56936649023402441, 1.7446647131853985}},
                                      {9, {0.63050211962765634, 1.7600323129331761}},
                                      {10, {0.10604743953814635, 1.6223233538920623}},
                                      {11, {0.41784784597475166, 0.16689611360642573}},
                                      {12, {1.0565793011707605, 0.34037505055626294}},
                                      {13, {0.87196692821467003, 1.3191209069215366}},
                                      {14, {0.59019229156924125, 1.8216267638477455}},
                                      {15, {1.0015963989561718, 2.1848999941095979}}},
                                     table, materials);
  const auto shot =
      physics::cue_shot_from_degrees(-0.23644939365382003, 3.4597690862522694, 6.7440389260923874,
                                     -62.130146126848743, 3.556368000228475);
  const auto played =
      physics::simulate<double>({table, materials, balls_on_table(state), shot}, {}).value();
  ASSERT_TRUE(
      std::ranges::any_of(played.events, [](const auto& event) { return event.count > 3; }));
  const auto fits = check_log(state, played.events, materials);
  EXPECT_TRUE(fits) << fits.error().field << " " << fits.error().reason;
}

}  // namespace
}  // namespace poolhall::rules
