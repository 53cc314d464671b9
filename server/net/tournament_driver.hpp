// Plays one tournament on a host: enters its players, starts its matches as the director allows,
// gathers the results, and says when it is over. Begun again on the same database it goes on
// where it was. The network thread's own, like the host.
//
//   TournamentDriver driver{file, host, [] { return std::chrono::steady_clock::now(); }};
//   driver.on_change([&] { show(driver.view()); });
//   if (auto begun = driver.begin(seed); !begun) die(begun.error());
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "server/ledger/tournament_book.hpp"
#include "server/net/deadline_queue.hpp"
#include "server/net/match_host.hpp"
#include "server/settings/tournament_settings.hpp"
#include "server/tournament/director.hpp"
#include "server/tournament/progress.hpp"
#include "server/tournament/render.hpp"
#include "server/tournament/standings.hpp"

namespace poolhall::net {

// A copy of where the tournament is, for displays on other threads.
struct TournamentView {
  struct Running {
    tournament::EntryId first{};
    tournament::EntryId second{};
    SteadyTime since{};
  };

  tournament::Names names;
  tournament::TableRules rules;
  std::vector<tournament::PlayedGame> games;  // scored, in the order of the schedule
  std::vector<tournament::TimedGame> timed;   // those that ended since `began`
  std::vector<Running> running;
  std::vector<tournament::TimedGame> waiting;  // of the matches that are known so far
  std::string remarks{};                       // lines: how an SPRT stands, where a lot decided
  SteadyTime began{};
  bool over = false;
};

[[nodiscard]] tournament::Standings standings_of(const TournamentView& view);
[[nodiscard]] tournament::Progress progress_of(const TournamentView& view, SteadyTime now);

// An entry of a file, as a host wants it.
[[nodiscard]] TournamentEntry entry_of(const std::string& tournament,
                                       const settings::EntrySettings& settings);

class TournamentDriver {
 public:
  TournamentDriver(settings::TournamentFile file, MatchHost& host, std::function<SteadyTime()> now);

  // After each game; replaces the callback before it. It gets no view: to make one takes long where
  // there are 100,000 games, so it is made when somebody looks.
  void on_change(std::function<void()> callback);

  // `seed` is for the racks if neither the file nor an earlier run has one. The error, one line, is
  // that the database has another tournament of this name.
  [[nodiscard]] tl::expected<void, std::string> begin(std::uint64_t seed);

  [[nodiscard]] TournamentView view() const;
  [[nodiscard]] bool is_over() const { return over_; }

 private:
  [[nodiscard]] tl::expected<void, std::string> open(std::uint64_t seed);
  void enter_all();
  void take_up_earlier_results();
  void take_field();
  void entries_changed();
  void match_over(const MatchOutcome& outcome);
  void game_over(const MatchOrder& order, const GameOutcome& outcome);
  // Follows what the results make of the schedule.
  void plan();
  void start_due();
  void start(const tournament::Pairing& pairing);
  void finish();
  void tell() const;
  [[nodiscard]] MatchOrder order_of(const tournament::Pairing& pairing) const;
  [[nodiscard]] std::vector<protocol::StandingRow> final_table() const;

  settings::TournamentFile file_;
  MatchHost& host_;
  std::function<SteadyTime()> now_;
  std::function<void()> on_change_;
  ledger::TournamentBook book_;
  tournament::Director director_;
  std::uint64_t seed_ = 0;
  std::map<std::uint32_t, SteadyTime> game_began_;  // the running game of a running match
  std::vector<tournament::TimedGame> timed_;
  SteadyTime began_{};
  bool over_ = false;
};

}  // namespace poolhall::net
