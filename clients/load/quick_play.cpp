#include "clients/load/quick_play.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "clients/bots/dice.hpp"

namespace poolhall::load {
namespace {

using rules::TurnKind;

// High enough for the stick to pass over the rail and most balls.
constexpr double elevation = 40;         // degrees
constexpr double break_heading = 90;     // degrees: towards the foot
constexpr int most_places = 200;         // tried for a cue ball in hand
constexpr unsigned streams_a_turn = 16;  // refused answers are not given again

double real_in(std::string_view line, std::string_view key, double otherwise) {
  const std::string quoted = '"' + std::string(key) + "\":";
  const std::size_t at = line.find(quoted);
  if (at == std::string_view::npos) {
    return otherwise;
  }
  double value = otherwise;
  std::from_chars(line.data() + at + quoted.size(), line.data() + line.size(), value);
  return value;
}

bool is_free(physics::Vec2<double> place, const SeenTurn& turn, double radius) {
  const double least = 2.01 * radius;
  return std::none_of(turn.taken.begin(), turn.taken.end(), [&](physics::Vec2<double> ball) {
    const double dx = ball.x - place.x;
    const double dy = ball.y - place.y;
    return dx * dx + dy * dy < least * least;
  });
}

physics::Vec2<double> free_place(const SeenTurn& turn, const Felt& felt, bots::Dice& dice) {
  const double r = felt.ball_radius;
  const double y_end = turn.kind == TurnKind::ball_in_hand ? felt.length - r : felt.head_string;
  physics::Vec2<double> place{};
  for (int i = 0; i < most_places; ++i) {
    place = {dice.uniform(r, felt.width - r), dice.uniform(r, y_end)};
    if (is_free(place, turn, r)) {
      break;
    }
  }
  return place;
}

rules::Call random_call(const SeenTurn& turn, bots::Dice& dice) {
  if (!turn.calls_pockets || turn.balls.empty()) {
    return {};
  }
  return {.kind = rules::Call::Kind::pocket,
          .ball = turn.balls[dice.below(turn.balls.size())],
          .pocket = static_cast<physics::PocketId>(dice.below(physics::pocket_count))};
}

}  // namespace

Felt felt_in(std::string_view line) {
  Felt felt;
  felt.width = real_in(line, "width", felt.width);
  felt.length = real_in(line, "length", felt.length);
  felt.head_string = real_in(line, "head_string", felt.head_string);
  felt.ball_radius = real_in(line, "ball_radius", felt.ball_radius);
  return felt;
}

protocol::Request quick_answer(const SeenTurn& turn, const Felt& felt, std::uint64_t seed) {
  bots::Dice dice(bots::Dice::key(seed, std::to_string(turn.game)),
                  turn.turn * streams_a_turn + turn.refusals);
  if (turn.kind == TurnKind::decision) {
    const std::size_t choice = turn.decisions.empty() ? 0 : dice.below(turn.decisions.size());
    return protocol::Decide{
        protocol::GameId{turn.game}, turn.turn,
        turn.decisions.empty() ? rules::Decision::accept : turn.decisions[choice]};
  }
  protocol::Shot shot;
  shot.game = protocol::GameId{turn.game};
  shot.turn = turn.turn;
  shot.shot_id = {'"' + std::to_string(turn.turn) + '.' + std::to_string(turn.refusals) + '"'};
  const bool is_break = turn.kind == TurnKind::break_shot;
  shot.params.theta = elevation;
  shot.params.phi = is_break ? break_heading + dice.uniform(-4, 4) : dice.uniform(0, 360);
  shot.params.v = is_break ? 7 : dice.uniform(1, 5);
  if (!is_break) {
    shot.call = random_call(turn, dice);
  }
  if (turn.kind != TurnKind::shot) {
    shot.cue_ball = free_place(turn, felt, dice);
  }
  return shot;
}

}  // namespace poolhall::load
