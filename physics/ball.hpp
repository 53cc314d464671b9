// A ball at one instant. SI units, table frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/table.hpp"
#include "physics/vector.hpp"

namespace poolhall::physics {

// 0 is the cue ball; 1..15 the object balls with their printed numbers.
enum class BallId : std::uint8_t {};
inline constexpr BallId cue_ball{0};
inline constexpr std::size_t max_balls = 16;

[[nodiscard]] constexpr unsigned number(BallId id) {
  return static_cast<unsigned>(id);
}

enum class MotionState : std::uint8_t { stationary, spinning, rolling, sliding, pocketed };

[[nodiscard]] std::string_view name(MotionState state);
[[nodiscard]] std::optional<MotionState> motion_state(std::string_view name);

template <class Real>
struct Ball {
  BallId id{};
  MotionState state = MotionState::stationary;
  Vec2<Real> position{};             // m, the centre
  Vec2<Real> velocity{};             // m/s
  Vec3<Real> angular_velocity{};     // rad/s
  std::optional<PocketId> pocket{};  // set if and only if state is pocketed
};

// Balls of a scene or of a table, in the order in which they were given.
template <class Real>
struct BallSet {
  std::array<Ball<Real>, max_balls> balls{};
  std::size_t count = 0;

  [[nodiscard]] auto begin() const { return balls.begin(); }
  [[nodiscard]] auto end() const { return balls.begin() + static_cast<std::ptrdiff_t>(count); }
  [[nodiscard]] auto begin() { return balls.begin(); }
  [[nodiscard]] auto end() { return balls.begin() + static_cast<std::ptrdiff_t>(count); }
  [[nodiscard]] const Ball<Real>& operator[](std::size_t i) const { return balls[i]; }
  [[nodiscard]] Ball<Real>& operator[](std::size_t i) { return balls[i]; }
};

}  // namespace poolhall::physics
