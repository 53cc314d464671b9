// Processes that play for the house: each an ordinary client with a token of its own that exists
// only in memory. Started when a game needs them, again when they die, stopped when idle; they die
// with the server, and their number is bounded.
//
//   bots.employ(agent, {.bot = "greedy"});
//   bots.need(agent.id());       // a game of this agent goes on
//   bots.release(agent.id());    // none any more
#pragma once

#include <sys/types.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/net/agent_book.hpp"
#include "server/net/deadline_queue.hpp"

namespace poolhall::net {

// How an agent of the house is played: by `program bot NAME options...`, or by /bin/sh -c command.
struct HousePlayer {
  std::string bot;
  std::vector<std::string> options{};
  std::optional<std::string> command{};
};

class HouseBots {
 public:
  struct Settings {
    std::filesystem::path program;
    std::string server;  // HOST:PORT that the bots connect to
    std::uint32_t bound = 16;
  };

  HouseBots(boost::asio::io_context& io, DeadlineQueue& deadlines);
  ~HouseBots();
  HouseBots(const HouseBots&) = delete;
  HouseBots& operator=(const HouseBots&) = delete;

  // Before the first bot can start.
  void configure(Settings settings);

  // Makes `agent` a player of the house: from now on only its process knows its token.
  void employ(AgentBook& book, Agent& agent, HousePlayer player);
  [[nodiscard]] bool employs(storage::AgentId agent) const;

  void need(storage::AgentId agent);
  void release(storage::AgentId agent);
  // Ends all of them; none starts any more.
  void stop();

  [[nodiscard]] std::size_t running() const;
  [[nodiscard]] std::uint32_t bound() const { return settings_.bound; }
  [[nodiscard]] bool full() const { return running() >= settings_.bound; }

 private:
  struct Process {
    pid_t pid = 0;
    std::unique_ptr<boost::asio::posix::stream_descriptor> exit;  // a pidfd
  };
  struct Employee {
    HousePlayer player;
    std::string token;
    bool needed = false;
    std::uint32_t deaths = 0;  // since it last ran for a while
    SteadyTime started{};
    std::optional<Process> process{};
    Deadline restart;
    Deadline dismissal;
  };

  void start(storage::AgentId agent, Employee& employee);
  void died(storage::AgentId agent, pid_t pid);
  void start_waiting();
  [[nodiscard]] std::vector<std::string> command_line(storage::AgentId agent,
                                                      const HousePlayer& player) const;
  [[nodiscard]] static std::vector<std::string> environment(const std::string& server,
                                                            const std::string& token);

  boost::asio::io_context& io_;
  DeadlineQueue& deadlines_;
  Settings settings_;
  bool stopped_ = false;
  std::map<storage::AgentId, Employee> employees_;
};

}  // namespace poolhall::net
