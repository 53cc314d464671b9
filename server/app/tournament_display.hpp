// Shows a running tournament on standard output: on a terminal a table and a progress bar that are
// drawn again in place; elsewhere one plain line a game.
//
//   TournamentDisplay display;
//   display.show(view);     // from any thread, as often as something changed
//   display.close();        // nothing is left of what was drawn in place
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
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
  TournamentDisplay();
  ~TournamentDisplay();
  TournamentDisplay(const TournamentDisplay&) = delete;
  TournamentDisplay& operator=(const TournamentDisplay&) = delete;

  void show(const net::TournamentView& view);
  void close();

 private:
  void run(const std::stop_token& stop);
  void draw(const net::TournamentView& view);
  void draw_in_place(const net::TournamentView& view);
  void print_new_games(const net::TournamentView& view);
  void erase();

  const bool in_place_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<net::TournamentView> latest_{};  // guarded by mutex_
  bool is_new_ = false;                          // guarded by mutex_

  // The drawing thread's own.
  std::size_t lines_drawn_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> printed_;  // pairing and number of a game
  std::jthread thread_;
};

}  // namespace poolhall::app
