// Processes that play for the house: each an ordinary client with a token of its own that exists
// only in memory. Started when a game needs them, again when they die, stopped when idle; they die
// with the server, and their number is bounded.
//
// A game gets the places that it lacks all at once, or waits and holds none: so games never wait
// for each other's places for ever. They get them in the order of their ids; a game all of whose
// bots play already lacks none and does not wait.
//
//   bots.employ(book, agent, {.bot = "greedy"});
//   bots.need(game, agents);          // it is to be played
//   if (bots.has_places(game)) ...    // its bots run or come
//   bots.release(game);               // it is over
#pragma once

#include <sys/types.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
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

  // A game that waited has its places.
  void on_places(std::function<void(protocol::GameId)> callback) {
    on_places_ = std::move(callback);
  }

  // Makes `agent` a player of the house: from now on only its process knows its token.
  void employ(AgentBook& book, Agent& agent, HousePlayer player);
  [[nodiscard]] bool employs(storage::AgentId agent) const { return employees_.contains(agent); }

  // Agents that are not the house's need no place. Again when one of them has become the house's.
  void need(protocol::GameId game, const std::array<storage::AgentId, 2>& agents);
  void release(protocol::GameId game);
  // Its bots' processes run, or failed by themselves.
  [[nodiscard]] bool has_places(protocol::GameId game) const {
    return !waiting_.contains(game) && !promised_.contains(game);
  }
  // Ends all of them; none starts any more.
  void stop();

  [[nodiscard]] std::size_t running() const;
  [[nodiscard]] std::uint32_t bound() const { return settings_.bound; }
  // No place is left; processes that no game needs do not count.
  [[nodiscard]] bool full() const { return places_taken() >= settings_.bound; }
  // Whether a game of this agent would wait, if it began now and played nobody else of the house.
  [[nodiscard]] bool would_wait(storage::AgentId agent) const;

 private:
  struct Process {
    pid_t pid = 0;
    std::unique_ptr<boost::asio::posix::stream_descriptor> exit;  // a pidfd
    bool dismissed = false;
    Deadline last_resort{};  // for one that is dismissed and does not go
  };
  struct Employee {
    HousePlayer player;
    std::string token;
    std::uint32_t games = 0;   // that have places; it holds one if there is any
    bool has_waited = false;   // said once
    std::uint32_t deaths = 0;  // since it last ran for a while
    SteadyTime started{};
    std::optional<Process> process{};
    Deadline restart;
    Deadline dismissal;
  };
  using Players = std::vector<storage::AgentId>;  // of the house, in one game

  [[nodiscard]] std::size_t places_taken() const;
  [[nodiscard]] std::size_t lacking(const Players& players) const;
  void take_back(protocol::GameId game, const Players& players);
  void let_go(const Players& players);
  void give_places();
  void tell_waiting(protocol::GameId game, const Players& players);
  void start_missing();
  void keep_promises();
  void start(storage::AgentId agent, Employee& employee);
  void dismiss_an_idle_one();
  void dismiss(Process& process);
  void died(storage::AgentId agent, pid_t pid);
  [[nodiscard]] std::vector<std::string> command_line(storage::AgentId agent,
                                                      const HousePlayer& player) const;
  [[nodiscard]] static std::vector<std::string> environment(const std::string& server,
                                                            const std::string& token);

  boost::asio::io_context& io_;
  DeadlineQueue& deadlines_;
  Settings settings_;
  bool stopped_ = false;
  std::map<storage::AgentId, Employee> employees_;
  std::map<protocol::GameId, Players> games_;  // with players of the house
  std::set<protocol::GameId> waiting_;         // those of them that have no places yet
  std::set<protocol::GameId> promised_;        // that have them, once others' processes have gone
  std::function<void(protocol::GameId)> on_places_;
};

}  // namespace poolhall::net
