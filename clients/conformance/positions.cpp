#include "clients/conformance/positions.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace poolhall::conformance {
namespace {

using physics::BallId;
using physics::PocketId;
using rules::Decision;
using rules::RuleSet;
using rules::Seat;
using rules::TurnKind;
using rules::Whereabouts;

constexpr std::string_view a_turn = "A turn";
constexpr std::string_view a_state = "State";

// A position under construction: from all object balls pocketed, the cue ball in the kitchen.
class Layout {
 public:
  explicit Layout(RuleSet rules, std::string_view table = "olympiad") {
    plan_.rules = rules;
    plan_.table = table;
    plan_.materials = table == "olympiad" ? "olympiad" : "modern";
    table_ = physics::preset_table(table).value();
    radius_ = physics::preset_materials(plan_.materials)->ball_radius;
    state_ = rules::new_game({.rules = rules, .rack_seed = 20261130}, table_,
                             physics::preset_materials(plan_.materials).value());
    for (std::size_t i = 1; i < state_.balls.size(); ++i) {
      down(static_cast<unsigned>(i), static_cast<PocketId>(i % physics::pocket_count));
    }
    state_.kind = TurnKind::shot;
    state_.turn = 23;
  }

  // Places in shares of the table's width and length.
  Layout& put(unsigned ball, double x, double y) {
    return put_at(ball, {x * table_.width, y * table_.length});
  }
  Layout& put_at(unsigned ball, physics::Vec2<double> place) {
    state_.balls[ball] = {
        BallId{static_cast<std::uint8_t>(ball)}, Whereabouts::on_table, place, {}};
    return *this;
  }
  Layout& down(unsigned ball, PocketId pocket) {
    state_.balls[ball] = {
        BallId{static_cast<std::uint8_t>(ball)}, Whereabouts::pocketed, {}, pocket};
    return *this;
  }
  Layout& off(unsigned ball) {
    state_.balls[ball] = {BallId{static_cast<std::uint8_t>(ball)}, Whereabouts::off_table, {}, {}};
    return *this;
  }
  Layout& kind(TurnKind kind) {
    state_.kind = kind;
    return *this;
  }
  // The bot's group, in 8-ball.
  Layout& solids() {
    state_.memory = rules::EightBallMemory{rules::Group::solids};
    return *this;
  }
  Layout& decides(std::vector<Decision> options, Seat breaker) {
    state_.kind = TurnKind::decision;
    state_.options = std::move(options);
    state_.breaker = state_.settings.breaker = breaker;
    state_.turn = 2;
    return *this;
  }
  Layout& nine_ball_memory(rules::NineBallMemory memory) {
    state_.memory = memory;
    return *this;
  }
  // Some balls here and there, none near another or a rail.
  Layout& scattered(const std::vector<unsigned>& balls) {
    static constexpr std::array<std::pair<double, double>, 15> places{{{0.31, 0.62},
                                                                       {0.72, 0.71},
                                                                       {0.22, 0.84},
                                                                       {0.55, 0.55},
                                                                       {0.83, 0.42},
                                                                       {0.41, 0.36},
                                                                       {0.64, 0.88},
                                                                       {0.13, 0.47},
                                                                       {0.48, 0.76},
                                                                       {0.87, 0.58},
                                                                       {0.27, 0.29},
                                                                       {0.69, 0.31},
                                                                       {0.12, 0.7},
                                                                       {0.9, 0.81},
                                                                       {0.35, 0.93}}};
    for (const unsigned ball : balls) {
      put(ball, places[ball - 1].first, places[ball - 1].second);
    }
    return *this;
  }

  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] const physics::Table& table() const { return table_; }
  [[nodiscard]] rules::GameState& state() { return state_; }
  [[nodiscard]] GamePlan plan() {
    plan_.position = state_;
    return plan_;
  }
  [[nodiscard]] GamePlan& terms() { return plan_; }

 private:
  GamePlan plan_;
  physics::Table table_;
  double radius_ = 0;
  rules::GameState state_;
};

Layout eight(std::string_view table = "olympiad") {
  return Layout(RuleSet::eight_ball, table);
}
Layout nine() {
  return Layout(RuleSet::nine_ball);
}

// Solids 1, 2 and 5 against stripes 10, 12 and 14, and the 8.
Layout middle_game() {
  return eight().scattered({1, 2, 5, 8, 10, 12, 14}).put(0, 0.5, 0.15).solids();
}

GamePlan in_hand_anywhere() {
  return middle_game().kind(TurnKind::ball_in_hand).plan();
}
GamePlan in_hand_in_kitchen() {
  return middle_game().kind(TurnKind::ball_in_hand_behind_head_string).plan();
}
GamePlan in_hand_crowded_kitchen() {
  Layout layout = eight().scattered({8}).solids();
  constexpr std::array<unsigned, 11> balls{1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const std::size_t row = i / 5;
    layout.put(balls[i], 0.12 + 0.19 * static_cast<double>(i % 5),
               0.04 + 0.08 * static_cast<double>(row));
  }
  layout.put(7, 0.6, 0.6);  // outside, so that there is something to play at
  return layout.put(0, 0.5, 0.9).kind(TurnKind::ball_in_hand_behind_head_string).plan();
}
GamePlan cue_ball_down() {
  return middle_game().down(0, PocketId::side_left).kind(TurnKind::ball_in_hand).plan();
}
GamePlan cue_ball_off() {
  return middle_game().off(0).kind(TurnKind::ball_in_hand).plan();
}
GamePlan object_ball_off() {
  return middle_game().off(5).plan();
}
GamePlan only_the_eight() {
  return eight().put(8, 0.3, 0.7).put(0, 0.62, 0.25).solids().plan();
}
GamePlan eight_and_opponents() {
  return eight().scattered({8, 9, 11, 13}).put(0, 0.62, 0.15).solids().plan();
}
GamePlan frozen_to_rail() {
  Layout layout = middle_game();
  return layout.put_at(0, {layout.radius(), 0.31 * layout.table().length}).plan();
}
GamePlan in_the_corner() {
  Layout layout = middle_game();
  return layout.put_at(0, {0.105, layout.radius()}).plan();
}
GamePlan frozen_to_balls() {
  Layout layout = middle_game();
  const double apart = 2 * layout.radius();
  const physics::Vec2<double> cue{0.5 * layout.table().width, 0.2 * layout.table().length};
  layout.put_at(0, cue);
  layout.put_at(10, {cue.x + apart, cue.y});
  return layout.put_at(2, {cue.x - apart, cue.y}).plan();
}
GamePlan snookered() {
  Layout layout = eight().solids();
  const physics::Vec2<double> cue{0.5 * layout.table().width, 0.5 * layout.table().length};
  layout.put_at(0, cue);
  constexpr std::array<unsigned, 6> ring{9, 10, 11, 12, 13, 14};
  constexpr std::array<physics::Vec2<double>, 6> around{
      {{1, 0}, {0.5, 0.866}, {-0.5, 0.866}, {-1, 0}, {-0.5, -0.866}, {0.5, -0.866}}};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    layout.put_at(ring[i], {cue.x + 0.09 * around[i].x, cue.y + 0.09 * around[i].y});
  }
  return layout.put(1, 0.2, 0.9).put(8, 0.8, 0.1).plan();
}
// A ball falls where x + y = corner / sqrt(2) + R in a corner and x = R in a side pocket: these two
// are a hair's breadth outside.
GamePlan in_the_jaws() {
  Layout layout = middle_game();
  const double corner = 0.0535;
  const double side = layout.table().width - 1.01 * layout.radius();
  layout.put_at(1, {corner, corner});
  return layout.put_at(10, {side, layout.table().length / 2 + 0.01}).plan();
}
GamePlan every_ball_but_one() {
  return eight()
      .scattered({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14})
      .put(0, 0.5, 0.15)
      .plan();
}
GamePlan whole_numbers() {
  Layout layout = middle_game();
  return layout.put_at(0, {1, 1}).put_at(2, {0.5, 2}).put_at(10, {1e-1, 1}).plan();
}
GamePlan second_rack() {
  Layout layout = eight();
  rules::GameState state =
      rules::new_game({.rules = RuleSet::eight_ball, .rack_seed = 7}, layout.table(),
                      physics::preset_materials("olympiad").value());
  state.turn = 61;
  state.rack = 3;
  state.stalemates = 1;
  layout.state() = state;
  return layout.plan();
}
GamePlan lost_break() {
  Layout layout = eight();
  rules::GameState state =
      rules::new_game({.rules = RuleSet::eight_ball, .breaker = Seat::second, .rack_seed = 7},
                      layout.table(), physics::preset_materials("olympiad").value());
  state.turn = 2;
  state.breaker = state.to_move = Seat::first;
  layout.state() = state;
  return layout.plan();
}
GamePlan other_table() {
  return eight("wpa9").scattered({1, 2, 5, 8, 10, 12, 14}).put(0, 0.5, 0.15).solids().plan();
}
GamePlan hidden_noise() {
  Layout layout = middle_game();
  layout.terms().noise = std::nullopt;
  return layout.plan();
}
GamePlan capped_turn() {
  Layout layout = middle_game();
  layout.terms().clock = {.game_ms = 600'000, .increment_ms = 500, .shot_ms = 30'000};
  return layout.plan();
}

// The 8-ball break and what is decided after it.
Layout after_break() {
  return eight().scattered({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}).put(0, 0.5, 0.12);
}
GamePlan illegal_break() {
  return after_break()
      .decides({Decision::accept, Decision::rerack_chooser_breaks, Decision::rerack_breaker_breaks},
               Seat::second)
      .plan();
}
GamePlan foul_on_break() {
  return after_break()
      .decides({Decision::accept, Decision::accept_ball_in_hand}, Seat::second)
      .plan();
}
GamePlan eight_on_break() {
  return after_break()
      .down(8, PocketId::foot_left)
      .decides({Decision::spot_eight, Decision::rerack_breaker_breaks}, Seat::first)
      .plan();
}
GamePlan eight_on_foul_break() {
  return after_break()
      .down(8, PocketId::foot_left)
      .down(0, PocketId::side_right)
      .decides({Decision::spot_eight, Decision::rerack_chooser_breaks}, Seat::second)
      .plan();
}

GamePlan nine_break() {
  Layout layout = nine();
  layout.state() = rules::new_game({.rules = RuleSet::nine_ball, .rack_seed = 7}, layout.table(),
                                   physics::preset_materials("olympiad").value());
  return layout.plan();
}
GamePlan push_out_offered() {
  Layout layout = nine().scattered({1, 2, 3, 4, 5, 6, 7, 9}).put(0, 0.5, 0.12);
  layout.state().turn = 2;
  return layout.nine_ball_memory({.push_out_allowed = true}).plan();
}
GamePlan after_push_out() {
  return nine()
      .scattered({1, 2, 3, 4, 5, 6, 7, 9})
      .put(0, 0.5, 0.12)
      .decides({Decision::shoot, Decision::pass_back}, Seat::second)
      .plan();
}
GamePlan nine_in_hand() {
  return nine()
      .scattered({4, 6, 9})
      .down(0, PocketId::head_left)
      .kind(TurnKind::ball_in_hand)
      .nine_ball_memory({.fouls_in_a_row = {2, 1}})
      .plan();
}
GamePlan only_the_nine() {
  return nine().put(9, 0.3, 0.7).put(0, 0.6, 0.2).plan();
}

// The position beyond which every answer of the bot is watched by the standing checks too.
const std::array<Position, 30> all{{
    {{"ball-in-hand", "an answer with the cue ball in hand anywhere", a_turn}, in_hand_anywhere},
    {{"ball-in-hand-kitchen", "an answer with the cue ball in hand behind the head string", a_turn},
     in_hand_in_kitchen},
    {{"ball-in-hand-crowded", "an answer with eleven balls lying behind the head string", a_turn},
     in_hand_crowded_kitchen},
    {{"cue-ball-pocketed", "an answer while the cue ball in hand lies in a pocket", a_state},
     cue_ball_down},
    {{"cue-ball-off-table", "an answer while the cue ball in hand is off the table", a_state},
     cue_ball_off},
    {{"object-ball-off-table", "an answer while a ball is {id, off_table}", a_state},
     object_ball_off},
    {{"only-the-8", "an answer with only the 8 left", a_turn}, only_the_eight},
    {{"own-group-cleared", "an answer with the own group cleared and the opponent's not", a_turn},
     eight_and_opponents},
    {{"frozen-to-rail", "an answer with the cue ball touching a rail", a_turn}, frozen_to_rail},
    {{"in-the-corner", "an answer with the cue ball on the rail beside a pocket", a_turn},
     in_the_corner},
    {{"frozen-to-balls", "an answer with balls touching the cue ball on both sides", a_turn},
     frozen_to_balls},
    {{"snookered", "an answer with the cue ball behind a ring of the opponent's balls", a_turn},
     snookered},
    {{"balls-in-jaws", "an answer with balls hanging in the mouths of pockets", a_state},
     in_the_jaws},
    {{"open-table", "an answer with an open table and fourteen balls", a_turn}, every_ball_but_one},
    {{"whole-numbers", "an answer to coordinates without a decimal point", "Lines"}, whole_numbers},
    {{"third-rack", "a break in a game's third rack, after a stalemate", a_turn}, second_rack},
    {{"passed-break", "a break that the opponent has lost", a_turn}, lost_break},
    {{"other-table", "an answer on another table, with jaws, and other materials", a_state},
     other_table},
    {{"hidden-noise", "an answer where noise is \"hidden\"", "Notifications"}, hidden_noise},
    {{"capped-turn", "an answer under an increment and a cap on each turn", a_turn}, capped_turn},
    {{"decide-illegal-break", "a decision after an illegal break", a_turn}, illegal_break},
    {{"decide-foul-on-break", "a decision after a foul on the break", a_turn}, foul_on_break},
    {{"decide-8-on-break", "a decision after the own break with the 8 pocketed", a_turn},
     eight_on_break},
    {{"decide-8-on-foul-break", "a decision after a foul break with the 8 pocketed", a_turn},
     eight_on_foul_break},
    {{"nine-ball-break", "a break in nine-ball", a_turn}, nine_break},
    {{"nine-ball-push-out", "an answer where a push-out may be called", a_turn}, push_out_offered},
    {{"nine-ball-decide", "a decision after the opponent's push-out", a_turn}, after_push_out},
    {{"nine-ball-in-hand", "an answer with the cue ball in hand after two fouls", a_turn},
     nine_in_hand},
    {{"only-the-9", "an answer with only the 9 left", a_turn}, only_the_nine},
    {{"8-ball-break", "a break in 8-ball", a_turn}, [] { return GamePlan{}; }},
}};

}  // namespace

std::span<const Position> positions() {
  return all;
}

}  // namespace poolhall::conformance
