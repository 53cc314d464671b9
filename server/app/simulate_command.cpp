// `poolhall simulate`: a scene to its event log and its final state.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "protocol/json_writer.hpp"
#include "protocol/scene_json.hpp"
#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "server/app/input.hpp"
#include "server/app/scene_run.hpp"
#include "server/app/table_svg.hpp"

namespace poolhall::app {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string svg;
  bool lines = false;
};

struct SceneOutcome {
  protocol::SceneFile file;
  SceneRun run;
};

protocol::Expected<SceneOutcome> simulate_text(const std::string& text) {
  auto file = protocol::decode_scene(text);
  if (!file) {
    return tl::unexpected(file.error());
  }
  auto run = run_scene(*file);
  if (!run) {
    return tl::unexpected(protocol::scene_error(run.error()));
  }
  return SceneOutcome{std::move(*file), std::move(*run)};
}

int exit_code_of(const SceneOutcome& outcome) {
  return outcome.run.rounded.ending == physics::Ending::event_limit ? incomplete : done;
}

// One line that names the field; the whole document has no pointer to name.
void complain(const std::string& source, const protocol::Error& error) {
  std::cerr << source << ": " << error.field << (error.field.empty() ? "" : ": ") << error.reason
            << '\n';
}

int write_svg(const std::string& path, const SceneOutcome& outcome) {
  const physics::Simulation<double>& simulation = outcome.run.rounded;
  const double until = simulation.ending == physics::Ending::t_max
                           ? outcome.file.options.t_max.value_or(simulation.duration)
                           : simulation.duration;
  std::ofstream out(path, std::ios::binary);
  out << table_svg(protocol::scene_of(outcome.file), simulation, until);
  out.close();
  if (!out) {
    std::cerr << "--svg: cannot write " << path << '\n';
    return failed;
  }
  return done;
}

int simulate_one(std::istream& in, const SimulateArguments& arguments) {
  const auto text = text_of(in);
  if (!text) {
    return cannot_read(arguments.scene, "a scene file");
  }
  const auto outcome = simulate_text(*text);
  if (!outcome) {
    complain(arguments.scene, outcome.error());
    return wrong_input;
  }
  std::cout << outcome->run.text << '\n';
  if (!arguments.svg.empty()) {
    if (const int written = write_svg(arguments.svg, *outcome); written != done) {
      return written;
    }
  }
  return exit_code_of(*outcome);
}

std::string error_line(std::size_t line, const protocol::Error& error) {
  protocol::JsonWriter out;
  out.begin_object().key("error").begin_object().key("line").integer(line);
  out.key("field").string(error.field).key("reason").string(error.reason);
  out.end_object().end_object();
  return std::move(out).text();
}

// One result a line, also for a scene that is wrong, so that the lines stay in step. The worst
// exit code of all lines, wrong input before an incomplete one.
int simulate_lines(std::istream& in, const SimulateArguments& arguments) {
  int code = done;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    const auto outcome = simulate_text(text);
    if (!outcome) {
      complain(arguments.scene + ":" + std::to_string(line), outcome.error());
      std::cout << error_line(line, outcome.error()) << '\n';
      code = wrong_input;
      continue;
    }
    std::cout << outcome->run.text << '\n';
    code = code == wrong_input ? code : std::max(code, exit_code_of(*outcome));
  }
  return in.eof() && !in.bad() ? code : cannot_read(arguments.scene, "a scene file");
}

int run_simulate(const SimulateArguments& arguments) {
  std::ios::sync_with_stdio(false);
  std::ifstream file;
  std::istream& in = input_of(arguments.scene, file);
  const int code = arguments.lines ? simulate_lines(in, arguments) : simulate_one(in, arguments);
  std::cout.flush();
  if (!std::cout) {
    std::cerr << "simulate: cannot write the result\n";
    return failed;
  }
  return code;
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Print the event log and the final state of a scene as JSON");
  command->add_option("SCENE", arguments->scene, "A scene file, or - for the standard input")
      ->required();
  auto* svg = command->add_option("--svg", arguments->svg, "Write a picture of the shot here");
  command->add_flag("--lines", arguments->lines, "Read one scene a line, write one result a line")
      ->excludes(svg);
  command->callback([arguments, &exit_code] { exit_code = run_simulate(*arguments); });
}

}  // namespace poolhall::app
