// One agent of a load: logs in, answers what belongs to a game, and tells the run of the rest.
//
//   LoadAgent agent(io, traffic, {.name = "load-1", .detail = ...}, run);
//   agent.connect(endpoint);
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "clients/load/link.hpp"
#include "clients/load/quick_play.hpp"

namespace poolhall::load {

using SteadyTime = std::chrono::steady_clock::time_point;

class LoadAgent;

// What an agent tells of itself.
class Overseer {
 public:
  Overseer() = default;
  Overseer(const Overseer&) = delete;
  Overseer& operator=(const Overseer&) = delete;
  virtual ~Overseer() = default;

  virtual void agent_in(LoadAgent& agent) = 0;
  virtual void turn_came(LoadAgent& agent) = 0;
  // `code` is empty when the answer was taken.
  virtual void answered(LoadAgent& agent, std::string_view code) = 0;
  virtual void game_began(LoadAgent& agent) = 0;
  virtual void game_over(LoadAgent& agent) = 0;
  // An error that is not the answer to a turn, or the end of the connection.
  virtual void trouble(LoadAgent& agent, const std::string& what) = 0;
};

struct LoadAgentSettings {
  std::string name;
  protocol::EventDetail detail = protocol::EventDetail::summary;
  std::string noise = "olympiad";
  std::uint64_t seed = 1;
};

class LoadAgent {
 public:
  LoadAgent(boost::asio::io_context& io, Traffic& traffic, LoadAgentSettings settings,
            Overseer& overseer);

  void connect(const boost::asio::ip::tcp::endpoint& server);
  void close();
  void challenge(const std::string& opponent);
  // Answers the turn that waits; `due` is when it should have been sent.
  void answer(SteadyTime due);

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  [[nodiscard]] bool has_turn() const { return turn_.has_value(); }
  // When the answer that is under way should have been sent; unset: none is.
  [[nodiscard]] std::optional<SteadyTime> sent() const { return sent_; }
  [[nodiscard]] bool last_was_shot() const { return last_was_shot_; }
  // Connections that one address may have, as hello's reply says.
  [[nodiscard]] std::int64_t connections_allowed() const { return connections_allowed_; }

  std::size_t index = 0;  // the overseer's own

 private:
  void log_in();
  void line_came(std::string_view line);
  void reply_came(std::int64_t id, std::string_view line);
  void error_came(std::int64_t id, std::string_view line);
  std::int64_t send(const protocol::Request& request);

  LoadAgentSettings settings_;
  Overseer& overseer_;
  std::shared_ptr<Link> link_;
  Felt felt_;
  std::optional<SeenTurn> turn_{};   // waits for its answer
  std::optional<SeenTurn> asked_{};  // was answered; comes back when the answer is refused
  std::optional<SteadyTime> sent_{};
  std::int64_t next_id_ = 1;
  std::int64_t answer_id_ = 0;
  std::int64_t connections_allowed_ = 0;
  bool last_was_shot_ = false;
};

}  // namespace poolhall::load
