// What a tournament asks of the server that plays its matches. The other side of the door is a
// driver that knows the schedule (a pure function of results) and nothing of sockets or SQL.
//
//   TournamentCard card = host.open_tournament({.id = "demo", .settings = toml_text});
//   host.enter({.tournament = card.id, .name = "Anna", .house_bot = "greedy"});
//   host.on_match_over([&](const MatchOutcome& outcome) { next_pairings(outcome); });
//   host.start_match({.tournament = card.id, .pairing = 7, .agents = {"Anna", "Bob"}, .games = 4});
//
// Everything here is called on the network thread (Server::post), and the callbacks come there.
// Orders are idempotent: the key of a match is (tournament, pairing). After a restart a driver
// hands in again whatever its schedule says is due: a match that is going on goes on, one that is
// over is reported again at once, and only an unknown one begins.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/ids.hpp"
#include "protocol/messages.hpp"
#include "rules/game_state.hpp"
#include "server/ledger/scored_game.hpp"
#include "server/storage/records.hpp"

namespace poolhall::net {

using protocol::GameId;
using protocol::MatchId;
using storage::TournamentStatus;

// taken_up: tournaments in the database that ran go on, and those that are over are history;
// left_alone: each is the caller's, who may order any match again.
enum class StoredTournaments : std::uint8_t { left_alone, taken_up };

// The terms under which the games of a match are played.
struct GameTerms {
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::string table = "olympiad";      // preset
  std::string materials = "olympiad";  // preset
  std::string noise = "olympiad";      // none, low, olympiad, high, variable
  bool noise_hidden = false;           // agents are not told the level
  double rack_gap = 0;                 // m
  double rack_jitter = 0;              // m
  std::chrono::microseconds clock{std::chrono::seconds{600}};  // each player, a game
  std::chrono::microseconds increment{0};                      // added after each turn
  std::optional<std::chrono::microseconds> shot_cap{};         // longest turn; then a foul
  std::uint32_t max_refusals = 3;                              // in a turn
};

// One pairing: games between two agents. agents[0] breaks in the first game, then in turns.
struct MatchOrder {
  std::string tournament;
  std::uint32_t pairing = 0;  // unique in the tournament
  std::array<std::string, 2> agents;
  std::uint32_t games = 1;
  GameTerms terms{};
  std::uint64_t seed = 0;  // of the racks; game i of the match uses seed and i
  // Of games 2k and 2k + 1: both use the rack of seed and k. With mirrored noise they are played at
  // the same time.
  storage::Mirror mirrored = storage::Mirror::none;
};

using GameOutcome = ledger::ScoredGame;  // players are indices into MatchOrder::agents

struct MatchOutcome {
  std::string tournament;
  std::uint32_t pairing = 0;
  MatchId match{};
  std::vector<GameOutcome> games;  // scored games only, by number
};

struct TournamentEntry {
  std::string tournament;
  std::string name;                          // of the agent
  std::optional<std::string> house_bot{};    // played by a process that the server starts
  std::vector<std::string> house_options{};  // "--samples", "8": as the program takes them
  // Played by a process of somebody's that the server starts in the same way as a house bot, by
  // /bin/sh -c with POOLHALL_SERVER (HOST:PORT) and POOLHALL_TOKEN in its environment.
  std::optional<std::string> command{};
  std::uint32_t from_round = 0;  // later for late entries
  // The first round without it, once it has left; 0: before the tournament began.
  std::optional<std::uint32_t> until_round{};
};

// What a tournament that goes on makes of those who come and go now.
struct Intake {
  std::optional<std::uint32_t> late_round{};  // the first round of a late entry; none: nobody may
  std::uint32_t next_round = 1;               // the first round without who leaves
};

struct TournamentCard {
  std::string id;  // 1-32 of [A-Za-z0-9._-]
  std::string title;
  std::string settings;  // opaque to the server: the driver's own text (its TOML file)
  TournamentStatus status = TournamentStatus::open;
};

class MatchHost {
 public:
  MatchHost() = default;
  MatchHost(const MatchHost&) = delete;
  MatchHost& operator=(const MatchHost&) = delete;
  virtual ~MatchHost() = default;

  // Stores the tournament unless one of that id exists. The stored card is the answer: after a
  // restart its settings are those with which it began.
  virtual TournamentCard open_tournament(const TournamentCard& card) = 0;
  virtual void set_status(const std::string& tournament, TournamentStatus status) = 0;
  [[nodiscard]] virtual std::vector<TournamentCard> tournaments() const = 0;

  // Enters an agent; makes a house bot's agent known if need be.
  virtual void enter(const TournamentEntry& entry) = 0;
  // In the order of entering, those that joined over the wire and those that have left included.
  [[nodiscard]] virtual std::vector<TournamentEntry> entries(
      const std::string& tournament) const = 0;
  virtual void set_intake(const std::string& tournament, const Intake& intake) = 0;

  virtual void start_match(const MatchOrder& order) = 0;
  // Takes an order back whose match has not begun.
  virtual void cancel_match(const std::string& tournament, std::uint32_t pairing) = 0;
  [[nodiscard]] virtual std::vector<MatchOutcome> finished_matches(
      const std::string& tournament) const = 0;
  // Those that have begun and are not over, with the games scored so far.
  [[nodiscard]] virtual std::vector<MatchOutcome> unfinished_matches(
      const std::string& tournament) const = 0;

  // Each replaces the callback before it. A match is told after its last game is stored.
  virtual void on_match_over(std::function<void(const MatchOutcome&)> callback) = 0;
  // After each game, void ones not included; for progress displays.
  virtual void on_game_over(
      std::function<void(const MatchOrder&, const GameOutcome&)> callback) = 0;

  // An agent has come or left while the tournament goes on. Games of who has left are forfeited.
  virtual void on_entries_changed(std::function<void(const std::string& tournament)> callback) = 0;

  // Tells every agent that entered: tournament.over. The status is set_status's business.
  virtual void announce_end(const std::string& tournament,
                            const std::vector<protocol::StandingRow>& standings) = 0;
};

}  // namespace poolhall::net
