#include "server/app/replay_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocol/state_json.hpp"

namespace poolhall::app {
namespace {

std::string call_words(const rules::Call& call) {
  switch (call.kind) {
    case rules::Call::Kind::pocket:
      return fmt::format(", calls {} {}", physics::number(call.ball), physics::name(call.pocket));
    case rules::Call::Kind::safety:
      return ", safety";
    case rules::Call::Kind::push_out:
      return ", push-out";
    case rules::Call::Kind::none:
      break;
  }
  return "";
}

std::string shot_words(const storage::ShotPart& shot) {
  const protocol::ShotParams& p = shot.executed;
  std::string placed;
  if (shot.cue_ball)
    placed = fmt::format(", cue ball at {:.3f} {:.3f}", shot.cue_ball->x, shot.cue_ball->y);
  return fmt::format("shot{}{}: a {:.2f} b {:.2f} theta {:.2f} phi {:.2f} v {:.2f}{}",
                     call_words(shot.call), placed, p.a, p.b, p.theta, p.phi, p.v,
                     shot.moved ? " (moved to the nearest possible)" : "");
}

std::string ruling_words(const std::string& json) {
  const auto ruling = protocol::decode_ruling(json);
  if (!ruling)
    return " -> unreadable ruling";
  std::string words;
  for (const rules::PocketedBall& ball : ruling->pocketed)
    words += fmt::format("{} {} in {}", words.empty() ? "" : ",", physics::number(ball.ball),
                         physics::name(ball.pocket));
  for (const rules::FoulRecord& foul : ruling->fouls)
    words +=
        fmt::format("{} foul {} ({})", words.empty() ? "" : ",", rules::name(foul.code), foul.rule);
  return words.empty() ? " -> nothing" : " ->" + words;
}

std::string action_words(const storage::TurnRecord& turn) {
  if (turn.shot)
    return shot_words(*turn.shot);
  if (turn.decision)
    return "decides: " + std::string(rules::name(*turn.decision));
  return std::string(storage::name(turn.action));
}

char label(physics::BallId ball) {
  const unsigned number = physics::number(ball);
  if (number == 0)
    return 'o';
  return static_cast<char>(number < 10 ? '0' + number : 'A' + (number - 10));
}

}  // namespace

std::string turn_words(const storage::TurnRecord& turn, const std::array<std::string, 2>& players) {
  std::string words =
      fmt::format("turn {:>3}  {}  {}", turn.number, players[index(turn.seat)], action_words(turn));
  if (turn.ruling)
    words += ruling_words(*turn.ruling);
  if (!turn.result)
    return words;
  const std::string winner =
      turn.result->winner ? players[index(*turn.result->winner)] + " wins" : "nobody wins";
  return words + fmt::format("; {} ({})", winner, rules::name(turn.result->reason));
}

std::string table_text(const rules::GameState& state, const physics::Table& table) {
  constexpr int columns = 72;
  constexpr double shape = 2;  // a character is about twice as high as wide
  const int rows = static_cast<int>(std::lround(columns * table.width / table.length / shape));
  std::vector<std::string> lines(static_cast<std::size_t>(rows), std::string(columns, ' '));
  for (const rules::BallPlace& ball : state.balls) {
    if (ball.where != rules::Whereabouts::on_table)
      continue;
    const int column = static_cast<int>(ball.position.y / table.length * columns);
    const int row = static_cast<int>(ball.position.x / table.width * rows);
    lines[static_cast<std::size_t>(std::clamp(row, 0, rows - 1))]
         [static_cast<std::size_t>(std::clamp(column, 0, columns - 1))] = label(ball.id);
  }
  const std::string half(columns / 2 - 1, '-');
  const std::string rail = "O" + half + "O" + half + "-O\n";
  std::string text = rail;
  for (const std::string& line : lines)
    text += "|" + line + "|\n";
  return text + rail;
}

}  // namespace poolhall::app
