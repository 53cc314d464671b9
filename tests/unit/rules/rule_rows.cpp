#include "rule_rows.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "rules/nine_ball.hpp"

namespace poolhall::rules::test {
namespace {

using physics::Ball;
using physics::Event;
using physics::EventLog;
using physics::EventType;
using physics::MotionState;
using physics::RailId;
using physics::Vec2;

[[noreturn]] void unreadable(const std::string& what) {
  throw std::invalid_argument("a row cannot be read: " + what);
}

BallId ball_of(const std::string& text) {
  return BallId(static_cast<std::uint8_t>(std::stoul(text)));
}

Vec2<double> place_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    unreadable(text);
  }
  return {std::stod(text.substr(0, comma)), std::stod(text.substr(comma + 1))};
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

Vec2<double> standard_place(unsigned n) {
  if (n == 0) {
    return {0.558, 0.8};
  }
  const unsigned row = (n - 1) / 5;
  return {0.158 + 0.2 * ((n - 1) % 5), 1.0 + 0.25 * row};
}

GameState standard_state(RuleSet rules) {
  GameState state = new_game({.rules = rules, .rack_seed = 1}, row_table(), row_materials());
  state.turn = 10;
  return state;
}

void put_down(GameState& state, BallId ball, Whereabouts where) {
  state.balls.at(physics::number(ball)) = {ball, where, {}, PocketId::side_left};
}

// Words of a state that take a value or several.
class StateReader {
 public:
  explicit StateReader(const std::string& text) : words_(text) {
    std::string game;
    std::string kind;
    words_ >> game >> kind;
    state_ = standard_state(game == "8" ? RuleSet::eight_ball : RuleSet::nine_ball);
    state_.kind = turn_kind(kind).value();
    if (state_.kind != TurnKind::break_shot) {
      for (BallPlace& place : state_.balls) {
        place.position = standard_place(physics::number(place.id));
      }
    }
    std::string word;
    while (words_ >> word) {
      take(word);
    }
  }

  [[nodiscard]] GameState state() const { return state_; }

 private:
  void take(const std::string& word) {
    if (is_number(word)) {
      put_down(state_, ball_of(word), down_as_);
    } else if (word == "down" || word == "off") {
      down_as_ = word == "down" ? Whereabouts::pocketed : Whereabouts::off_table;
    } else if (word == "second" || word == "first") {
      state_.to_move = word == "first" ? Seat::first : Seat::second;
      if (state_.kind == TurnKind::break_shot) {
        state_.breaker = state_.to_move;
      }
    } else if (group(word)) {
      std::get<EightBallMemory>(state_.memory).first_seat_group = group(word);
    } else {
      take_value(word);
    }
  }

  void take_value(const std::string& word) {
    std::string value;
    if (word == "push") {
      std::get<NineBallMemory>(state_.memory).push_out_allowed = true;
    } else if (word == "at") {
      std::string place;
      words_ >> value >> place;
      state_.balls.at(physics::number(ball_of(value))).position = place_of(place);
    } else if (word == "since") {
      words_ >> state_.turns_without_pocket;
    } else if (word == "stalemates") {
      words_ >> state_.stalemates;
    } else if (word == "fouls") {
      words_ >> value;
      std::get<NineBallMemory>(state_.memory).fouls_in_a_row[0] =
          static_cast<std::uint8_t>(std::stoul(value));
      words_ >> value;
      std::get<NineBallMemory>(state_.memory).fouls_in_a_row[1] =
          static_cast<std::uint8_t>(std::stoul(value));
    } else if (decision(word)) {
      state_.options.push_back(*decision(word));
    } else {
      unreadable(word);
    }
  }

  std::istringstream words_;
  GameState state_;
  Whereabouts down_as_ = Whereabouts::pocketed;
};

Vec2<double> at_rail(RailId rail, const Vec2<double>& from) {
  const double radius = row_materials().ball_radius;
  switch (rail) {
    case RailId::head:
      return {from.x, radius};
    case RailId::foot:
      return {from.x, row_table().length - radius};
    case RailId::head_left:
    case RailId::foot_left:
      return {radius, from.y};
    default:
      return {row_table().width - radius, from.y};
  }
}

Vec2<double> pocket_place(PocketId pocket) {
  const auto n = static_cast<unsigned>(pocket);
  const unsigned row = n / 2;
  return {n % 2 == 0 ? 0.01 : row_table().width - 0.01,
          0.01 + (row_table().length - 0.02) * 0.5 * row};
}

// Writes a log in which every ball rolls from one of its events to the next.
class LogWriter {
 public:
  explicit LogWriter(const GameState& ready) {
    for (const BallPlace& place : ready.balls) {
      position_.at(physics::number(place.id)) = place.position;
    }
    write(EventType::cue_strike, {{physics::cue_ball, position_[0]}});
  }

  void take(std::string token) {
    t_ += step;
    if (token.front() == '&') {
      t_ -= step;
      token = token.substr(1);
      std::size_t read = 0;
      const double delay = std::stod(token, &read);
      if (token[read] == ':') {
        t_ += delay;
        token = token.substr(read + 1);
      }
    }
    const std::size_t sign = token.find_first_of(">-@!~");
    if (sign == std::string::npos) {
      unreadable(token);
    }
    happen(ball_of(token.substr(0, sign)), token[sign], token.substr(sign + 1));
  }

  [[nodiscard]] EventLog<double> log() const { return log_; }

 private:
  struct Part {
    BallId ball;
    Vec2<double> place;
  };

  void happen(BallId ball, char sign, const std::string& rest) {
    switch (sign) {
      case '>':
        return collide(ball, rest);
      case '-': {
        const RailId rail = physics::rail_id(rest).value();
        write(EventType::rail_collision, {{ball, free_at(rail, ball)}}).rail = rail;
        return;
      }
      case '@': {
        const PocketId pocket = physics::pocket_id(rest).value();
        Event<double>& event = write(EventType::pocketed, {{ball, pocket_place(pocket)}});
        event.pocket = pocket;
        event.after[0].state = MotionState::pocketed;
        event.after[0].pocket = event.pocket;
        return;
      }
      case '!':
        write(EventType::off_table, {{ball, {-0.5, 1}}});
        return;
      default:
        write(EventType::transition, {{ball, place_of(rest)}});
    }
  }

  // At the rail straight ahead, or beside a ball that is there already.
  [[nodiscard]] Vec2<double> free_at(RailId rail, BallId ball) const {
    Vec2<double> place = at_rail(rail, position_.at(physics::number(ball)));
    const auto taken = [&] {
      for (unsigned n = 0; n < position_.size(); ++n) {
        const Vec2<double> way = position_[n] - place;
        if (n != physics::number(ball) && dot(way, way) < 0.059 * 0.059) {
          return true;
        }
      }
      return false;
    };
    while (taken()) {
      const bool across = rail == RailId::head || rail == RailId::foot;
      place = place + (across ? Vec2<double>{0.06, 0} : Vec2<double>{0, 0.06});
    }
    return place;
  }

  void collide(BallId ball, const std::string& rest) {
    const std::size_t colon = rest.find(':');
    const BallId struck = ball_of(rest.substr(0, colon));
    const Vec2<double> target = position_.at(physics::number(struck));
    Vec2<double> place;
    if (colon != std::string::npos) {
      place = place_of(rest.substr(colon + 1));
    } else {
      const Vec2<double> way = position_.at(physics::number(ball)) - target;
      place = target + (2 * row_materials().ball_radius / std::sqrt(dot(way, way))) * way;
    }
    write(EventType::ball_collision, {{ball, place}, {struck, target}});
  }

  Event<double>& write(EventType type, const std::vector<Part>& parts) {
    Event<double> event;
    event.t = t_;
    event.type = type;
    event.ball_count = static_cast<std::uint8_t>(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      roll_to(parts[k].ball, parts[k].place);
      event.after[k].id = parts[k].ball;
      event.after[k].position = parts[k].place;
      position_.at(physics::number(parts[k].ball)) = parts[k].place;
    }
    log_.push_back(event);
    return log_.back();
  }

  // Lets the ball's last event send it so that it is at `place` now.
  void roll_to(BallId id, const Vec2<double>& place) {
    const Vec2<double> way = place - position_.at(physics::number(id));
    const double distance = std::sqrt(dot(way, way));
    for (std::size_t i = log_.size(); i-- > 0 && distance > 1e-12;) {
      if (!log_[i].involves(id)) {
        continue;
      }
      Ball<double>& ball = log_[i].after[log_[i].after[0].id == id ? 0 : 1];
      const double time = t_ - log_[i].t;
      const double slowing = row_materials().mu_roll * row_materials().gravity;
      const double speed = distance / time + 0.5 * slowing * time;
      ball.state = MotionState::rolling;
      ball.velocity = (speed / distance) * way;
      return;
    }
  }

  // s between two events: short, so that friction hardly bends a way.
  static constexpr double step = 0.01;

  double t_ = 0;
  std::array<Vec2<double>, physics::max_balls> position_{};
  EventLog<double> log_;
};

std::string seat_word(Seat seat) {
  return seat == Seat::first ? "first" : "second";
}

std::string refused(const Refusal& refusal) {
  return "refused " + std::string(name(refusal.code)) + " " + refusal.field;
}

std::string listed(const std::vector<BallId>& balls) {
  std::string text;
  for (const BallId ball : balls) {
    text += (text.empty() ? "" : " ") + std::to_string(physics::number(ball));
  }
  return text;
}

std::string calls(const GameState& state) {
  std::string text;
  for (const Call::Kind kind : legal_calls(state)) {
    constexpr const char* words[] = {"none", "pocket", "safety", "push_out"};
    text += (text.empty() ? "" : " ") + std::string(words[static_cast<std::size_t>(kind)]);
  }
  return text + ": " + listed(callable_balls(state));
}

// ", 8 at 1.67700" where a ball that was down or went down lies on the table again.
std::string spotted_words(const GameState& before, const Ruling& ruling) {
  const GameState& after = ruling.next;
  if (after.kind == TurnKind::break_shot) {
    return "";
  }
  std::string text;
  for (const BallPlace& place : after.balls) {
    bool was_gone = find_ball(before, place.id)->where != Whereabouts::on_table;
    for (const PocketedBall& down : ruling.pocketed) {
      was_gone = was_gone || down.ball == place.id;
    }
    for (const BallId off : ruling.driven_off) {
      was_gone = was_gone || off == place.id;
    }
    if (was_gone && place.where == Whereabouts::on_table && place.id != physics::cue_ball) {
      std::array<char, 32> y{};
      std::snprintf(y.data(), y.size(), "%.5f", place.position.y);
      text += ", " + std::to_string(physics::number(place.id)) + " at " + y.data();
    }
  }
  return text;
}

// `text`, or why the state is impossible.
std::string checked(const GameState& state, const std::string& text) {
  const auto possible = check_state(state, row_table(), row_materials());
  return possible ? text : refused(possible.error());
}

std::string shot_outcome(const GameState& state, std::istringstream& words, std::string word) {
  std::optional<Vec2<double>> cue_ball;
  if (word == "at") {
    words >> word;
    cue_ball = place_of(word);
    words >> word;
  }
  Call call;
  if (word == "call") {
    call.kind = Call::Kind::pocket;
    words >> word;
    call.ball = ball_of(word);
    words >> word;
    call.pocket = physics::pocket_id(word.substr(0, word.size() - 1)).value();
  } else {
    call.kind = word == "safety:" ? Call::Kind::safety
                : word == "push:" ? Call::Kind::push_out
                                  : Call::Kind::none;
  }
  const Expected<GameState> ready =
      prepare_shot(state, call, cue_ball, row_table(), row_materials());
  if (!ready) {
    return refused(ready.error());
  }
  std::string rest;
  std::getline(words, rest);
  const Expected<Ruling> ruling =
      judge(*ready, call, row_log(*ready, rest), row_table(), row_materials());
  return ruling ? described(*ruling) + spotted_words(state, *ruling) : refused(ruling.error());
}

}  // namespace

const physics::Table& row_table() {
  static const physics::Table table = physics::preset_table("olympiad").value();
  return table;
}

const physics::Materials& row_materials() {
  static const physics::Materials materials = physics::preset_materials("olympiad").value();
  return materials;
}

GameState row_state(const std::string& text) {
  return StateReader(text).state();
}

EventLog<double> row_log(const GameState& ready, const std::string& text) {
  LogWriter writer(ready);
  std::istringstream tokens(text);
  std::string token;
  while (tokens >> token) {
    writer.take(token);
  }
  return writer.log();
}

std::string described(const GameState& state) {
  std::string text;
  if (state.result) {
    text = state.result->winner ? seat_word(*state.result->winner) + " wins " : "drawn ";
    return text + std::string(name(state.result->reason));
  }
  text = seat_word(state.to_move) + " " + std::string(name(state.kind));
  for (const Decision option : state.options) {
    text += " " + std::string(name(option));
  }
  if (const auto* eight = std::get_if<EightBallMemory>(&state.memory)) {
    if (eight->first_seat_group) {
      text += ", " + std::string(name(*eight->first_seat_group));
    }
  } else {
    const auto& nine = std::get<NineBallMemory>(state.memory);
    if (nine.fouls_in_a_row[0] + nine.fouls_in_a_row[1] > 0) {
      text += ", fouls " + std::to_string(nine.fouls_in_a_row[0]) + " " +
              std::to_string(nine.fouls_in_a_row[1]);
    }
    text += nine.push_out_allowed ? ", push" : "";
  }
  return text;
}

std::string described(const Ruling& ruling) {
  std::string text;
  for (const FoulRecord& foul : ruling.fouls) {
    text += std::string(name(foul.code)) + " ";
  }
  text += "-> " + described(ruling.next);
  for (const Finding& note : ruling.notes) {
    text += note.text == clauses::two_fouls.text ? ", warned" : "";
  }
  return text;
}

std::string outcome(const Row& row) {
  const GameState state = row_state(row.state);
  std::istringstream words(row.action);
  std::string word;
  words >> word;
  if (word == "calls") {
    return calls(state);
  }
  if (word == "targets") {
    return listed(legal_first_balls(state));
  }
  if (const auto possible = check_state(state, row_table(), row_materials()); !possible) {
    return refused(possible.error());
  }
  if (word == "decide") {
    words >> word;
    const auto next = decide(state, decision(word).value(), row_table(), row_materials());
    if (!next) {
      return refused(next.error());
    }
    Ruling ruling;
    ruling.next = *next;
    return checked(*next, described(*next) + spotted_words(state, ruling));
  }
  if (word == "lost") {
    words >> word;
    const FoulCode code =
        word == "time" ? FoulCode::shot_time_exceeded : FoulCode::too_many_refusals;
    const Ruling ruling = judge_lost_turn(state, code, row_table(), row_materials());
    return checked(ruling.next, described(ruling) + spotted_words(state, ruling));
  }
  return shot_outcome(state, words, word);
}

std::vector<Row> all_rows() {
  std::vector<Row> rows = eight_ball_rows();
  const std::vector<Row> nine = nine_ball_rows();
  rows.insert(rows.end(), nine.begin(), nine.end());
  return rows;
}

}  // namespace poolhall::rules::test
