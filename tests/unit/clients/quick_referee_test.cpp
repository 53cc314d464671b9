#include "clients/bots/quick_referee.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <variant>

#include "clients/bots/greedy_bot.hpp"
#include "clients/bots/random_bot.hpp"
#include "protocol/shot_path.hpp"
#include "rules/referee.hpp"

namespace poolhall::bots {
namespace {

// A game between two bots, every shot of it judged twice.
class JudgedTwice {
 public:
  JudgedTwice(rules::RuleSet rules, const std::string& table, std::uint64_t seed)
      : table_(physics::preset_table(table).value()),
        materials_(physics::preset_materials("olympiad").value()) {
    info_ = {.game = std::to_string(seed),
             .rules = rules,
             .table = table_,
             .materials = materials_,
             .noise = protocol::noise_preset("high")};
    state_ = rules::new_game({.rules = rules, .rack_seed = seed}, table_, materials_);
  }

  // Plays on until the game is over; how many shots were judged.
  std::size_t play(client::Player& player) {
    std::size_t shots = 0;
    for (int turn = 0; turn < 300 && !state_.result; ++turn) {
      info_.seat = state_.to_move;
      const client::Move move = player.choose({info_, state_});
      if (const auto* decision = std::get_if<rules::Decision>(&move)) {
        state_ = rules::decide(state_, *decision, table_, materials_).value();
      } else {
        take(std::get<client::Shot>(move));
        ++shots;
      }
    }
    return shots;
  }

 private:
  void take(const client::Shot& shot) {
    auto ready =
        protocol::ready_shot(state_, shot.call, shot.cue_ball, shot.stroke, table_, materials_)
            .value();
    Dice dice(Dice::key(1, info_.game), state_.turn);
    const auto executed = protocol::executed_shot(shot.stroke, *info_.noise, dice.deviates(),
                                                  ready.scene.balls, table_, materials_);
    ready.scene.shot = protocol::to_physics(executed.params);
    const auto [simulation, ruling] = protocol::play_shot(ready).value();
    Position before = position_of(ready.state);
    before.at[0] = ready.scene.balls[0].position;
    compare(quickly(before, shot.call, simulation), ruling.next);
    state_ = ruling.next;
  }

  Position quickly(const Position& before, const rules::Call& call,
                   const physics::Simulation<double>& simulation) const {
    const double radius = materials_.ball_radius;
    ShotWatch watch(frozen_balls(before, table_, radius));
    for (const auto& event : simulation.events) {
      const BallId first = event.after[0].id;
      (void)watch.see(
          {event.type, first, event.ball_count == 2 ? event.after[1].id : first, event.pocket});
    }
    return judged(before, call, watch, simulation.balls, table_, radius);
  }

  void compare(const Position& found, const rules::GameState& next) const {
    const Position expected = position_of(next);
    ASSERT_EQ(found.is_over, expected.is_over) << "turn " << next.turn;
    if (found.is_over) {
      EXPECT_EQ(found.winner, expected.winner);
      return;
    }
    if (next.turns_without_pocket == 0 && next.rack > 1) {
      return;  // a stalemate's new rack, which plans leave out
    }
    EXPECT_EQ(found.to_move, expected.to_move) << "turn " << next.turn;
    EXPECT_EQ(found.kind, expected.kind) << "turn " << next.turn;
    EXPECT_EQ(found.choice, expected.choice) << "turn " << next.turn;
    EXPECT_EQ(found.on_table, expected.on_table) << "turn " << next.turn;
    EXPECT_EQ(found.first_group, expected.first_group) << "turn " << next.turn;
    EXPECT_EQ(found.fouls_in_a_row, expected.fouls_in_a_row) << "turn " << next.turn;
    EXPECT_EQ(found.push_out_allowed, expected.push_out_allowed) << "turn " << next.turn;
    for (unsigned left = expected.on_table & ~1U; left != 0; left &= left - 1) {
      const auto n = static_cast<std::size_t>(std::countr_zero(left));
      const Point off = found.at[n] - expected.at[n];
      EXPECT_LT(dot(off, off), 1e-4) << "ball " << n << ", turn " << next.turn;
    }
  }

  physics::Table table_;
  physics::Materials materials_;
  client::GameInfo info_;
  rules::GameState state_;
};

struct Case {
  rules::RuleSet rules;
  std::string table;
};

class QuickReferee : public testing::TestWithParam<Case> {};

TEST_P(QuickReferee, RulesAsTheRefereeDoesInWholeGames) {
  std::size_t shots = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    JudgedTwice game(GetParam().rules, GetParam().table, seed);
    const client::GameInfo info{.game = std::to_string(seed)};
    RandomBot random(info, seed);
    GreedyBot greedy(info, {.seed = seed, .effort = 2'000});
    shots += seed % 2 == 0 ? game.play(random) : game.play(greedy);
    if (HasFailure()) {
      FAIL() << "in game " << seed;
    }
  }
  EXPECT_GT(shots, 100U);
}

INSTANTIATE_TEST_SUITE_P(Games, QuickReferee,
                         testing::Values(Case{rules::RuleSet::eight_ball, "olympiad"},
                                         Case{rules::RuleSet::eight_ball, "bar7"},
                                         Case{rules::RuleSet::nine_ball, "olympiad"}),
                         [](const auto& one) {
                           return std::string(one.param.rules == rules::RuleSet::eight_ball
                                                  ? "EightBall"
                                                  : "NineBall") +
                                  "On_" + one.param.table;
                         });

}  // namespace
}  // namespace poolhall::bots
