#include "server/settings/tournament_settings.hpp"

#include <algorithm>
#include <bit>
#include <set>

#include <fmt/format.h>

#include "physics/materials.hpp"
#include "physics/table.hpp"
#include "server/settings/files.hpp"
#include "server/settings/keys.hpp"

namespace poolhall::settings {
namespace {

constexpr std::size_t min_entries = 2;

// "8-ball", "9-ball" in the file.
struct Rules {
  using Value = rules::RuleSet;
  static std::string expected() { return R"(one of "8-ball", "9-ball")"; }
  static std::optional<Value> read(const Node& node) {
    const auto* word = std::get_if<std::string>(&node.value);
    return word == nullptr ? std::nullopt : rules::rule_set(*word);
  }
  static std::string write(Value value) { return fmt::format("\"{}\"", rules::name(value)); }
};

std::string_view name(MirroredGames mirrored) {
  switch (mirrored) {
    case MirroredGames::rack:
      return "rack";
    case MirroredGames::noise:
      return "noise";
    case MirroredGames::none:
      break;
  }
  return "none";
}

struct Mirrored {
  using Value = MirroredGames;
  static std::string expected() { return R"(one of "rack", "noise", "none")"; }
  static std::optional<Value> read(const Node& node) {
    const auto word = OneOf{{"rack", "noise", "none"}}.read(node);
    if (!word) {
      return std::nullopt;
    }
    if (*word == "noise") {
      return MirroredGames::noise;
    }
    return *word == "rack" ? MirroredGames::rack : MirroredGames::none;
  }
  static std::string write(Value value) { return fmt::format("\"{}\"", name(value)); }
};

struct PaceKind {
  using Value = MatchPace;
  static std::string expected() { return R"(one of "free", "rounds")"; }
  static std::optional<Value> read(const Node& node) {
    const auto word = OneOf{{"free", "rounds"}}.read(node);
    if (!word) {
      return std::nullopt;
    }
    return *word == "free" ? MatchPace::free : MatchPace::rounds;
  }
  static std::string write(Value value) {
    return value == MatchPace::free ? "\"free\"" : "\"rounds\"";
  }
};

struct JoinKind {
  using Value = Joining;
  static std::string expected() { return R"(one of "late", "start", "never")"; }
  static std::optional<Value> read(const Node& node) {
    const auto word = OneOf{{"late", "start", "never"}}.read(node);
    if (!word) {
      return std::nullopt;
    }
    if (*word == "late") {
      return Joining::late;
    }
    return *word == "start" ? Joining::start : Joining::never;
  }
  static std::string write(Value value) {
    return value == Joining::late    ? "\"late\""
           : value == Joining::start ? "\"start\""
                                     : "\"never\"";
  }
};

// {samples = 4, seed = 7} in the file, --effort 3000 --seed 7 for the program.
struct Options {
  using Value = std::vector<std::string>;
  static std::string expected() {
    return "a table of the bot's options, {effort = 3000}: names of a-z 0-9 -, each with a number, "
           "a string or true";
  }
  static std::optional<Value> read(const Node& node) {
    const auto* table = std::get_if<Table>(&node.value);
    if (table == nullptr) {
      return std::nullopt;
    }
    Value words;
    for (const Member& member : *table) {
      const auto value = word_of(member.node);
      if (!is_option(member.key) || !value) {
        return std::nullopt;
      }
      words.push_back("--" + member.key);
      if (!value->empty()) {
        words.push_back(*value);
      }
    }
    return words;
  }
  static std::string write(const Value& value) { return value.empty() ? "{}" : ""; }

 private:
  static bool is_option(const std::string& key) {
    return !key.empty() && key.front() != '-' &&
           key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
  }
  static std::optional<std::string> word_of(const Node& node) {
    if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
      return fmt::format("{}", *whole);
    }
    if (const auto* number = std::get_if<double>(&node.value)) {
      return fmt::format("{}", *number);
    }
    if (const auto* flag = std::get_if<bool>(&node.value)) {
      return *flag ? std::optional(std::string{}) : std::nullopt;
    }
    return Line{"", 256}.read(node);
  }
};

void add_clock_keys(Keys<TournamentSettings>& keys) {
  keys.add(
      "clock.game_seconds", Seconds{1, 86400}, [](auto& s) -> auto& { return s.clock.game; });
  keys.add(
      "clock.increment_seconds", Seconds{0, 3600},
      [](auto& s) -> auto& { return s.clock.increment; });
  keys.add(
      "clock.shot_cap_seconds", Seconds{0.1, 86400},
      [](auto& s) -> auto& { return s.clock.shot_cap; });
}

void add_sprt_keys(Keys<TournamentSettings>& keys) {
  keys.add(
      "sprt.elo0", Number{-1000, 1000}, [](auto& s) -> auto& { return s.sprt.elo0; });
  keys.add(
      "sprt.elo1", Number{-1000, 1000}, [](auto& s) -> auto& { return s.sprt.elo1; });
  keys.add(
      "sprt.alpha", Number{0.0001, 0.4}, [](auto& s) -> auto& { return s.sprt.alpha; });
  keys.add(
      "sprt.beta", Number{0.0001, 0.4}, [](auto& s) -> auto& { return s.sprt.beta; });
}

Keys<TournamentSettings> tournament_key_table() {
  Keys<TournamentSettings> keys;
  keys.add(
      "name", Name{}, [](auto& s) -> auto& { return s.name; });
  keys.add(
      "format",
      OneOf{{"round_robin", "swiss", "single_elimination", "double_elimination", "gauntlet",
             "ladder", "sprt"}},
      [](auto& s) -> auto& { return s.format; });
  keys.add(
      "rounds", WholeNumber{0, 100'000}, [](auto& s) -> auto& { return s.rounds; });
  keys.add(
      "gauntlet_runners", WholeNumber{1, 255}, [](auto& s) -> auto& { return s.gauntlet_runners; });
  keys.add(
      "pace", PaceKind{}, [](auto& s) -> auto& { return s.pace; });
  keys.add(
      "join", JoinKind{}, [](auto& s) -> auto& { return s.join; });
  keys.add(
      "rules", Rules{}, [](auto& s) -> auto& { return s.rules; });
  keys.add(
      "games_per_match", WholeNumber{1, 10'000},
      [](auto& s) -> auto& { return s.games_per_match; });
  keys.add(
      "mirrored", Mirrored{}, [](auto& s) -> auto& { return s.mirrored; });
  keys.add(
      "noise", OneOf{{"none", "low", "olympiad", "high", "variable"}},
      [](auto& s) -> auto& { return s.noise; });
  keys.add(
      "noise_hidden", Flag{}, [](auto& s) -> auto& { return s.noise_hidden; });
  keys.add(
      "table", Preset{"the name of a table preset", physics::preset_table_names()},
      [](auto& s) -> auto& { return s.table; });
  keys.add(
      "physics", Preset{"the name of a materials preset", physics::preset_material_names()},
      [](auto& s) -> auto& { return s.physics; });
  keys.add(
      "rack_gap_mm", Millimetres{0, 5}, [](auto& s) -> auto& { return s.rack_gap; });
  keys.add(
      "max_concurrent_games", WholeNumber{1, 10'000},
      [](auto& s) -> auto& { return s.max_concurrent_games; });
  keys.add(
      "max_concurrent_games_per_entry", WholeNumber{1, 10'000},
      [](auto& s) -> auto& { return s.max_concurrent_games_per_entry; });
  // JSON readers keep whole numbers below 2^53.
  keys.add(
      "seed", WholeNumber{0, (std::int64_t{1} << 53) - 1}, [](auto& s) -> auto& { return s.seed; });
  keys.add(
      "tie_breaks",
      SomeOf{{"direct_encounter", "buchholz_cut1", "buchholz", "sonneborn_berger", "wins"}},
      [](auto& s) -> auto& { return s.tie_breaks; });
  add_sprt_keys(keys);
  add_clock_keys(keys);
  keys.leave("entry");
  return keys;
}

// An entry before it is known who plays it.
struct RawEntry {
  std::optional<std::string> name;
  std::optional<std::string> house;
  std::optional<std::string> command;
  std::optional<std::string> agent;
  std::vector<std::string> options;
};

Keys<RawEntry> make_entry_keys() {
  Keys<RawEntry> keys;
  keys.add(
      "name", Name{}, [](auto& s) -> auto& { return s.name; });
  keys.add(
      "house", Name{}, [](auto& s) -> auto& { return s.house; });
  keys.add(
      "options", Options{}, [](auto& s) -> auto& { return s.options; });
  keys.add(
      "command", Line{"a command line for /bin/sh"}, [](auto& s) -> auto& { return s.command; });
  keys.add(
      "agent", Name{}, [](auto& s) -> auto& { return s.agent; });
  return keys;
}

tl::unexpected<SettingsError> refuse(const std::string& file, const Position& at,
                                     std::string reason) {
  return tl::unexpected(SettingsError{file, at.line, at.column, std::move(reason)});
}

Expected<EntrySettings> entry_of(const RawEntry& raw, const std::string& file, const Position& at) {
  const int players = (raw.house ? 1 : 0) + (raw.command ? 1 : 0) + (raw.agent ? 1 : 0);
  if (players != 1) {
    return refuse(
        file, at,
        fmt::format("entry: {} of house, command and agent came, expected exactly one", players));
  }
  if (!raw.house && !raw.options.empty()) {
    return refuse(file, at, "entry: options came without house, expected them only with house");
  }
  if (raw.agent) {
    if (raw.name) {
      return refuse(file, at, "entry: name came with agent, expected agent alone: it is the name");
    }
    return EntrySettings{*raw.agent, AgentEntry{}};
  }
  if (raw.house) {
    return EntrySettings{raw.name.value_or(*raw.house), HouseEntry{*raw.house, raw.options}};
  }
  if (!raw.name) {
    return refuse(file, at, "entry: no name came with command, expected " + Name::expected());
  }
  return EntrySettings{*raw.name, CommandEntry{*raw.command}};
}

Expected<EntrySettings> read_entry(const Node& node, const std::string& file) {
  if (!std::holds_alternative<Table>(node.value)) {
    return refuse(file, node.at,
                  fmt::format("entry: {} came, expected [[entry]] tables", describe(node)));
  }
  RawEntry raw;
  if (auto done = make_entry_keys().read(node, file, raw); !done) {
    return tl::unexpected(done.error());
  }
  return entry_of(raw, file, node.at);
}

Expected<std::vector<EntrySettings>> read_entries(const Node& root, const std::string& file) {
  const Node* node = root.find("entry");
  const auto* elements = node == nullptr ? nullptr : std::get_if<Array>(&node->value);
  if (elements == nullptr || elements->size() < min_entries || elements->size() > max_entries) {
    return refuse(
        file, node == nullptr ? root.at : node->at,
        fmt::format("entry: {} came, expected {} to {} [[entry]] tables",
                    elements == nullptr ? std::string("none") : fmt::format("{}", elements->size()),
                    min_entries, max_entries));
  }
  std::vector<EntrySettings> entries;
  std::set<std::string> names;
  for (const Node& element : *elements) {
    auto entry = read_entry(element, file);
    if (!entry) {
      return tl::unexpected(entry.error());
    }
    if (!names.insert(name_key(entry->name)).second) {
      return refuse(file, element.at,
                    fmt::format("entry: the name \"{}\" came twice (letters' case does not "
                                "count), expected a name of its own for every entry",
                                entry->name));
    }
    entries.push_back(*std::move(entry));
  }
  return entries;
}

Expected<void> check_together(const TournamentSettings& settings, const Node& root,
                              const std::string& file) {
  if (settings.name.empty()) {
    return refuse(file, root.at, "name: nothing came, expected " + Name::expected());
  }
  if (settings.mirrored != MirroredGames::none && settings.games_per_match % 2 != 0) {
    const Node* games = root.find("games_per_match");
    return refuse(file, games == nullptr ? root.at : games->at,
                  fmt::format("games_per_match: {} came, expected an even number, since mirrored "
                              "= \"{}\" plays every rack twice",
                              settings.games_per_match, name(settings.mirrored)));
  }
  return {};
}

Expected<void> refuse_key(const Node& root, const std::string& file, std::string_view key,
                          std::string reason) {
  const Node* node = root.find(key);
  return refuse(file, node == nullptr ? root.at : node->at, std::move(reason));
}

Expected<void> check_sprt(const TournamentSettings& settings, const Node& root,
                          const std::string& file) {
  if (settings.entries.size() != 2) {
    return refuse_key(
        root, file, "entry",
        fmt::format("entry: {} came, expected 2 for format = \"sprt\"", settings.entries.size()));
  }
  if (settings.games_per_match % 2 != 0) {
    return refuse_key(root, file, "games_per_match",
                      fmt::format("games_per_match: {} came, expected an even number: an SPRT "
                                  "counts pairs of games",
                                  settings.games_per_match));
  }
  if (settings.rounds == 0) {
    return refuse_key(root, file, "rounds",
                      "rounds: 0 came, expected the most matches that an SPRT may take");
  }
  if (settings.sprt.elo0 >= settings.sprt.elo1) {
    return refuse_key(root, file, "sprt",
                      fmt::format("sprt.elo1: {} came, expected more than sprt.elo0 = {}",
                                  settings.sprt.elo1, settings.sprt.elo0));
  }
  return {};
}

// What the format asks of rounds and entries.
Expected<void> check_format(const TournamentSettings& settings, const Node& root,
                            const std::string& file) {
  const std::size_t entries = settings.entries.size();
  const auto most_rounds = static_cast<std::uint32_t>(std::bit_width(entries - 1)) + 1;
  if (settings.format == "swiss" && settings.rounds > most_rounds) {
    return refuse_key(root, file, "rounds",
                      fmt::format("rounds: {} came, expected at most {} for a Swiss tournament of "
                                  "{} entries",
                                  settings.rounds, most_rounds, entries));
  }
  if (settings.format == "gauntlet" && settings.gauntlet_runners >= entries) {
    return refuse_key(root, file, "gauntlet_runners",
                      fmt::format("gauntlet_runners: {} came, expected fewer than the {} entries",
                                  settings.gauntlet_runners, entries));
  }
  return settings.format == "sprt" ? check_sprt(settings, root, file) : Expected<void>{};
}

}  // namespace

std::string name_key(std::string_view name) {
  std::string key{name};
  std::transform(key.begin(), key.end(), key.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return key;
}

Expected<TournamentSettings> parse_tournament(std::string_view text, const std::string& file) {
  auto root = parse_document(text, file);
  if (!root) {
    return tl::unexpected(root.error());
  }
  TournamentSettings settings;
  if (auto done = tournament_key_table().read(*root, file, settings); !done) {
    return tl::unexpected(done.error());
  }
  if (auto done = check_together(settings, *root, file); !done) {
    return tl::unexpected(done.error());
  }
  auto entries = read_entries(*root, file);
  if (!entries) {
    return tl::unexpected(entries.error());
  }
  settings.entries = *std::move(entries);
  if (auto done = check_format(settings, *root, file); !done) {
    return tl::unexpected(done.error());
  }
  return settings;
}

Expected<TournamentFile> load_tournament(const std::string& file) {
  return read_file(file).and_then([&](const std::string& text) -> Expected<TournamentFile> {
    return parse_tournament(text, file).map([&](TournamentSettings settings) {
      return TournamentFile{std::move(settings), text};
    });
  });
}

std::vector<KeyDoc> tournament_keys() {
  std::vector<KeyDoc> keys = tournament_key_table().documentation();
  const auto required =
      std::find_if(keys.begin(), keys.end(), [](const KeyDoc& key) { return key.name == "name"; });
  required->default_value.reset();
  for (KeyDoc& key : make_entry_keys().documentation()) {
    key.name.insert(0, "entry.");
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace poolhall::settings
