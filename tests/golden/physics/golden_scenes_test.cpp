// The determinism contract (physics/README.md): these scenes give these bits with gcc and clang, at
// any optimisation level. POOLHALL_PRINT_GOLDEN=1 prints what this build finds.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <iostream>

#include "physics/simulator.hpp"

namespace poolhall::physics {
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
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::uint64_t hash_of(const Scene<double>& scene, const SimulationOptions& options) {
  const auto result = simulate(scene, options);
  if (!result) {
    ADD_FAILURE() << result.error().field << ": " << result.error().reason;
    return 0;
  }
  Hash hash;
  for (const auto& event : result->events) {
    hash.add(event.t);
    hash.add_bits(static_cast<std::uint64_t>(event.type));
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      hash.add(event.after[i]);
    }
  }
  for (const auto& ball : result->balls) {
    hash.add(ball);
  }
  return hash.value();
}

Scene<double> break_shot(std::string_view table, std::string_view kind) {
  Scene<double> scene;
  scene.table = *preset_table(table);
  scene.materials = *preset_materials(kind);
  const double pitch = 2 * scene.materials.ball_radius;
  scene.balls.count = 16;
  scene.balls[0].id = cue_ball;
  scene.balls[0].position = {scene.table.width / 2 + 0.05, scene.table.head_string - 0.1};
  std::uint8_t n = 1;
  for (int row = 0; row < 5; ++row) {
    for (int i = 0; i <= row; ++i, ++n) {
      scene.balls[n].id = BallId{n};
      scene.balls[n].position = {scene.table.foot_spot_x + pitch * (i - row / 2.0),
                                 scene.table.foot_spot_y + pitch * row * 0.8660254037844386};
    }
  }
  scene.shot = cue_shot_from_degrees(1.5, 3.0, 4.0, 92.5, 7.0);
  return scene;
}

struct Golden {
  const char* name;
  const char* table;
  const char* kind;
  ContactModel contact;
  RootSolver solver;
  std::uint64_t hash;
};

constexpr Golden golden[] = {
    {"cluster break", "olympiad", "olympiad", ContactModel::cluster, RootSolver::bracketed,
     0x15cbdec7ed47d12a},
    {"sequential break", "olympiad", "olympiad", ContactModel::sequential, RootSolver::bracketed,
     0xd3c9c727f4437968},
    {"modern break among jaws", "bar7", "modern", ContactModel::cluster, RootSolver::bracketed,
     0x4010e7b46e0a59f6},
    {"hertz break", "wpa9", "modern", ContactModel::hertz, RootSolver::bracketed,
     0x5c09b2b0921d10f3},
    {"closed form", "olympiad", "marlow", ContactModel::sequential,
     RootSolver::closed_form_polished, 0x5bf0f20ccc0f376b},
};

TEST(GoldenScenes, GiveTheSameBitsInEveryBuild) {
  const bool print = std::getenv("POOLHALL_PRINT_GOLDEN") != nullptr;
  for (const Golden& g : golden) {
    const auto hash =
        hash_of(break_shot(g.table, g.kind), {.contact = g.contact, .solver = g.solver});
    if (print) {
      std::cout << g.name << " 0x" << std::hex << hash << std::dec << "\n";
    }
    EXPECT_EQ(hash, g.hash) << g.name;
  }
}

}  // namespace
}  // namespace poolhall::physics
