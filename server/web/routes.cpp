#include "server/web/routes.hpp"

#include <array>

namespace poolhall::web {

namespace {

constexpr std::string_view tournament_file =
    "A tournament file's text (config/README.md), or the same as a JSON object";

constexpr std::array table{
    Route{"GET", "/healthz", "Whether the server works; 503 while the database takes nothing"},
    Route{.method = "GET",
          .path = "/metrics",
          .summary = "Figures in Prometheus' text format",
          .type = "text/plain"},
    Route{"GET", "/api/openapi.json", "This document"},
    Route{"GET", "/api/live", "The games that go on"},
    Route{"GET", "/api/agents", "Who is known, and how their ratings went"},
    Route{"GET", "/api/agents/{agent}", "An agent: its ratings over time, its last games"},
    Route{"GET", "/api/presets", "Tables, physics and noise levels by name, with their numbers"},
    Route{"POST", "/api/simulate", "The event log of a scene, as poolhall simulate prints it",
          Route::For::everybody, "A scene (protocol/schema/scene.schema.json)"},
    Route{"POST", "/api/evaluate", "Where the balls of a scene end under noise",
          Route::For::everybody,
          "{\"scene\": ..., \"noise\": a level's name or its numbers, \"samples\"?, \"seed\"?}"},
    Route{"GET", "/api/tournaments", "All tournaments"},
    Route{"GET", "/api/tournaments/{tournament}", "A tournament: entries, matches, results"},
    Route{.method = "GET",
          .path = "/api/tournaments.txt",
          .summary = "All tournaments, as a text for a terminal",
          .type = "text/plain"},
    Route{"GET", "/api/tournaments/{tournament}/{table}",
          "standings, crosstable (each also with .csv and .txt), trf, status.txt"},
    Route{"GET", "/api/games/{game}",
          "A game: terms, turns, result; its key once its match is over"},
    Route{"GET", "/api/games/{game}/shots/{turn}",
          "A turn: the state before and after, the events"},
    Route{"POST", "/api/admin/tournaments", "Make a tournament; it is open until it is started",
          Route::For::host, tournament_file, "201"},
    Route{"POST", "/api/admin/tournaments/{tournament}/start", "Start an open tournament",
          Route::For::host},
    Route{"POST", "/api/admin/tournaments/{tournament}/pause",
          "Begin no other game until it is resumed", Route::For::host},
    Route{"POST", "/api/admin/tournaments/{tournament}/resume", "Go on with a paused tournament",
          Route::For::host},
    Route{"POST", "/api/admin/tournaments/{tournament}/abort",
          "End a tournament now; its running games are void", Route::For::host},
    Route{"POST", "/api/admin/tournaments/{tournament}/enter",
          "Enter an agent, while a Swiss tournament or a ladder goes on too", Route::For::host,
          "{\"agent\": \"...\"}"},
    Route{"POST", "/api/admin/tournaments/{tournament}/withdraw",
          "Take an agent out; its running games are forfeited", Route::For::host,
          "{\"agent\": \"...\"}"},
    Route{"POST", "/api/admin/agents", "Add an agent; the answer has its token, this once",
          Route::For::host, "{\"name\": \"...\"}, 1 to 32 of A-Z a-z 0-9 . _ -", "201"},
    Route{"POST", "/api/admin/games/{game}/void",
          "End a running game without a result; its match plays it again", Route::For::host, "",
          "202"},
};

bool is_parameter(std::string_view segment) {
  return segment.starts_with('{');
}

// The next segment, taken off the path; both begin with a slash.
std::string_view take_segment(std::string_view& path) {
  path.remove_prefix(1);
  const std::string_view segment = path.substr(0, path.find('/'));
  path.remove_prefix(segment.size());
  return segment;
}

bool fits(std::string_view pattern, std::string_view path) {
  while (pattern.starts_with('/') && path.starts_with('/')) {
    const std::string_view wanted = take_segment(pattern);
    const std::string_view came = take_segment(path);
    if (is_parameter(wanted) ? came.empty() : came != wanted) {
      return false;
    }
  }
  return pattern.empty() && path.empty();
}

}  // namespace

std::span<const Route> routes() {
  return table;
}

Routing route_of(std::string_view method, std::string_view path) {
  const std::string_view wanted = method == "HEAD" ? "GET" : method;
  NoRoute missing = NoRoute::path;
  for (const Route& route : table) {
    if (!fits(route.path, path)) {
      continue;
    }
    if (route.method == wanted) {
      return &route;
    }
    missing = NoRoute::method;
  }
  return missing;
}

}  // namespace poolhall::web
