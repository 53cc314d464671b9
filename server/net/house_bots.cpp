#include "server/net/house_bots.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "server/net/child_process.hpp"
#include "server/net/session.hpp"

namespace poolhall::net {

using std::chrono::steady_clock;

namespace {

constexpr std::chrono::seconds idle_time{30};
// A process that ran this long starts with a clean record.
constexpr std::chrono::seconds long_enough{60};
constexpr std::chrono::milliseconds first_restart{200};
constexpr std::uint32_t most_doublings = 6;

}  // namespace

HouseBots::HouseBots(boost::asio::io_context& io, DeadlineQueue& deadlines)
    : io_(io), deadlines_(deadlines) {}

HouseBots::~HouseBots() {
  stop();
}

void HouseBots::configure(Settings settings) {
  settings_ = std::move(settings);
  start_waiting();
}

void HouseBots::employ(AgentBook& book, Agent& agent, HousePlayer player) {
  Employee& employee = employees_[agent.id()];
  employee.player = std::move(player);
  if (employee.token.empty()) {
    employee.token = new_token();
    book.set_token(agent, hash_of(employee.token));
  }
}

bool HouseBots::employs(storage::AgentId agent) const {
  return employees_.count(agent) > 0;
}

std::size_t HouseBots::running() const {
  return static_cast<std::size_t>(
      std::count_if(employees_.begin(), employees_.end(),
                    [](const auto& entry) { return entry.second.process.has_value(); }));
}

void HouseBots::need(storage::AgentId agent) {
  const auto found = employees_.find(agent);
  if (found == employees_.end() || stopped_) {
    return;
  }
  found->second.needed = true;
  found->second.dismissal.cancel();
  start_waiting();
}

void HouseBots::release(storage::AgentId agent) {
  const auto found = employees_.find(agent);
  if (found == employees_.end()) {
    return;
  }
  found->second.needed = false;
  found->second.dismissal =
      deadlines_.at(steady_clock::now() + idle_time, [&employee = found->second] {
        if (employee.process) {
          kill(employee.process->pid, SIGTERM);
        }
      });
}

// Those that are needed and not there, as far as the bound allows.
void HouseBots::start_waiting() {
  if (stopped_ || settings_.server.empty()) {
    return;
  }
  for (auto& [agent, employee] : employees_) {
    if (employee.needed && !employee.process && !employee.restart.is_set()) {
      if (full()) {
        spdlog::warn("house bots: {} run already, agent {} waits", settings_.bound,
                     storage::number(agent));
        return;
      }
      start(agent, employee);
    }
  }
}

void HouseBots::start(storage::AgentId agent, Employee& employee) {
  const auto child = start_child(command_line(agent, employee.player),
                                 environment(settings_.server, employee.token));
  employee.started = steady_clock::now();
  if (!child) {
    spdlog::error("house bot {} for agent {} cannot be started", employee.player.bot,
                  storage::number(agent));
    died(agent, 0);
    return;
  }
  spdlog::info("house bot {} for agent {} starts as process {}", employee.player.bot,
               storage::number(agent), child->pid);
  employee.process = Process{child->pid, std::make_unique<boost::asio::posix::stream_descriptor>(
                                             io_, child->exit_descriptor)};
  employee.process->exit->async_wait(
      boost::asio::posix::stream_descriptor::wait_read,
      [this, agent, pid = child->pid](const boost::system::error_code& error) {
        if (!error) {
          died(agent, pid);
        }
      });
}

void HouseBots::died(storage::AgentId agent, pid_t pid) {
  Employee& employee = employees_[agent];
  if (pid != 0) {
    int status = 0;
    waitpid(pid, &status, 0);
    employee.process.reset();
    spdlog::info("house bot {} for agent {} (process {}) has ended, status {}", employee.player.bot,
                 storage::number(agent), pid, status);
  }
  const SteadyTime now = steady_clock::now();
  employee.deaths = now - employee.started > long_enough ? 0 : employee.deaths + 1;
  const auto wait = first_restart * (1U << std::min(employee.deaths, most_doublings));
  employee.restart = deadlines_.at(now + wait, [this, agent] {
    employees_[agent].restart.cancel();
    start_waiting();
  });
  start_waiting();  // another one may have waited for the place
}

std::vector<std::string> HouseBots::command_line(storage::AgentId agent,
                                                 const HousePlayer& player) const {
  if (player.command) {
    return {"/bin/sh", "-c", *player.command};
  }
  std::vector<std::string> line{settings_.program.string(),
                                "bot",
                                player.bot,
                                "--connect",
                                settings_.server,
                                "--parent",
                                fmt::to_string(getpid()),
                                "--seed",
                                fmt::to_string(storage::number(agent))};
  line.insert(line.end(), player.options.begin(), player.options.end());
  return line;
}

std::vector<std::string> HouseBots::environment(const std::string& server,
                                                const std::string& token) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text{*variable};
    if (!text.starts_with("POOLHALL_TOKEN=") && !text.starts_with("POOLHALL_SERVER=") &&
        !text.starts_with("POOLHALL_FAILPOINT")) {
      variables.emplace_back(text);
    }
  }
  variables.push_back("POOLHALL_SERVER=" + server);
  variables.push_back("POOLHALL_TOKEN=" + token);
  return variables;
}

void HouseBots::stop() {
  stopped_ = true;
  for (auto& [agent, employee] : employees_) {
    employee.restart.cancel();
    employee.dismissal.cancel();
    if (employee.process) {
      // They keep nothing: what they would still do, nobody hears.
      kill(-employee.process->pid, SIGKILL);
      kill(employee.process->pid, SIGKILL);
      waitpid(employee.process->pid, nullptr, 0);
      employee.process.reset();
    }
  }
}

}  // namespace poolhall::net
