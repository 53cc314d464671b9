// Shows a running tournament on standard output: on a terminal a table and a progress bar that are
// drawn again in place; elsewhere one plain line a game.
//
//   TournamentDisplay display(ask);   // `ask` has somebody call show(), now or later
//   display.changed();                // from any thread, as often as something changed
//   display.close(view);              // nothing is left of what was drawn in place
//
// It asks twice a second at most, and less often where drawing takes long.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "server/net/tournament_driver.hpp"

namespace poolhall::app {

class TournamentDisplay {
 public:
  explicit TournamentDisplay(std::function<void()> ask);
  ~TournamentDisplay();
  TournamentDisplay(const TournamentDisplay&) = delete;
  TournamentDisplay& operator=(const TournamentDisplay&) = delete;

  void changed();
  void show(net::TournamentView view);
  // `last`: what is shown of it before the end, where that is still to be shown.
  void close(const std::optional<net::TournamentView>& last = std::nullopt);

 private:
  void run(const std::stop_token& stop);
  [[nodiscard]] std::optional<net::TournamentView> next_view(const std::stop_token& stop);
  void draw(const net::TournamentView& view);
  void draw_in_place(const net::TournamentView& view);
  void print_new_games(const net::TournamentView& view);
  void erase();

  const bool in_place_;
  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::optional<net::TournamentView> latest_{};  // guarded by mutex_
  bool has_changed_ = false;                     // guarded by mutex_

  std::function<void()> ask_;

  // The drawing thread's own.
  std::size_t lines_drawn_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> printed_;  // pairing and number of a game
  std::jthread thread_;
};

}  // namespace poolhall::app
