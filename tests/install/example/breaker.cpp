// Plays one game: `breaker HOST PORT`. It breaks, and then strikes whatever lies nearest.
#include <cmath>
#include <iostream>
#include <numbers>

#include "clients/cpp/client.hpp"

using namespace poolhall;

namespace {

double towards_nearest(const rules::GameState& state, const physics::Vec2<double>& cue_ball) {
  double nearest = 1e9;
  double heading = 0;
  for (const rules::BallPlace& ball : state.balls) {
    const auto way = ball.position - cue_ball;
    if (ball.id != physics::cue_ball && ball.where == rules::Whereabouts::on_table &&
        length(way) < nearest) {
      nearest = length(way);
      heading = std::atan2(way.y, way.x) * 180 / std::numbers::pi;
    }
  }
  return heading;
}

client::Move choose(const client::TurnView& turn) {
  if (turn.state.kind == rules::TurnKind::decision) {
    return turn.state.options.front();
  }
  client::Shot shot{{.b = 18, .theta = 40, .v = 6}, {}, {.kind = rules::Call::Kind::safety}};
  physics::Vec2<double> place = turn.state.balls[0].position;
  if (turn.state.kind != rules::TurnKind::shot) {
    place = {turn.info.table.width * (0.2 + 0.6 * std::fmod(0.37 * turn.state.turn, 1.0)),
             turn.info.table.head_string / 2};
    shot.cue_ball = place;
  }
  if (turn.state.kind == rules::TurnKind::break_shot) {
    shot.call = {};
  }
  shot.stroke.phi = towards_nearest(turn.state, place);
  return shot;
}

}  // namespace

int main(int argc, char** argv) {
  client::ClientOptions options;
  if (argc != 3) {
    std::cerr << "usage: breaker HOST PORT\n";
    return 2;
  }
  options.host = argv[1];
  options.port = argv[2];
  options.agent = {.name = "breaker", .challenges = {{.opponent = "house:random"}}, .games = 1};
  const client::End end = client::play(options, choose);
  std::cout << end.reason << '\n';
  return end.ending == client::Ending::finished ? 0 : 1;
}
