// `poolhall replay GAME`: a stored game in words, one of its shots as a picture.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"
#include "server/app/commands.hpp"
#include "server/app/game_sheet.hpp"
#include "server/app/replay_text.hpp"
#include "server/app/table_svg.hpp"
#include "server/match/play_shot.hpp"
#include "server/storage/sqlite_database.hpp"

namespace poolhall::app {
namespace {

struct ReplayArguments {
  std::int64_t game = 0;
  std::optional<std::uint32_t> turn;
  std::string database = "poolhall.db";
  std::optional<std::string> svg;
  bool ascii = false;
};

template <class T>
using Outcome = tl::expected<T, std::string>;

std::string reason(const protocol::Error& error) {
  return error.field + ": " + error.reason;
}
std::string reason(const rules::Refusal& refusal) {
  return refusal.reason;
}

struct StoredGame {
  storage::GameRecord record;
  std::array<std::string, 2> players;
  std::vector<storage::TurnRecord> turns;
};

Outcome<StoredGame> read_game(const ReplayArguments& arguments) {
  auto reader = storage::open_sqlite_reader(arguments.database);
  if (!reader)
    return tl::unexpected(reader.error().reason);
  const auto record = (*reader)->game(protocol::GameId{arguments.game});
  if (!record)
    return tl::unexpected(record.error().reason);
  if (!*record)
    return tl::unexpected(fmt::format("{}: no game {}", arguments.database, arguments.game));
  StoredGame game{.record = **record, .players = {}, .turns = {}};
  for (std::size_t seat = 0; seat < 2; ++seat) {
    const auto agent = (*reader)->agent(game.record.agents[seat]);
    if (!agent)
      return tl::unexpected(agent.error().reason);
    game.players[seat] = *agent ? (**agent).name : "?";
  }
  const auto read = (*reader)->each_turn(game.record.id, [&](const storage::TurnRecord& turn) {
    game.turns.push_back(turn);
    return true;
  });
  if (!read)
    return tl::unexpected(read.error().reason);
  return game;
}

// What was simulated, from the stored log alone.
struct StoredShot {
  physics::Scene<double> scene;
  physics::Simulation<double> simulation;
};

Outcome<StoredShot> stored_shot(const storage::GameRecord& game, const storage::TurnRecord& turn) {
  const auto board = match::preset_board(game.terms.table, game.terms.materials);
  const auto before = protocol::decode_state(turn.state_before);
  const auto events = protocol::decode_events(turn.shot->events);
  if (!board || !before || !events)
    return tl::unexpected(!board    ? "unknown table " + game.terms.table
                          : !before ? reason(before.error())
                                    : reason(events.error()));
  const auto ready = rules::prepare_shot(*before, turn.shot->call, turn.shot->cue_ball,
                                         board->table, board->materials);
  if (!ready)
    return tl::unexpected(reason(ready.error()));
  StoredShot shot{.scene = match::scene_of(*ready, *board, turn.shot->executed), .simulation = {}};
  shot.simulation.balls = shot.scene.balls;
  shot.simulation.events = *events;
  for (const auto& event : *events) {
    shot.simulation.duration = event.t;
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      for (physics::Ball<double>& ball : shot.simulation.balls) {
        if (ball.id == event.after[i].id)
          ball = event.after[i];
      }
    }
  }
  return shot;
}

Outcome<void> write_file(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out)
    return tl::unexpected(file + ": cannot be written");
  return {};
}

Outcome<SheetShot> drawn(const StoredGame& game, const storage::TurnRecord& turn) {
  const auto shot = stored_shot(game.record, turn);
  if (!shot)
    return tl::unexpected(shot.error());
  const auto size = picture_size(shot->scene.table);
  return SheetShot{fmt::format("{} {}", turn.number, game.players[index(turn.seat)]),
                   table_svg(shot->scene, shot->simulation, shot->simulation.duration), size.x,
                   size.y};
}

Outcome<void> draw(const StoredGame& game, const storage::TurnRecord& turn,
                   const std::string& file) {
  if (!turn.shot)
    return tl::unexpected(fmt::format("turn {} has no shot to draw", turn.number));
  const auto shot = drawn(game, turn);
  return shot ? write_file(file, shot->picture) : tl::unexpected(shot.error());
}

Outcome<void> draw_sheet(const StoredGame& game, const std::string& title,
                         const std::string& file) {
  std::vector<SheetShot> shots;
  for (const storage::TurnRecord& turn : game.turns) {
    if (!turn.shot)
      continue;
    auto shot = drawn(game, turn);
    if (!shot)
      return tl::unexpected(shot.error());
    shots.push_back(std::move(*shot));
  }
  return write_file(file, game_sheet(title, shots));
}

Outcome<void> show_turn(const StoredGame& game, const storage::TurnRecord& turn,
                        const ReplayArguments& arguments) {
  fmt::print("{}\n", turn_words(turn, game.players));
  if (arguments.ascii) {
    const auto board = match::preset_board(game.record.terms.table, game.record.terms.materials);
    const auto after = protocol::decode_state(turn.state_after);
    if (!board || !after)
      return tl::unexpected(!board ? "unknown table " + game.record.terms.table
                                   : reason(after.error()));
    fmt::print("{}", table_text(*after, board->table));
  }
  return arguments.svg && arguments.turn ? draw(game, turn, *arguments.svg) : Outcome<void>{};
}

Outcome<void> replay(const ReplayArguments& arguments) {
  const auto game = read_game(arguments);
  if (!game)
    return tl::unexpected(game.error());
  const std::string title =
      fmt::format("game {}: {} against {}, {} on {}, noise {}", arguments.game, game->players[0],
                  game->players[1], rules::name(game->record.terms.rules), game->record.terms.table,
                  game->record.terms.noise);
  fmt::print("{}\n", title);
  if (arguments.svg && !arguments.turn) {
    if (auto sheet = draw_sheet(*game, title, *arguments.svg); !sheet)
      return sheet;
  }
  bool is_found = !arguments.turn;
  for (const storage::TurnRecord& turn : game->turns) {
    if (arguments.turn && turn.number != *arguments.turn)
      continue;
    is_found = true;
    if (auto shown = show_turn(*game, turn, arguments); !shown)
      return shown;
  }
  if (is_found)
    return {};
  return tl::unexpected(fmt::format("game {} has no turn {}; its turns are 1 to {}", arguments.game,
                                    *arguments.turn, game->turns.size()));
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand("replay", "Show a stored game turn by turn");
  command->add_option("game", arguments->game, "number of the game")->required();
  command->add_option("--shot", arguments->turn, "only the turn with this number");
  command->add_option("--db", arguments->database, "database file")->capture_default_str();
  command->add_option("--svg", arguments->svg,
                      "write a picture of the shot, or of all shots, to this file");
  command->add_flag("--ascii", arguments->ascii,
                    "show the table after each turn, head at the left: o is the cue ball, A to F "
                    "are 10 to 15, O pockets");
  command->callback([arguments, &exit_code] {
    const auto done = replay(*arguments);
    if (!done)
      fmt::print(stderr, "poolhall replay: {}\n", done.error());
    exit_code = done ? 0 : 1;
  });
}

}  // namespace poolhall::app
