#include "tests/support/golden_scenes.hpp"

#include <cstring>
#include <string_view>

#include "physics/batch.hpp"
#include "physics/event_loop.hpp"

namespace poolhall::test_support {

using namespace physics;

namespace {

// FNV-1a over the bytes of all numbers of the log and the final state.
class Hash {
 public:
  void add(double value) {
    value += 0.0;  // -0 and 0 are the same number
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add_bits(bits);
  }
  void add_bits(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      value_ = (value_ ^ ((bits >> (8 * i)) & 0xffU)) * 0x100000001b3U;
    }
  }
  void add(const Ball<double>& ball) {
    add_bits(number(ball.id));
    add_bits(static_cast<std::uint64_t>(ball.state));
    for (const double x :
         {ball.position.x, ball.position.y, ball.velocity.x, ball.velocity.y,
          ball.angular_velocity.x, ball.angular_velocity.y, ball.angular_velocity.z}) {
      add(x);
    }
  }
  void add(const EventLog<double>& events, const BallSet<double>& balls) {
    for (const auto& event : events) {
      add(event.t);
      add_bits(static_cast<std::uint64_t>(event.type));
      for (std::size_t i = 0; i < event.ball_count; ++i) {
        add(event.after[i]);
      }
    }
    for (const auto& ball : balls) {
      add(ball);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

Scene<double> break_shot(std::string_view table, std::string_view kind, const Cushion* cushion,
                         int rows) {
  Scene<double> scene;
  scene.table = *preset_table(table);
  scene.materials = *preset_materials(kind);
  if (cushion != nullptr) {
    scene.materials.cushion = *cushion;
  }
  const double pitch = 2 * scene.materials.ball_radius;
  scene.balls.count = 1 + static_cast<std::size_t>(rows * (rows + 1) / 2);
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {scene.table.width / 2 + 0.05, scene.table.head_string - 0.1};
  std::uint8_t n = 1;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i <= row; ++i, ++n) {
      scene.balls[n].id = BallId{n};
      scene.balls[n].position = {scene.table.foot_spot_x + pitch * (i - row / 2.0),
                                 scene.table.foot_spot_y + pitch * row * 0.8660254037844386};
    }
  }
  scene.shot = cue_shot_from_degrees(1.5, 3.0, 4.0, 92.5, 7.0);
  return scene;
}

std::uint64_t hash_played(const Scene<double>& scene, const SimulationOptions& options) {
  Hash hash;
  if (const auto result = simulate(scene, options)) {
    hash.add(result->events, result->balls);
  }
  return hash.value();
}

template <class Policy>
std::uint64_t hash_looped(const Scene<double>& scene, const SimulationOptions& options) {
  EventLoop<double, Policy> loop(scene.table, scene.materials);
  Recorder<double> recorder;
  static_cast<void>(loop.run(scene.balls, scene.shot, options, recorder));
  Hash hash;
  hash.add(recorder.take(), loop.balls());
  return hash.value();
}

std::uint64_t hash_evaluated() {
  Hash hash;
  const auto outcomes = evaluate(break_shot("wpa9", "modern", nullptr, 5),
                                 *preset_noise("olympiad"), {.samples = 50, .seed = 5});
  if (outcomes) {
    for (std::size_t i = 0; i < max_balls; ++i) {
      hash.add_bits(outcomes->first_contact[i]);
      hash.add_bits(outcomes->pocketed[i].total());
      hash.add(outcomes->resting[i].sum.x);
      hash.add(outcomes->resting[i].sum.y);
      hash.add(outcomes->resting[i].squares.x);
      hash.add(outcomes->resting[i].squares.y);
    }
  }
  return hash.value();
}

struct Golden {
  const char* name = nullptr;
  const char* table = nullptr;
  const char* kind = nullptr;
  const Cushion* cushion = nullptr;
  int rows = 0;  // of the rack
  SimulationOptions options;
  std::uint64_t played = 0;   // simulate
  std::uint64_t plain = 0;    // EventLoop<double>
  std::uint64_t precise = 0;  // EventLoop<double, Precise>
};

const Cushion spring = SpringCushion{};
const Cushion mathavan = Mathavan2010Cushion{};

const Golden golden[] = {
    {"cluster break",
     "olympiad",
     "olympiad",
     nullptr,
     5,
     {},
     0x15cbdec7ed47d12a,
     0x909889fc4dff8433,
     0x15cbdec7ed47d12a},
    {"sequential break",
     "olympiad",
     "olympiad",
     nullptr,
     5,
     {.contact = ContactModel::sequential},
     0x9638a7d21f838604,
     0x8582f1fcbe6823e9,
     0x9638a7d21f838604},
    {"modern break among jaws",
     "bar7",
     "modern",
     nullptr,
     5,
     {},
     0x4010e7b46e0a59f6,
     0xf9a9f4fd94c3c2ba,
     0x4010e7b46e0a59f6},
    {"hertz break",
     "wpa9",
     "modern",
     nullptr,
     5,
     {.contact = ContactModel::hertz},
     0xfb41708377ecd063,
     0x57d9fd56c258ed06,
     0xfb41708377ecd063},
    {"closed form",
     "olympiad",
     "marlow",
     nullptr,
     5,
     {.contact = ContactModel::sequential, .solver = RootSolver::closed_form_polished},
     0x8df7e36e18bf7c23,
     0x765630a22575f59e,
     0x8df7e36e18bf7c23},
    {"spring cushions",
     "wpa8",
     "olympiad",
     &spring,
     5,
     {},
     0x32dde6643df06ea4,
     0x415be82c3eb09d25,
     0x32dde6643df06ea4},
    {"mathavan2010 cushions",
     "wpa8",
     "modern",
     &mathavan,
     5,
     {},
     0x6fca7f948bdd64b7,
     0x220918a4ffdfa7ed,
     0x6fca7f948bdd64b7},
    {"two balls",
     "olympiad",
     "olympiad",
     nullptr,
     1,
     {},
     0xdfe8894f5dca5db8,
     0xdfe8894f5dca5db8,
     0x8cf08eb3b7253f3e},
    {"two balls among jaws",
     "wpa9",
     "modern",
     nullptr,
     1,
     {},
     0x1ce3620835518e1d,
     0x1ce3620835518e1d,
     0xc1af96d02b63fdee},
};
constexpr std::uint64_t evaluated = 0xaca4648718dcb165;

}  // namespace

std::vector<GoldenHash> golden_hashes() {
  std::vector<GoldenHash> out;
  for (const Golden& g : golden) {
    const Scene<double> scene = break_shot(g.table, g.kind, g.cushion, g.rows);
    const std::string name = g.name;
    out.push_back({name + ", simulate", g.played, hash_played(scene, g.options)});
    out.push_back({name + ", double", g.plain, hash_looped<Lean>(scene, g.options)});
    out.push_back({name + ", wide", g.precise, hash_looped<Precise>(scene, g.options)});
  }
  out.push_back({"evaluate", evaluated, hash_evaluated()});
  return out;
}

}  // namespace poolhall::test_support
