#include "server/net/house_bots.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
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
// How long a process that is dismissed may take to go.
constexpr std::chrono::seconds parting_time{5};

// A command's process may have children.
void signal_all(pid_t pid, int signal) {
  kill(-pid, signal);
  kill(pid, signal);
}

}  // namespace

HouseBots::HouseBots(boost::asio::io_context& io, DeadlineQueue& deadlines)
    : io_(io), deadlines_(deadlines) {}

HouseBots::~HouseBots() {
  stop();
}

void HouseBots::configure(Settings settings) {
  settings_ = std::move(settings);
  give_places();
}

void HouseBots::employ(AgentBook& book, Agent& agent, HousePlayer player) {
  Employee& employee = employees_[agent.id()];
  employee.player = std::move(player);
  if (employee.token.empty()) {
    employee.token = new_token();
    book.set_token(agent, hash_of(employee.token));
  }
}

std::size_t HouseBots::running() const {
  return static_cast<std::size_t>(
      std::count_if(employees_.begin(), employees_.end(),
                    [](const auto& entry) { return entry.second.process.has_value(); }));
}

std::size_t HouseBots::places_taken() const {
  return static_cast<std::size_t>(
      std::count_if(employees_.begin(), employees_.end(),
                    [](const auto& entry) { return entry.second.games > 0; }));
}

std::size_t HouseBots::lacking(const Players& players) const {
  return static_cast<std::size_t>(
      std::count_if(players.begin(), players.end(),
                    [this](storage::AgentId agent) { return employees_.at(agent).games == 0; }));
}

bool HouseBots::would_wait(storage::AgentId agent) const {
  const auto found = employees_.find(agent);
  const bool has_place = found != employees_.end() && found->second.games > 0;
  return !has_place && full();
}

void HouseBots::need(protocol::GameId game, const std::array<storage::AgentId, 2>& agents) {
  Players players;
  std::copy_if(agents.begin(), agents.end(), std::back_inserter(players),
               [this](storage::AgentId agent) { return employs(agent); });
  if (players.empty() || stopped_) {
    return;
  }
  Players& known = games_[game];
  if (known == players) {
    return;
  }
  take_back(game, known);
  known = std::move(players);
  waiting_.insert(game);
  give_places();
}

void HouseBots::release(protocol::GameId game) {
  const auto found = games_.find(game);
  if (found == games_.end()) {
    return;
  }
  const Players players = std::move(found->second);
  games_.erase(found);
  take_back(game, players);
  give_places();
}

void HouseBots::take_back(protocol::GameId game, const Players& players) {
  if (waiting_.erase(game) == 0) {
    promised_.erase(game);
    let_go(players);
  }
}

void HouseBots::let_go(const Players& players) {
  for (const storage::AgentId agent : players) {
    Employee& employee = employees_.at(agent);
    if (--employee.games > 0) {
      continue;
    }
    employee.dismissal = deadlines_.at(steady_clock::now() + idle_time, [this, &employee] {
      if (employee.process) {
        dismiss(*employee.process);
      }
    });
  }
}

void HouseBots::give_places() {
  std::size_t taken = places_taken();
  bool one_waits = false;  // nobody overtakes it, but with bots that play already
  for (auto next = waiting_.begin(); next != waiting_.end();) {
    const protocol::GameId game = *next;
    const Players& players = games_.at(game);
    const std::size_t lacks = lacking(players);
    if (lacks > 0 && (one_waits || taken + lacks > settings_.bound)) {
      tell_waiting(game, players);
      one_waits = one_waits || players.size() <= settings_.bound;  // else it waits for ever
      ++next;
      continue;
    }
    for (const storage::AgentId agent : players) {
      Employee& employee = employees_.at(agent);
      ++employee.games;
      employee.dismissal.cancel();
    }
    taken += lacks;
    promised_.insert(game);
    next = waiting_.erase(next);
  }
  start_missing();
}

void HouseBots::tell_waiting(protocol::GameId game, const Players& players) {
  for (const storage::AgentId agent : players) {
    Employee& employee = employees_.at(agent);
    if (employee.games > 0 || std::exchange(employee.has_waited, true)) {
      continue;
    }
    if (players.size() > settings_.bound) {
      spdlog::error("house bots: game {} needs {} at a time and stands: max_house_bots is {}",
                    protocol::number(game), players.size(), settings_.bound);
    } else {
      spdlog::warn("house bots: agent {} waits for one of {} places (max_house_bots)",
                   storage::number(agent), settings_.bound);
    }
  }
}

// The processes of those that have places.
void HouseBots::start_missing() {
  if (stopped_ || settings_.server.empty()) {
    return;
  }
  auto leaving = std::count_if(employees_.begin(), employees_.end(), [](const auto& entry) {
    return entry.second.games == 0 && entry.second.process && entry.second.process->dismissed;
  });
  for (auto& [agent, employee] : employees_) {
    if (employee.games == 0 || employee.process || employee.restart.is_set()) {
      continue;
    }
    if (running() < settings_.bound) {
      start(agent, employee);
    } else if (leaving > 0) {
      --leaving;  // it starts when that one has gone
    } else {
      dismiss_an_idle_one();
    }
  }
  keep_promises();
}

void HouseBots::keep_promises() {
  const auto can_come = [this](storage::AgentId agent) {
    const Employee& employee = employees_.at(agent);
    return employee.process ? !employee.process->dismissed : employee.restart.is_set();
  };
  std::vector<protocol::GameId> kept;
  std::copy_if(promised_.begin(), promised_.end(), std::back_inserter(kept),
               [&](protocol::GameId game) {
                 const Players& players = games_.at(game);
                 return std::all_of(players.begin(), players.end(), can_come);
               });
  for (const protocol::GameId game : kept) {
    promised_.erase(game);
  }
  for (const protocol::GameId game : kept) {
    if (on_places_) {
      on_places_(game);
    }
  }
}

void HouseBots::dismiss_an_idle_one() {
  for (auto& [agent, employee] : employees_) {
    if (employee.games == 0 && employee.process && !employee.process->dismissed) {
      dismiss(*employee.process);
      return;
    }
  }
}

void HouseBots::dismiss(Process& process) {
  process.dismissed = true;
  signal_all(process.pid, SIGTERM);
  process.last_resort = deadlines_.at(steady_clock::now() + parting_time,
                                      [pid = process.pid] { signal_all(pid, SIGKILL); });
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
  bool dismissed = false;
  if (pid != 0) {
    int status = 0;
    waitpid(pid, &status, 0);
    dismissed = employee.process->dismissed;
    employee.process.reset();
    spdlog::info("house bot {} for agent {} (process {}) has ended, status {}", employee.player.bot,
                 storage::number(agent), pid, status);
  }
  if (!dismissed) {
    const SteadyTime now = steady_clock::now();
    employee.deaths = now - employee.started > long_enough ? 0 : employee.deaths + 1;
    const auto wait = first_restart * (1U << std::min(employee.deaths, most_doublings));
    employee.restart = deadlines_.at(now + wait, [this, agent] {
      employees_[agent].restart.cancel();
      start_missing();
    });
  }
  start_missing();  // another one may have waited for the process to go
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
      signal_all(employee.process->pid, SIGKILL);
      waitpid(employee.process->pid, nullptr, 0);
      employee.process.reset();
    }
  }
}

}  // namespace poolhall::net
