#include "tests/support/random_games.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>

#include "physics/simulator.hpp"
#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"
#include "rules/referee.hpp"
#include "tests/support/mirrored.hpp"

namespace poolhall::test_support {
namespace {

using physics::Vec2;
using namespace rules;

// Every turn either moves the game on or counts towards a stalemate, of which two end it: longer
// games than this do not come about.
constexpr std::size_t turn_limit = 5000;
constexpr std::size_t broken_limit = 20;

class GameDice {
 public:
  explicit GameDice(std::uint64_t seed) : engine_(seed) {}

  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  [[nodiscard]] std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  [[nodiscard]] bool one_in(std::size_t n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

struct Play {
  Call call;
  GameState ready;
  physics::EventLog<double> events;
};

// One game, played and checked.
class RandomGame {
 public:
  RandomGame(const GamesPlan& plan, std::uint64_t seed, GamesReport& report)
      : plan_(plan),
        seed_(seed),
        report_(report),
        table_(physics::preset_table(plan.table).value()),
        materials_(physics::preset_materials(plan.materials).value()),
        dice_(seed) {}

  void play() {
    GameSettings settings{.rules = plan_.rules, .rack_seed = seed_ % 1'000'003};
    settings.breaker = dice_.one_in(2) ? Seat::first : Seat::second;
    settings.rack_gap = dice_.one_in(2) ? 0 : 1e-4;
    settings.rack_jitter = dice_.one_in(4) ? 2e-4 : 0;
    state_ = new_game(settings, table_, materials_);
    expect(check_settings(settings, table_, materials_).has_value(), "settings refused");
    std::size_t turns = 0;
    while (!state_.result && turns < turn_limit && !is_broken_) {
      take_turn();
      ++turns;
    }
    expect(state_.result.has_value(), "no end");
    ++report_.games;
    report_.turns += turns;
    report_.longest = std::max(report_.longest, turns);
    ++report_.ends[state_.result ? std::string(name(state_.result->reason)) : "none"];
  }

 private:
  void expect(bool holds, const std::string& what) {
    if (holds) {
      return;
    }
    is_broken_ = true;
    if (report_.broken.size() < broken_limit) {
      report_.broken.push_back("seed " + std::to_string(seed_) + ", turn " +
                               std::to_string(state_.turn) + ": " + what);
    }
  }

  void take_turn() {
    if (dice_.one_in(2000)) {
      return enter(ended(state_, {other(state_.to_move), EndReason::conceded}));
    }
    if (dice_.one_in(100)) {
      const Ruling ruling = judge_lost_turn(
          state_, dice_.one_in(2) ? FoulCode::shot_time_exceeded : FoulCode::too_many_refusals,
          table_, materials_);
      count_fouls(ruling);
      return enter(ruling.next);
    }
    if (state_.kind == TurnKind::decision) {
      const Decision choice = state_.options[dice_.below(state_.options.size())];
      const auto next = decide(state_, choice, table_, materials_);
      expect(next.has_value(), "an offered decision was refused");
      return next ? enter(*next) : void();
    }
    shoot();
  }

  // The next state must be possible and have all the balls.
  void enter(const GameState& next) {
    const auto possible = check_state(next, table_, materials_);
    expect(possible.has_value(), possible ? ""
                                          : "impossible state: " + possible.error().field + " " +
                                                possible.error().reason);
    expect(next.balls.size() == state_.balls.size(), "balls were lost");
    const bool reracked = next.rack != state_.rack;
    for (std::size_t i = 1; i < next.balls.size() && !reracked; ++i) {
      const bool came_back = state_.balls[i].where != Whereabouts::on_table &&
                             next.balls[i].where == Whereabouts::on_table;
      const std::size_t spotted = plan_.rules == RuleSet::eight_ball ? 8 : 9;
      expect(!came_back || i == spotted, "ball " + std::to_string(i) + " came back");
    }
    expect(next.result.has_value() || next.turn == state_.turn + 1, "turns do not count by one");
    state_ = next;
  }

  void count_fouls(const Ruling& ruling) {
    for (const FoulRecord& foul : ruling.fouls) {
      ++report_.fouls[std::string(name(foul.code))];
    }
  }

  Call random_call() {
    const std::vector<Call::Kind> kinds = legal_calls(state_);
    Call call;
    call.kind = kinds[dice_.one_in(6) ? dice_.below(kinds.size()) : 0];
    const std::vector<BallId> balls = callable_balls(state_);
    if (call.kind == Call::Kind::pocket) {
      call.ball = balls[dice_.below(balls.size())];
      call.pocket = static_cast<physics::PocketId>(dice_.below(physics::pocket_count));
    }
    return call;
  }

  // A ready state; the cue ball, where it is in hand, somewhere at random.
  std::optional<GameState> ready_state(const Call& call) {
    if (state_.kind == TurnKind::shot) {
      const auto ready = prepare_shot(state_, call, std::nullopt, table_, materials_);
      return ready ? std::optional{*ready} : std::nullopt;
    }
    const double top =
        state_.kind == TurnKind::ball_in_hand ? table_.length : table_.head_string * 1.05;
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const Vec2<double> place{dice_.uniform(0, table_.width), dice_.uniform(0, top)};
      const auto ready = prepare_shot(state_, call, place, table_, materials_);
      if (ready) {
        return *ready;
      }
      expect(ready.error().code == RefusalCode::bad_cue_ball_position,
             "refused for another reason than the place: " + ready.error().reason);
    }
    return std::nullopt;
  }

  // Degrees; the heading to the ghost ball, from which `ball` goes to `pocket`'s corner.
  double aimed(const GameState& ready, BallId ball, physics::PocketId pocket) {
    const auto n = static_cast<unsigned>(pocket);
    const unsigned row = n / 2;
    const Vec2<double> corner{n % 2 == 0 ? 0 : table_.width, table_.length * 0.5 * row};
    const Vec2<double> object = find_ball(ready, ball)->position;
    const Vec2<double> way = corner - object;
    const double reach = 2 * materials_.ball_radius / std::sqrt(dot(way, way));
    return heading(object - reach * way - find_ball(ready, physics::cue_ball)->position);
  }

  static double heading(const Vec2<double>& way) {
    return std::atan2(way.y, way.x) * 180 / std::numbers::pi;
  }

  physics::CueShot<double> random_shot(const GameState& ready, const Call& call) {
    double phi = dice_.uniform(-180, 180);
    double v = dice_.uniform(0.2, 5);
    if (ready.kind == TurnKind::break_shot) {
      const Vec2<double> apex{table_.foot_spot_x, table_.foot_spot_y};
      phi = heading(apex - find_ball(ready, physics::cue_ball)->position) + dice_.uniform(-1, 1);
      v = dice_.uniform(0.5, 10);
    } else if (!dice_.one_in(4)) {
      const std::vector<BallId> first = legal_first_balls(ready);
      const bool called = call.kind == Call::Kind::pocket;
      phi = aimed(ready, called ? call.ball : first[dice_.below(first.size())],
                  called ? call.pocket
                         : static_cast<physics::PocketId>(dice_.below(physics::pocket_count)));
    }
    const auto shot = physics::cue_shot_from_degrees(dice_.uniform(-8, 8), dice_.uniform(-8, 8),
                                                     dice_.uniform(0, 20), phi, v);
    return physics::nearest_possible_shot(shot, balls_on_table(ready), table_, materials_).shot;
  }

  void shoot() {
    Play played;
    played.call = random_call();
    const auto ready = ready_state(played.call);
    expect(ready.has_value(), "no place for the cue ball");
    if (!ready) {
      return;
    }
    played.ready = *ready;
    const auto simulation = physics::simulate<double>(
        {table_, materials_, balls_on_table(*ready), random_shot(*ready, played.call)}, {});
    expect(simulation.has_value(), simulation ? ""
                                              : "not simulated: " + simulation.error().field + " " +
                                                    simulation.error().reason);
    if (!simulation) {
      return;
    }
    played.events = simulation->events;
    ++report_.shots;
    const auto ruling = judge(played.ready, played.call, played.events, table_, materials_);
    expect(ruling.has_value(),
           ruling ? "" : "not judged: " + ruling.error().field + " " + ruling.error().reason);
    if (ruling) {
      check_again(played, *ruling);
      count_fouls(*ruling);
      enter(ruling->next);
    }
  }

  void check_again(const Play& played, const Ruling& ruling) {
    expect(ruling.legal == ruling.fouls.empty(), "legal with fouls");
    const auto image = judge(mirrored(played.ready, table_), mirrored(played.call),
                             mirrored(played.events, table_), table_, materials_);
    expect(image && same_in_mirror(ruling, *image, table_), "another ruling in the mirror");
    if (report_.shots % plan_.stored_every != 0) {
      return;
    }
    ++report_.rejudged_from_store;
    const auto events = protocol::decode_events(
        protocol::encode_events(played.events, protocol::EventDetail::full));
    const auto ready = protocol::decode_state(protocol::encode_state(played.ready));
    const auto call = protocol::decode_call(protocol::encode_call(played.call));
    expect(events && ready && call, "log, state or call were not read back");
    if (events && ready && call) {
      expect(*ready == played.ready && *call == played.call, "state or call came back changed");
      const auto again = judge(*ready, *call, *events, table_, materials_);
      expect(again && *again == ruling, "another ruling from the stored log");
    }
  }

  const GamesPlan& plan_;
  std::uint64_t seed_;
  GamesReport& report_;
  physics::Table table_;
  physics::Materials materials_;
  GameDice dice_;
  GameState state_;
  bool is_broken_ = false;
};

}  // namespace

GamesReport play_random_games(const GamesPlan& plan) {
  if (!physics::preset_table(plan.table) || !physics::preset_materials(plan.materials)) {
    throw std::invalid_argument("no preset " + plan.table + " or " + plan.materials);
  }
  GamesReport report;
  for (std::size_t i = 0; i < plan.games; ++i) {
    RandomGame(plan, plan.seed * 1'000'000'007ULL + i, report).play();
  }
  return report;
}

}  // namespace poolhall::test_support
