#include "clients/conformance/bot.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace poolhall::conformance {
namespace {

std::vector<std::string> environment_with(const std::string& server, const std::string& token) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text{*variable};
    if (!text.starts_with("POOLHALL_TOKEN=") && !text.starts_with("POOLHALL_SERVER=")) {
      variables.emplace_back(text);
    }
  }
  variables.push_back("POOLHALL_SERVER=" + server);
  variables.push_back("POOLHALL_TOKEN=" + token);
  return variables;
}

}  // namespace

std::string filled_in(std::string command, const std::string& server, const std::string& token) {
  const auto colon = server.rfind(':');
  const std::array<std::pair<std::string_view, std::string>, 4> words{
      {{"{server}", server},
       {"{host}", server.substr(0, colon)},
       {"{port}", server.substr(colon + 1)},
       {"{token}", token}}};
  for (const auto& [word, value] : words) {
    for (auto at = command.find(word); at != std::string::npos; at = command.find(word, at)) {
      command.replace(at, word.size(), value);
      at += value.size();
    }
  }
  return command;
}

Bot::Bot(std::string command, std::filesystem::path log, BotStarter starter)
    : command_(std::move(command)), log_(std::move(log)), starter_(std::move(starter)) {}

Bot::~Bot() {
  kill();
}

void Bot::start(const std::string& server, const std::string& token) {
  // $0 is the log: no quoting of its name can go wrong.
  const std::string script = "exec >>\"$0\" 2>&1\n" + filled_in(command_, server, token);
  process_ = starter_({"/bin/sh", "-c", script, log_.string()}, environment_with(server, token));
  if (!process_) {
    throw std::runtime_error("the bot's process cannot be started");
  }
}

void Bot::kill() {
  if (process_) {
    ::kill(-process_->pid, SIGKILL);
    ::kill(process_->pid, SIGKILL);  // it may not lead its group yet
    static_cast<void>(end());
  }
}

std::string Bot::end() {
  if (!process_) {
    return "it does not run";
  }
  int status = 0;
  ::waitpid(process_->pid, &status, 0);
  ::kill(-process_->pid, SIGKILL);  // what it has left behind
  ::close(process_->exit_descriptor);
  process_.reset();
  return WIFEXITED(status) ? "exit code " + std::to_string(WEXITSTATUS(status))
                           : "signal " + std::to_string(WTERMSIG(status));
}

}  // namespace poolhall::conformance
