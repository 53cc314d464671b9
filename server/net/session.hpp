// What one connection says and hears: hello, login, then requests of its agent. Lines are decoded
// and counted here; what a request does is the Lobby's business.
//
//   auto session = std::make_shared<Session>(connection, lobby);
//   session->begin();
//   session->push(GameOver{...});       // numbered, encoded, queued
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/codec.hpp"
#include "server/net/agent_book.hpp"
#include "server/net/connection.hpp"
#include "server/net/lag_meter.hpp"
#include "server/web/token_bucket.hpp"

namespace poolhall::net {

using Reply = protocol::Reply<protocol::Outgoing>;
using Notification = protocol::Notification<protocol::Outgoing>;

// Who asked, and under which id; the answer may come when the connection is gone.
struct Asker {
  std::weak_ptr<Session> session;
  protocol::RequestId id;

  void reply(const Reply& reply) const;
  void refuse(const protocol::Error& error) const;
};

// What sessions need of the server around them.
class Lobby {
 public:
  virtual ~Lobby() = default;

  [[nodiscard]] virtual const protocol::Limits& limits() const = 0;
  [[nodiscard]] virtual DeadlineQueue& deadlines() = 0;
  [[nodiscard]] virtual protocol::HelloReply greeting(const Session& session) const = 0;
  [[nodiscard]] virtual std::int64_t time_ms(SteadyTime t) const = 0;

  // Both answer through session.admitted or session.not_admitted, now or later.
  virtual void enroll(const std::shared_ptr<Session>& session,
                      const protocol::Register& request) = 0;
  virtual void admit(const std::shared_ptr<Session>& session, const protocol::Login& request) = 0;

  // The answer to a turn that waits for it is never refused for coming too fast.
  [[nodiscard]] virtual bool is_awaited(storage::AgentId agent,
                                        const protocol::Request& request) const = 0;
  virtual void handle(const Asker& asker, storage::AgentId agent, protocol::Request request,
                      SteadyTime read_at) = 0;
  // Its agent is away: it may be gone, and gets at most the answers that it is owed.
  virtual void leaves(const Session& session) = 0;
  virtual void ended(const Session& session) = 0;
};

class Session : public Connection::Handler, public std::enable_shared_from_this<Session> {
 public:
  Session(std::shared_ptr<Connection> connection, Lobby& lobby);

  // Starts reading; the login's time runs.
  void begin();

  void push(const Notification& notification);
  // The answer to a request that the Lobby got.
  void answer(const protocol::RequestId& id, const Reply& result);
  void answer(const protocol::RequestId& id, const protocol::Error& error);
  // Sends the reason and ends.
  void close(const protocol::Error& reason);
  // Sends a last notification and ends.
  void close_with(const Notification& last, std::string_view why);

  // The answers of Lobby::enroll and admit. `after` pushes what the agent must know.
  void admitted(Agent& agent, const protocol::LoginReply& login);
  void not_admitted(const protocol::Error& error);
  // Takes up the lines that came while the login was under way.
  void resume();

  // A probe of the lag, unless the last one is too young.
  void probe_lag();
  [[nodiscard]] std::chrono::microseconds lag() const { return lag_.lag(); }
  void read_arrived() { connection_->read_arrived(); }

  [[nodiscard]] const Connection& connection() const { return *connection_; }
  [[nodiscard]] std::optional<storage::AgentId> agent() const { return agent_; }
  // Its agent sends and hears: not only what it asked for before it closed its sending half.
  [[nodiscard]] bool is_present() const { return agent_ && !input_over_; }
  [[nodiscard]] protocol::EventDetail detail() const { return detail_; }
  // How long the events of a shot may be, for the line that they stand in.
  [[nodiscard]] std::size_t event_bytes() const;

  void on_line(std::string_view line, SteadyTime read_at) override;
  void on_line_too_long() override;
  void on_line_too_slow() override;
  void on_output_unread() override;
  void on_input_over() override;
  [[nodiscard]] bool owes_answers() const override { return owed_ > 0; }
  void on_closed(std::string_view why) override;

 private:
  enum class Stage : std::uint8_t { silent, greeted, logging_in, in };

  void end_login(std::chrono::milliseconds wait);  // that is not done in time
  void reply(const protocol::RequestId& id, const Reply& reply);
  void refuse(const protocol::RequestId& id, const protocol::Error& error);
  void take(protocol::Incoming incoming, SteadyTime read_at);
  void take_before_login(protocol::RequestId id, const protocol::Request& request);
  void greet(const protocol::RequestId& id, const protocol::Hello& hello);
  void take_lag(const std::optional<protocol::RequestId>& id, const protocol::Lag& lag,
                SteadyTime read_at);
  [[nodiscard]] bool within_rate(const protocol::Incoming& incoming, SteadyTime read_at);
  // The line as it may be sent: one beyond the limit is left out, or answered with an error.
  void send(std::string line, const protocol::RequestId* id);
  void bad_line(const protocol::RequestId& id, const protocol::Error& error);

  std::shared_ptr<Connection> connection_;
  Lobby& lobby_;
  Stage stage_ = Stage::silent;
  Deadline login_deadline_;
  protocol::EventDetail detail_ = protocol::EventDetail::full;
  std::string client_;
  std::optional<storage::AgentId> agent_{};
  protocol::RequestId login_id_;
  std::vector<std::string> held_;  // lines that came while the login was under way
  std::uint64_t seq_ = 0;
  std::uint32_t bad_lines_ = 0;
  std::uint32_t owed_ = 0;  // answers that the Lobby will give
  bool input_over_ = false;
  web::TokenBucket bucket_;
  web::TokenBucket refusals_;  // for coming too fast
  LagMeter lag_;
};

}  // namespace poolhall::net
