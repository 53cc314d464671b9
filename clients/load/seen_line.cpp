#include "clients/load/seen_line.hpp"

#include <array>
#include <charconv>
#include <string>
#include <utility>

namespace poolhall::load {
namespace {

constexpr std::string_view reply_opening = R"({"jsonrpc":"2.0","id":)";
constexpr std::string_view push_opening = R"({"jsonrpc":"2.0","method":")";

constexpr std::array<std::pair<std::string_view, LineKind>, 8> methods{{
    {"game.turn", LineKind::turn},
    {"challenge.offer", LineKind::offer},
    {"game.start", LineKind::start},
    {"game.state", LineKind::state},
    {"game.over", LineKind::game_over},
    {"match.over", LineKind::match_over},
    {"lag", LineKind::lag},
    {"superseded", LineKind::superseded},
}};

// What follows `"key":`, up to the end of the line.
std::string_view after(std::string_view line, std::string_view key) {
  const std::string quoted = '"' + std::string(key) + "\":";
  const std::size_t at = line.find(quoted);
  return at == std::string_view::npos ? std::string_view() : line.substr(at + quoted.size());
}

template <class Number>
std::optional<Number> leading(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

// The array of strings that `text` begins with, each given to `take`.
template <class Take>
void each_word(std::string_view text, Take take) {
  for (text = text.substr(0, text.find(']'));;) {
    const std::size_t open = text.find('"');
    if (open == std::string_view::npos) {
      return;
    }
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string_view::npos) {
      return;
    }
    take(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
}

std::vector<rules::BallId> ball_ids(std::string_view array) {
  std::vector<rules::BallId> ids;
  for (array = array.substr(0, array.find(']')); !array.empty(); array.remove_prefix(1)) {
    if (array.front() >= '0' && array.front() <= '9') {
      const auto id = leading<unsigned>(array).value_or(0);
      ids.push_back(static_cast<rules::BallId>(id));
      array.remove_prefix(std::min(array.find(','), array.size() - 1));
    }
  }
  return ids;
}

// The object balls on the table, out of the state's `"balls":[{"id":0,"x":..,"y":..},...`.
std::vector<physics::Vec2<double>> places(std::string_view state) {
  std::vector<physics::Vec2<double>> found;
  std::string_view balls = after(state, "balls");
  for (balls = balls.substr(0, balls.find(']')); !balls.empty();) {
    const std::string_view ball = balls.substr(0, balls.find('}'));
    const auto x = leading<double>(after(ball, "x"));
    const auto y = leading<double>(after(ball, "y"));
    if (x && y && integer_in(ball, "id") != 0) {
      found.push_back({*x, *y});
    }
    balls.remove_prefix(std::min(ball.size() + 1, balls.size()));
  }
  return found;
}

void read_legal(std::string_view line, SeenTurn& turn) {
  const std::string_view legal = after(line, "legal");
  if (turn.kind == rules::TurnKind::decision) {
    each_word(after(legal, "decisions"), [&](std::string_view word) {
      if (const auto decision = rules::decision(word)) {
        turn.decisions.push_back(*decision);
      }
    });
    return;
  }
  turn.balls = ball_ids(after(legal, "balls"));
  each_word(after(legal, "calls"), [&](std::string_view word) {
    turn.calls_pockets = turn.calls_pockets || word == "pocket";
  });
}

}  // namespace

std::optional<std::int64_t> integer_in(std::string_view line, std::string_view key) {
  return leading<std::int64_t>(after(line, key));
}

std::string_view word_in(std::string_view line, std::string_view key) {
  const std::string_view rest = after(line, key);
  if (!rest.starts_with('"')) {
    return {};
  }
  return rest.substr(1, rest.find('"', 1) - 1);
}

std::string_view error_code_in(std::string_view line) {
  const std::size_t data = line.find(R"("data":)");
  return data == std::string_view::npos ? "unknown" : word_in(line.substr(data), "code");
}

SeenLine look_at(std::string_view line) {
  if (line.starts_with(reply_opening)) {
    line.remove_prefix(reply_opening.size());
    SeenLine seen{LineKind::reply, leading<std::int64_t>(line).value_or(0)};
    if (line.substr(0, 32).find(R"(,"error":)") != std::string_view::npos) {
      seen.kind = LineKind::error;
    }
    return seen;
  }
  if (line.starts_with(push_opening)) {
    line.remove_prefix(push_opening.size());
    const std::string_view method = line.substr(0, line.find('"'));
    for (const auto& [name, kind] : methods) {
      if (name == method) {
        return {kind, 0};
      }
    }
  }
  return {};
}

std::optional<SeenTurn> turn_in(std::string_view line) {
  const auto game = integer_in(line, "game");
  const auto number = integer_in(line, "turn");
  const auto kind = rules::turn_kind(word_in(line, "kind"));
  const std::size_t refusals = line.rfind(R"("refusals":)");
  if (!game || !number || !kind || refusals == std::string_view::npos) {
    return std::nullopt;
  }
  SeenTurn turn;
  turn.game = *game;
  turn.turn = static_cast<std::uint32_t>(*number);
  turn.kind = *kind;
  turn.refusals = leading<std::uint32_t>(line.substr(refusals + 11)).value_or(0);
  read_legal(line, turn);
  if (turn.kind != rules::TurnKind::shot && turn.kind != rules::TurnKind::decision) {
    turn.taken = places(after(line, "state"));
  }
  return turn;
}

}  // namespace poolhall::load
