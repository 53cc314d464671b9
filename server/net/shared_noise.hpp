// Mirrored noise: the two games of a pair, played at the same time, get the same deviates for the
// same shot of the same seat, as long as nobody can know them beforehand. A shot waits until the
// other game has asked for its shot with that index too; then both are run. A shot that need not or
// cannot wait is run alone, with the deviates of its own game, and so is the other's later one.
//
//   SharedNoise pair({shots_of_first, shots_of_second}, deadlines);
//   pair.submit(PairSide::first, {seat, index}, [](Run how) { play(how); });
//   pair.leave(PairSide::first);                 // this game asks no more
//
// The network thread's own.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>

#include "rules/game_state.hpp"
#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

enum class PairSide : std::uint8_t { first, second };

class SharedNoise {
 public:
  struct ShotKey {
    rules::Seat seat = rules::Seat::first;
    std::uint32_t index = 1;

    friend auto operator<=>(const ShotKey&, const ShotKey&) = default;
  };
  enum class Run : std::uint8_t { alone, shared };
  using ShotsOfSeats = std::array<std::uint32_t, 2>;

  // A game does not wait longer than this for the other's shot.
  static constexpr std::chrono::seconds longest_wait{5};

  // `played`: the shots that each game has stored already.
  SharedNoise(const std::array<ShotsOfSeats, 2>& played, DeadlineQueue& deadlines,
              std::chrono::milliseconds patience = longest_wait)
      : played_(played), deadlines_(deadlines), patience_(patience) {}

  // Calls `run` once, now or later.
  void submit(PairSide side, ShotKey shot, std::function<void(Run)> run);
  // What this game has waiting is run alone, and nothing waits for it any more.
  void leave(PairSide side);

 private:
  struct Waiting {
    ShotKey shot;
    std::function<void(Run)> run;
    Deadline patience;
  };

  [[nodiscard]] bool was_run(ShotKey shot) const;
  void run_alone(PairSide side);

  std::array<ShotsOfSeats, 2> played_;
  DeadlineQueue& deadlines_;
  std::chrono::milliseconds patience_;
  std::set<ShotKey> run_;  // in this run of the server, by either game
  std::array<std::optional<Waiting>, 2> waiting_{};
  std::array<bool, 2> left_{};
};

}  // namespace poolhall::net
