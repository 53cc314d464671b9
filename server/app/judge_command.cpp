// `poolhall judge`: a state, a call and a shot to the ruling and the next state.
#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "protocol/judge_document.hpp"
#include "server/app/commands.hpp"
#include "server/app/exit_codes.hpp"
#include "server/app/input.hpp"

namespace poolhall::app {
namespace {

int judge_one(const std::string& source, const std::string& text) {
  const auto answer = protocol::judge_document(text);
  if (!answer) {
    const protocol::Error& error = answer.error();
    std::cerr << source << ": " << error.field << (error.field.empty() ? "" : ": ") << error.reason
              << '\n';
    return wrong_input;
  }
  std::cout << *answer << '\n';
  return done;
}

int run_judge(const std::string& source) {
  std::ifstream file;
  const auto text = text_of(input_of(source, file));
  if (!text) {
    return cannot_read(source, "a JSON file");
  }
  const int code = judge_one(source, *text);
  std::cout.flush();
  if (!std::cout) {
    std::cerr << "judge: cannot write the ruling\n";
    return failed;
  }
  return code;
}

}  // namespace

void add_judge_command(CLI::App& app, int& exit_code) {
  const auto source = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "judge", "Print the referee's ruling on a shot, and the next state, as JSON");
  command
      ->add_option("FILE", *source,
                   "JSON: a state, a call, and events or a shot; - for the standard input")
      ->required();
  command->callback([source, &exit_code] { exit_code = run_judge(*source); });
}

}  // namespace poolhall::app
