// Where a tournament is: its settings, the results so far, and the schedule that follows from
// them. The same for a tournament that is played and for one that is read from a database.
//
//   TournamentBook book(settings);
//   book.take(7, games, MatchStage::over);
//   book.plan();
//   for (const tournament::Pairing& pairing : book.schedule().pairings) ...;
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/ledger/scored_game.hpp"
#include "server/settings/tournament_settings.hpp"
#include "server/tournament/format.hpp"
#include "server/tournament/played_game.hpp"
#include "server/tournament/render.hpp"

namespace poolhall::ledger {

// Who has entered, in the order of entering.
struct Entered {
  std::string name;
  tournament::EntrySpan span{};  // until round 0: has left before the tournament began
};

enum class MatchStage : std::uint8_t { going_on, over };

class TournamentBook {
 public:
  explicit TournamentBook(const settings::TournamentSettings& settings);

  // A match that is stored, with the games scored so far.
  void take(std::uint32_t pairing, const std::vector<ScoredGame>& games, MatchStage stage);
  // False: it is there already.
  bool add_game(std::uint32_t pairing, const ScoredGame& game);
  void begin(std::uint32_t pairing) { happened_.begun.insert(pairing); }
  // Who plays: the entries of the file in its order, then who entered by themselves. Who has left
  // before the tournament began is not among them. Until this is called they are the file's.
  void set_field(const std::vector<Entered>& entered);
  void end(std::uint32_t pairing);
  // The schedule as the results now make it. Swiss rounds that were drawn are not drawn again.
  void plan();

  [[nodiscard]] const tournament::Schedule& schedule() const { return schedule_; }
  [[nodiscard]] const tournament::Pairing* pairing(std::uint32_t number) const;
  [[nodiscard]] bool is_over(std::uint32_t pairing) const {
    return happened_.results.contains(pairing);
  }
  [[nodiscard]] std::uint32_t games_played(std::uint32_t pairing) const;
  // Scored games of the schedule, in its order.
  [[nodiscard]] std::vector<tournament::PlayedGame> games() const;
  [[nodiscard]] tournament::TableRules table_rules() const;
  [[nodiscard]] const tournament::Names& names() const { return names_; }
  [[nodiscard]] const std::vector<tournament::EntrySpan>& field() const { return field_; }
  [[nodiscard]] const tournament::FormatSettings& format() const { return format_; }
  [[nodiscard]] const settings::TournamentSettings& settings() const { return settings_; }

 private:
  using Games = std::map<std::uint32_t, ScoredGame>;  // by number

  settings::TournamentSettings settings_;
  tournament::FormatSettings format_;
  tournament::Names names_;
  std::vector<tournament::EntrySpan> field_;  // by name
  std::map<std::uint32_t, Games> games_;      // by pairing
  tournament::Happened happened_;
  tournament::Schedule schedule_;
};

// What the format has to say to people, a line each: how an SPRT stands, where a lot decided.
[[nodiscard]] std::string remarks(const TournamentBook& book);

}  // namespace poolhall::ledger
