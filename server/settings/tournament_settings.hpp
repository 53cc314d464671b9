// What a tournament file says (config/tournaments/*.toml): format, terms of the games, entries.
// Plain values in the units of the program; every key is in config/README.md.
//
//   Expected<TournamentFile> file = load_tournament("config/tournaments/demo.toml");
//   if (!file) die(text(file.error()));
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rules/game_state.hpp"
#include "server/settings/key_doc.hpp"
#include "server/settings/settings_error.hpp"

namespace poolhall::settings {

// A house bot in a process of its own.
struct HouseEntry {
  std::string bot;                   // "greedy"
  std::vector<std::string> options;  // of its command line: "--samples", "4"
};
// Somebody's program, started by /bin/sh -c with POOLHALL_SERVER and POOLHALL_TOKEN set.
struct CommandEntry {
  std::string command;
};
// An agent that registers with the server by itself, under the entry's name.
struct AgentEntry {};

// Beyond this nobody enters a tournament.
inline constexpr std::size_t max_entries = 256;

struct EntrySettings {
  std::string name;  // of the agent; two of a tournament differ by more than the case of letters
  std::variant<HouseEntry, CommandEntry, AgentEntry> player;
};

enum class MirroredGames : std::uint8_t {
  none,   // every game has a rack of its own
  rack,   // two games in a row have the same rack, each player breaks once
  noise,  // and the same noise, as far as nobody can know it beforehand; played at the same time
};

struct GameClock {
  std::chrono::microseconds game{std::chrono::seconds{600}};  // each player, a game
  std::chrono::microseconds increment{0};                     // after each turn
  std::optional<std::chrono::microseconds> shot_cap{};        // longest turn
};

enum class MatchPace : std::uint8_t {
  free,    // a match begins as soon as the limits on concurrent games allow
  rounds,  // none of a round before all of the rounds before are over
};

// Until when agents may enter by themselves (tournament.join).
enum class Joining : std::uint8_t {
  never,
  start,  // until the tournament begins
  late,   // afterwards too, where the format takes late entries
};

// Of format "sprt".
struct SequentialTest {
  double elo0 = 0;
  double elo1 = 30;
  double alpha = 0.05;
  double beta = 0.05;
};

struct TournamentSettings {
  std::string name;  // of [A-Za-z0-9._-]; also its name in the database
  std::string format = "round_robin";
  std::uint32_t rounds = 0;  // of swiss and ladder, most matches of sprt; 0: by the format
  std::uint32_t gauntlet_runners = 1;
  MatchPace pace = MatchPace::free;
  Joining join = Joining::late;
  SequentialTest sprt;
  rules::RuleSet rules = rules::RuleSet::eight_ball;
  std::uint32_t games_per_match = 2;
  MirroredGames mirrored = MirroredGames::rack;
  std::string noise = "olympiad";    // preset, or variable
  bool noise_hidden = false;         // agents are not told the level
  std::string table = "olympiad";    // preset
  std::string physics = "olympiad";  // preset of materials
  double rack_gap = 0;               // m
  std::uint32_t max_concurrent_games = 2;
  std::uint32_t max_concurrent_games_per_entry = 1;
  std::optional<std::uint64_t> seed{};  // of the racks; unset: drawn
  std::vector<std::string> tie_breaks{"direct_encounter", "buchholz_cut1", "buchholz",
                                      "sonneborn_berger", "wins"};
  GameClock clock;
  std::vector<EntrySettings> entries;
};

// The same for names of the same agent, which differ by the case of their letters at most.
[[nodiscard]] std::string name_key(std::string_view name);

struct TournamentFile {
  TournamentSettings settings;
  std::string text;  // of the file, for the database
};

[[nodiscard]] Expected<TournamentFile> load_tournament(const std::string& file);
// The same from text; `file` is for messages.
[[nodiscard]] Expected<TournamentSettings> parse_tournament(std::string_view text,
                                                            const std::string& file);

// All keys, those of an [[entry]] as "entry.name" and so on.
[[nodiscard]] std::vector<KeyDoc> tournament_keys();

}  // namespace poolhall::settings
