// The sub-commands of `poolhall tournament` that talk to a running server, or read its database:
// create, start, pause, resume, abort, list, status, standings, crosstable, export.
#pragma once

namespace CLI {
class App;
}

namespace poolhall::app {

void add_tournament_calls(CLI::App& tournament, int& exit_code);

}  // namespace poolhall::app
