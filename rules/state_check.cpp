// What makes settings and states impossible. Where balls may lie is the physics' answer.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "physics/simulator.hpp"
#include "rules/game_rules.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules {
namespace {

constexpr std::uint64_t seed_limit = std::uint64_t{1} << 53;
constexpr double largest_gap = 0.005;     // m
constexpr double largest_jitter = 0.002;  // m

tl::unexpected<Refusal> impossible(std::string field, std::string reason) {
  return tl::unexpected(Refusal{RefusalCode::bad_state, std::move(field), std::move(reason)});
}

// Index into state.balls of the n-th ball on the table.
std::size_t index_of_nth(const GameState& state, std::size_t n) {
  for (std::size_t i = 0; i < state.balls.size(); ++i) {
    if (state.balls[i].where == Whereabouts::on_table && n-- == 0) {
      return i;
    }
  }
  return state.balls.size();
}

// "/balls/3/x" of the scene, which has only the balls on the table, as a field of the state.
std::string state_field(const std::string& scene_field, const GameState& state) {
  constexpr std::string_view prefix = "/balls/";
  if (!scene_field.starts_with(prefix)) {
    return scene_field;
  }
  std::size_t n = 0;
  const char* const begin = scene_field.data() + prefix.size();
  const char* const end = scene_field.data() + scene_field.size();
  const auto [rest, error] = std::from_chars(begin, end, n);
  if (error != std::errc{}) {
    return scene_field;
  }
  return std::string(prefix) + std::to_string(index_of_nth(state, n)) + std::string(rest, end);
}

Expected<void> check_places(const GameState& state, const physics::Table& table,
                            const physics::Materials& materials) {
  const physics::Scene<double> scene{table, materials, balls_on_table(state), {}};
  if (const auto possible = physics::check_scene(scene); !possible) {
    return impossible(state_field(possible.error().field, state), possible.error().reason);
  }
  return {};
}

std::string ball_field(std::size_t i) {
  return "/balls/" + std::to_string(i);
}

Expected<void> check_ball(const BallPlace& place, std::size_t i) {
  if (physics::number(place.id) != i) {
    return impossible(ball_field(i) + "/id", "ball " + std::to_string(physics::number(place.id)) +
                                                 " where ball " + std::to_string(i) +
                                                 " was expected: every ball of the game once, "
                                                 "ascending");
  }
  if (place.where == Whereabouts::on_table &&
      !(std::isfinite(place.position.x) && std::isfinite(place.position.y))) {
    return impossible(ball_field(i), "the place of ball " + std::to_string(i) + " is not finite");
  }
  if (place.where == Whereabouts::pocketed &&
      static_cast<std::size_t>(place.pocket) >= physics::pocket_count) {
    return impossible(ball_field(i) + "/pocket", "not a pocket of this table");
  }
  if (static_cast<unsigned>(place.where) > static_cast<unsigned>(Whereabouts::off_table)) {
    return impossible(ball_field(i), "neither on the table nor pocketed nor off the table");
  }
  return {};
}

Expected<void> check_balls(const GameState& state) {
  const std::size_t expected = game_rules(state.settings.rules).object_balls + 1;
  if (state.balls.size() != expected) {
    return impossible("/balls", std::to_string(state.balls.size()) + " balls, but " +
                                    std::string(name(state.settings.rules)) + " has " +
                                    std::to_string(expected) + " with the cue ball");
  }
  for (std::size_t i = 0; i < state.balls.size(); ++i) {
    if (auto ball = check_ball(state.balls[i], i); !ball) {
      return ball;
    }
  }
  return {};
}

Expected<void> check_counters(const GameState& state) {
  if (state.turn == 0 || state.rack == 0) {
    return impossible(state.turn == 0 ? "/turn" : "/rack", "0, but counting begins with 1");
  }
  if (state.turns_without_pocket >= stalemate_turns && !state.result) {
    return impossible("/turns_without_pocket",
                      std::to_string(state.turns_without_pocket) + " turns without a ball " +
                          "pocketed, but " + std::to_string(stalemate_turns) + " make a stalemate");
  }
  if (state.stalemates > 1 && !state.result) {
    return impossible("/stalemates", std::to_string(state.stalemates) +
                                         " stalemates, but the second one ends the game");
  }
  return {};
}

// Kind of turn, balls and options of a game that goes on.
Expected<void> check_turn(const GameState& state) {
  if (name(state.kind).empty()) {
    return impossible("/kind", "not a kind of turn");
  }
  if ((state.kind == TurnKind::decision) == state.options.empty()) {
    return impossible("/options", state.options.empty()
                                      ? "a decision needs options"
                                      : "options are for a turn of kind decision only");
  }
  if (state.kind == TurnKind::shot && !on_table(state, physics::cue_ball)) {
    return impossible("/balls/0", "the cue ball is not on the table, but the turn is a shot");
  }
  if (state.kind != TurnKind::break_shot) {
    return {};
  }
  if (state.to_move != state.breaker) {
    return impossible("/to_move", "only the breaker breaks");
  }
  for (std::size_t i = 1; i < state.balls.size(); ++i) {
    if (state.balls[i].where != Whereabouts::on_table) {
      return impossible(ball_field(i),
                        "ball " + std::to_string(i) + " is down, but the rack is not broken yet");
    }
  }
  return {};
}

Expected<void> check_setting_numbers(const GameSettings& settings) {
  if (settings.rack_seed >= seed_limit) {
    return impossible("/rack_seed",
                      "got " + std::to_string(settings.rack_seed) + ", expected below 2^53");
  }
  if (!(settings.rack_gap >= 0 && settings.rack_gap <= largest_gap)) {
    return impossible("/rack_gap",
                      "got " + std::to_string(settings.rack_gap) + ", expected 0 to 0.005 m");
  }
  if (!(settings.rack_jitter >= 0 && settings.rack_jitter <= largest_jitter)) {
    return impossible("/rack_jitter",
                      "got " + std::to_string(settings.rack_jitter) + ", expected 0 to 0.002 m");
  }
  return {};
}

bool is_seat(Seat seat) {
  return seat == Seat::first || seat == Seat::second;
}

Expected<void> check_enumerators(const GameState& state) {
  if (name(state.settings.rules).empty()) {
    return impossible("/rules", "not a rule set");
  }
  if (auto numbers = check_setting_numbers(state.settings); !numbers) {
    return impossible("/settings" + numbers.error().field, numbers.error().reason);
  }
  if (!is_seat(state.to_move) || !is_seat(state.breaker)) {
    return impossible(is_seat(state.breaker) ? "/to_move" : "/breaker", "not a seat");
  }
  if (state.result && (name(state.result->reason).empty() ||
                       (state.result->winner && !is_seat(*state.result->winner)))) {
    return impossible("/result", "not a result");
  }
  return {};
}

}  // namespace

Expected<void> check_settings(const GameSettings& settings, const physics::Table& table,
                              const physics::Materials& materials) {
  if (auto numbers = check_setting_numbers(settings); !numbers) {
    return numbers;
  }
  if (std::holds_alternative<physics::NoPockets>(table.pockets)) {
    return impossible("/table", "a game needs a table with pockets");
  }
  auto places = check_places(new_game(settings, table, materials), table, materials);
  if (!places && places.error().field.starts_with("/balls")) {
    return impossible("/table", "the rack does not fit: " + places.error().reason);
  }
  return places;
}

Expected<void> check_state(const GameState& state, const physics::Table& table,
                           const physics::Materials& materials) {
  if (auto checked = check_enumerators(state); !checked) {
    return checked;
  }
  if (auto balls = check_balls(state); !balls) {
    return balls;
  }
  if (auto counters = check_counters(state); !counters) {
    return counters;
  }
  if (!state.result) {
    if (auto turn = check_turn(state); !turn) {
      return turn;
    }
  }
  if (auto game = game_rules(state.settings.rules).check(state); !game) {
    return game;
  }
  return check_places(state, table, materials);
}

physics::BallSet<double> balls_on_table(const GameState& state) {
  physics::BallSet<double> balls;
  for (const BallPlace& place : state.balls) {
    if (place.where == Whereabouts::on_table && balls.count < physics::max_balls) {
      physics::Ball<double> ball;
      ball.id = place.id;
      ball.position = place.position;
      balls[balls.count++] = ball;
    }
  }
  return balls;
}

}  // namespace poolhall::rules
