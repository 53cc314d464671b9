#include "rules/referee.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "physics/simulator.hpp"
#include "physics/words.hpp"
#include "rules/common_clauses.hpp"
#include "rules/game_rules.hpp"
#include "rules/log_check.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules {
namespace {

constexpr physics::Words<Call::Kind, 4> call_kind_names{{{Call::Kind::none, "none"},
                                                         {Call::Kind::pocket, "pocket"},
                                                         {Call::Kind::safety, "safety"},
                                                         {Call::Kind::push_out, "push_out"}}};
constexpr std::array<std::string_view, 6> refusal_names{
    "bad_shot", "bad_call", "bad_cue_ball_position", "bad_decision", "bad_state", "bad_event_log"};
constexpr std::array<std::string_view, 9> foul_names{
    "scratch",        "wrong_ball_first",   "no_ball_hit",       "no_rail_after_contact",
    "ball_off_table", "shot_time_exceeded", "too_many_refusals", "illegal_break",
    "kitchen"};

tl::unexpected<Refusal> refuse(RefusalCode code, std::string field, std::string reason) {
  return tl::unexpected(Refusal{code, std::move(field), std::move(reason)});
}

std::string_view words(Call::Kind kind) {
  switch (kind) {
    case Call::Kind::none:
      return "no call";
    case Call::Kind::pocket:
      return "a ball and a pocket";
    case Call::Kind::safety:
      return "safety";
    case Call::Kind::push_out:
      break;
  }
  return "push_out";
}

Expected<void> check_turn_is_shot(const GameState& state) {
  if (state.result) {
    return refuse(RefusalCode::bad_shot, "", "the game is over");
  }
  if (state.kind == TurnKind::decision) {
    return refuse(RefusalCode::bad_shot, "", "a decision was expected, not a shot");
  }
  return {};
}

Expected<void> check_call(const GameState& state, const Call& call) {
  const std::vector<Call::Kind> kinds = legal_calls(state);
  if (std::find(kinds.begin(), kinds.end(), call.kind) == kinds.end()) {
    std::string expected;
    for (const Call::Kind kind : kinds) {
      expected += (expected.empty() ? "" : " or ") + std::string(words(kind));
    }
    return refuse(RefusalCode::bad_call, "/call",
                  std::string(words(call.kind)) + " came, expected " + expected);
  }
  if (call.kind != Call::Kind::pocket) {
    return {};
  }
  const std::vector<BallId> balls = callable_balls(state);
  if (std::find(balls.begin(), balls.end(), call.ball) == balls.end()) {
    const BallPlace* place = find_ball(state, call.ball);
    const std::string why = place == nullptr                        ? " is not in the game"
                            : place->where == Whereabouts::on_table ? " cannot be called now"
                                                                    : " is down";
    return refuse(RefusalCode::bad_call, "/call/ball",
                  "ball " + std::to_string(physics::number(call.ball)) + why + ", expected " +
                      ball_words(balls));
  }
  if (static_cast<std::size_t>(call.pocket) >= physics::pocket_count) {
    return refuse(RefusalCode::bad_call, "/call/pocket", "not a pocket of this table");
  }
  return {};
}

// Whether the cue ball lies where this turn wants it.
Expected<void> check_cue_ball(const GameState& state, const physics::Table& table) {
  if (!on_table(state, physics::cue_ball)) {
    return refuse(RefusalCode::bad_cue_ball_position, "/cue_ball",
                  "the cue ball is in hand: a place for it was expected");
  }
  const bool in_kitchen =
      state.kind == TurnKind::break_shot || state.kind == TurnKind::ball_in_hand_behind_head_string;
  const double y = find_ball(state, physics::cue_ball)->position.y;
  if (in_kitchen && applies(clauses::kitchen_placement, !(y < table.head_string))) {
    return refuse(RefusalCode::bad_cue_ball_position, "/cue_ball/y",
                  std::to_string(y) + ", expected below the head string at " +
                      std::to_string(table.head_string));
  }
  return {};
}

Expected<GameState> with_cue_ball(const GameState& state, const physics::Vec2<double>& place,
                                  const physics::Table& table,
                                  const physics::Materials& materials) {
  const BallPlace* lies = find_ball(state, physics::cue_ball);
  if (state.kind == TurnKind::shot) {
    if (lies->position == place) {
      return state;
    }
    return refuse(RefusalCode::bad_cue_ball_position, "/cue_ball",
                  "the cue ball is not in hand: it is played from where it lies");
  }
  GameState placed = state;
  placed.balls[0] = {physics::cue_ball, Whereabouts::on_table, place, {}};
  const physics::Scene<double> scene{table, materials, balls_on_table(placed), {}};
  if (const auto possible = physics::check_scene(scene); !possible) {
    return refuse(RefusalCode::bad_cue_ball_position, "/cue_ball", possible.error().reason);
  }
  return placed;
}

// A state, a call and the cue ball's place from which a shot can be judged.
Expected<void> check_ready(const GameState& ready, const Call& call, const physics::Table& table,
                           const physics::Materials& materials) {
  if (auto possible = check_state(ready, table, materials); !possible) {
    return possible;
  }
  if (auto shot = check_turn_is_shot(ready); !shot) {
    return shot;
  }
  if (auto called = check_call(ready, call); !called) {
    return called;
  }
  return check_cue_ball(ready, table);
}

Ruling ruling_of(Verdict verdict) {
  // A shot has a foul of each code at most once.
  std::sort(verdict.fouls.begin(), verdict.fouls.end(),
            [](const FoulRecord& p, const FoulRecord& q) { return p.code < q.code; });
  Ruling ruling;
  ruling.legal = verdict.fouls.empty();
  ruling.fouls = std::move(verdict.fouls);
  ruling.notes = std::move(verdict.notes);
  ruling.first_contact = verdict.first_contact;
  ruling.next = std::move(verdict.next);
  return ruling;
}

}  // namespace

std::string_view name(Call::Kind kind) {
  return physics::word_of(call_kind_names, kind);
}

std::optional<Call::Kind> call_kind(std::string_view name) {
  return physics::value_of(call_kind_names, name);
}

std::string_view name(RefusalCode code) {
  const auto i = static_cast<std::size_t>(code);
  return i < refusal_names.size() ? refusal_names[i] : std::string_view{};
}

std::string_view name(FoulCode code) {
  const auto i = static_cast<std::size_t>(code);
  return i < foul_names.size() ? foul_names[i] : std::string_view{};
}

std::optional<FoulCode> foul_code(std::string_view name) {
  const auto found = std::find(foul_names.begin(), foul_names.end(), name);
  return found == foul_names.end()
             ? std::nullopt
             : std::optional{static_cast<FoulCode>(found - foul_names.begin())};
}

GameState new_game(const GameSettings& settings, const physics::Table& table,
                   const physics::Materials& materials) {
  GameState state;
  state.settings = settings;
  return racked(std::move(state), settings.breaker, {table, materials});
}

std::vector<BallId> callable_balls(const GameState& state) {
  return state.result ? std::vector<BallId>{}
                      : game_rules(state.settings.rules).callable_balls(state);
}

std::vector<BallId> legal_first_balls(const GameState& state) {
  return state.result ? std::vector<BallId>{} : game_rules(state.settings.rules).first_balls(state);
}

std::vector<Call::Kind> legal_calls(const GameState& state) {
  return state.result ? std::vector<Call::Kind>{}
                      : game_rules(state.settings.rules).legal_calls(state);
}

Expected<GameState> prepare_shot(const GameState& state, const Call& call,
                                 const std::optional<physics::Vec2<double>>& cue_ball,
                                 const physics::Table& table, const physics::Materials& materials) {
  if (auto possible = check_state(state, table, materials); !possible) {
    return tl::unexpected(possible.error());
  }
  if (auto shot = check_turn_is_shot(state); !shot) {
    return tl::unexpected(shot.error());
  }
  if (auto called = check_call(state, call); !called) {
    return tl::unexpected(called.error());
  }
  Expected<GameState> ready =
      cue_ball ? with_cue_ball(state, *cue_ball, table, materials) : Expected<GameState>(state);
  if (ready) {
    if (auto placed = check_cue_ball(*ready, table); !placed) {
      return tl::unexpected(placed.error());
    }
  }
  return ready;
}

Expected<Ruling> judge(const GameState& ready, const Call& call,
                       const physics::EventLog<double>& events, const physics::Table& table,
                       const physics::Materials& materials) {
  if (auto possible = check_ready(ready, call, table, materials); !possible) {
    return tl::unexpected(possible.error());
  }
  if (auto fits = check_log(ready, events, materials); !fits) {
    return tl::unexpected(fits.error());
  }
  const Venue venue{table, materials};
  const ShotFacts facts = shot_facts(ready, events, table, materials);
  const GameState after = settled(ready, events);
  const std::uint32_t without_pocket =
      facts.object_ball_pocketed() ? 0 : ready.turns_without_pocket + 1;
  Ruling ruling = ruling_of(
      with_stalemate(game_rules(ready.settings.rules).judge({ready, call, facts, after, venue}),
                     ready, without_pocket, venue));
  ruling.pocketed = facts.pocketed;
  for (const BallEvent& off : facts.driven_off) {
    ruling.driven_off.push_back(off.ball);
  }
  if (auto possible = check_state(ruling.next, table, materials); !possible) {
    return refuse(RefusalCode::bad_event_log, "/events",
                  "the log ends in an impossible state: " + possible.error().field + ": " +
                      possible.error().reason);
  }
  return ruling;
}

Ruling judge_lost_turn(const GameState& state, FoulCode code, const physics::Table& table,
                       const physics::Materials& materials) {
  if (state.result) {
    Ruling over;
    over.next = state;
    return over;
  }
  const Venue venue{table, materials};
  const std::uint32_t played = state.kind == TurnKind::decision ? 0 : 1;
  Verdict verdict = with_stalemate(game_rules(state.settings.rules).lost_turn(state, venue), state,
                                   state.turns_without_pocket + played, venue);
  if (applies(clauses::shot_time_exceeded, code == FoulCode::shot_time_exceeded)) {
    verdict.fouls.push_back(foul(code, clauses::shot_time_exceeded, ""));
  }
  if (applies(clauses::too_many_refusals, code == FoulCode::too_many_refusals)) {
    verdict.fouls.push_back(foul(code, clauses::too_many_refusals, ""));
  }
  return ruling_of(std::move(verdict));
}

Expected<GameState> decide(const GameState& state, Decision decision, const physics::Table& table,
                           const physics::Materials& materials) {
  if (auto possible = check_state(state, table, materials); !possible) {
    return tl::unexpected(possible.error());
  }
  if (state.result) {
    return refuse(RefusalCode::bad_decision, "", "the game is over");
  }
  if (state.kind != TurnKind::decision) {
    return refuse(RefusalCode::bad_decision, "", "a shot was expected, not a decision");
  }
  if (std::find(state.options.begin(), state.options.end(), decision) == state.options.end()) {
    std::string expected;
    for (const Decision option : state.options) {
      expected += (expected.empty() ? "" : ", ") + std::string(name(option));
    }
    return refuse(RefusalCode::bad_decision, "/choice",
                  std::string(name(decision)) + " came, expected one of " + expected);
  }
  return game_rules(state.settings.rules).decide(state, decision, {table, materials});
}

GameState ended(const GameState& state, const GameResult& result) {
  return state.result ? state : game_over(state, result);
}

}  // namespace poolhall::rules
