// An agent that survives its server: it logs in again, repeats what was not answered under the same
// key, and writes down everything that it was told. Now and then it goes away in the middle of a
// turn, or concedes.
//
//   Survivor agent(io, traffic, {.name = "s-1", ...}, ledger);
//   agent.server_is_at(endpoint, start);     // and again after every start of the server
//   agent.challenge("s-2");
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clients/load/link.hpp"
#include "clients/load/quick_play.hpp"
#include "protocol/codec.hpp"
#include "tests/fault/harness/ledger.hpp"
#include "tests/support/session_recorder.hpp"

namespace poolhall::fault {

using SteadyTime = std::chrono::steady_clock::time_point;

struct SurvivorSettings {
  std::string name;
  std::uint64_t seed = 1;
  std::chrono::milliseconds longest_thought{60};
  double goes_away = 0.02;  // chance after an answer
  double concedes = 0.003;  // chance in a turn
};

// Of all agents of a run.
struct SurvivorCounts {
  std::uint64_t logins = 0;
  std::uint64_t repeated = 0;           // requests sent again after a login
  std::uint64_t had_been_stored = 0;    // of them
  std::uint64_t ends_learned_late = 0;  // of games that ended while the agent was away
  std::uint64_t overtaken = 0;          // answers that met the end of their game
  std::vector<std::string> complaints;  // answers that no agent should get
};

class Survivor {
 public:
  Survivor(boost::asio::io_context& io, load::Traffic& traffic, SurvivorSettings settings,
           Ledger& ledger, SurvivorCounts& counts);

  void server_is_at(const boost::asio::ip::tcp::endpoint& server, SteadyTime started);
  void server_is_gone();
  void challenge(const std::string& opponent);
  // While it is in.
  void concede_games();
  // From now on: no thoughts, no absences, no concessions; games come to their ends.
  void hurry();

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  [[nodiscard]] bool is_in() const { return stage_ == Stage::in; }
  [[nodiscard]] std::size_t games() const { return desks_.size(); }
  // Of games, that it was told of.
  [[nodiscard]] std::size_t ends() const { return ends_; }
  // How each of its games stands, for whoever asks why it does not end.
  [[nodiscard]] std::string standing() const;
  // The server knows that this agent knows of every end.
  [[nodiscard]] bool all_acknowledged() const { return acks_.empty(); }

 private:
  enum class Stage : std::uint8_t { away, connecting, logging_in, registering, in };
  struct Sent {
    std::int64_t id = 0;
    load::SeenTurn turn;
    protocol::Request request;
    bool repeated = false;
  };
  struct Desk {
    rules::Seat seat = rules::Seat::first;
    std::optional<load::SeenTurn> turn{};  // waits for its answer
    std::optional<Sent> sent{};            // waits for the server's
    bool conceding = false;
  };

  void connect();
  void go_away();
  void logged_in(std::string_view line);
  void line_came(std::string_view line);
  void reply_came(std::int64_t id, std::string_view line);
  void error_came(std::int64_t id, std::string_view line);
  void answer_refused(Desk& desk, std::string_view code, std::string_view line);
  void turn_came(std::string_view line);
  void think(std::int64_t game);
  void think_again(std::int64_t game);
  void answer(std::int64_t game, Desk& desk);
  void over(std::string_view line);
  void open_desk(std::string_view line);
  Desk* desk_of(std::string_view line);
  Desk* desk_asking(std::int64_t id);
  void send_line(std::string line);
  std::int64_t send(const protocol::Request& request);
  void after(std::chrono::milliseconds wait, std::function<void()> what);
  [[nodiscard]] bool happens(double chance);

  boost::asio::io_context& io_;
  load::Traffic& traffic_;
  SurvivorSettings settings_;
  Ledger& ledger_;
  SurvivorCounts& counts_;
  std::string token_;
  std::mt19937_64 random_;
  std::shared_ptr<load::Link> link_;
  test_support::SessionRecorder recorder_;  // of the connection
  std::optional<boost::asio::ip::tcp::endpoint> server_{};
  SteadyTime server_started_{};
  Stage stage_ = Stage::away;
  bool known_ = false;  // registered, as far as it was told
  bool hurrying_ = false;
  std::uint64_t session_ = 0;
  std::int64_t next_id_ = 1;
  std::int64_t login_id_ = 0;
  std::map<std::int64_t, Desk> desks_;
  std::set<std::int64_t> overtaken_;           // answers under way when their game ended
  std::map<std::int64_t, std::int64_t> acks_;  // games by request id
  std::uint64_t challenges_ = 0;
  std::size_t ends_ = 0;
  load::Felt felt_;
};

}  // namespace poolhall::fault
