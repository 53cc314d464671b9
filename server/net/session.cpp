#include "server/net/session.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/meter/work_meter.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

// Lines that may wait while a login is being stored; a polite client sends one or none.
constexpr std::size_t held_lines = 32;
// Requests refused for coming too fast, and not as slowly as they might have come, after which the
// connection is a flood.
constexpr std::uint32_t flood = 1'000;

std::uint32_t whole(double number) {
  return static_cast<std::uint32_t>(std::lround(number));
}

// What a shot's line has beside its events, at most: two states' worth and a ruling.
constexpr std::size_t beside_events = 16 * 1024;

// A log is read on terminals: nothing of a stranger's gets there but visible ASCII.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~' || c == '"'; }, '?');
  return text;
}

Line line_of(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

std::string encoded(const Notification& notification, std::uint64_t seq) {
  const meter::Metered timed{meter::Area::json_out};
  return protocol::encode_notification(notification, seq);
}

std::string encoded(const protocol::RequestId& id, const Reply& answer) {
  const meter::Metered timed{meter::Area::json_out};
  return protocol::encode_reply(id, answer);
}

}  // namespace

void Asker::reply(const Reply& answer) const {
  if (const auto alive = session.lock()) {
    alive->answer(id, answer);
  }
}

void Asker::refuse(const Error& error) const {
  if (const auto alive = session.lock()) {
    alive->answer(id, error);
  }
}

Session::Session(std::shared_ptr<Connection> connection, Lobby& lobby)
    : connection_(std::move(connection)),
      lobby_(lobby),
      bucket_(whole(lobby.limits().messages_per_second), whole(lobby.limits().message_burst)),
      refusals_(whole(lobby.limits().messages_per_second), flood) {}

void Session::begin() {
  const auto wait = lobby_.limits().login_deadline;
  login_deadline_ = lobby_.deadlines().at(std::chrono::steady_clock::now() + wait,
                                          [weak = weak_from_this(), wait] {
                                            if (const auto self = weak.lock()) {
                                              self->end_login(wait);
                                            }
                                          });
  connection_->start(weak_from_this());
}

void Session::end_login(std::chrono::milliseconds wait) {
  if (stage_ == Stage::logging_in) {
    close({ErrorCode::paused, "", "the server cannot store now who comes; come back later"});
  } else {
    close({ErrorCode::too_slow, "",
           fmt::format("no login within {} ms of the connection", wait.count())});
  }
}

void Session::push(const Notification& notification) {
  send(encoded(notification, ++seq_), nullptr);
}

void Session::answer(const protocol::RequestId& id, const Reply& result) {
  --owed_;
  reply(id, result);
}

void Session::answer(const protocol::RequestId& id, const Error& error) {
  --owed_;
  refuse(id, error);
}

void Session::reply(const protocol::RequestId& id, const Reply& answer) {
  send(encoded(id, answer), &id);
}

void Session::refuse(const protocol::RequestId& id, const Error& error) {
  connection_->send(line_of(protocol::encode_error(id, error)));
}

void Session::send(std::string line, const protocol::RequestId* id) {
  const std::size_t most = lobby_.limits().server_line_bytes;
  if (line.size() <= most + 1) {  // and its end
    connection_->send(line_of(std::move(line)));
    return;
  }
  spdlog::error("connection {}: a line of {} bytes, more than {}, is not sent: {}",
                number(connection_->id()), line.size(), most, line.substr(0, 80));
  if (id != nullptr) {
    refuse(*id,
           {ErrorCode::internal, "", "the answer is longer than a line of the server's may be"});
  }
}

std::size_t Session::event_bytes() const {
  const std::size_t most = lobby_.limits().server_line_bytes;
  return most - std::min(most, beside_events);
}

void Session::close(const Error& reason) {
  connection_->close(line_of(protocol::encode_error({}, reason)),
                     fmt::format("{}: {}", protocol::name(reason.code), reason.reason));
}

void Session::close_with(const Notification& last, std::string_view why) {
  connection_->close(line_of(protocol::encode_notification(last, ++seq_)), std::string{why});
}

void Session::admitted(Agent& agent, const protocol::LoginReply& login) {
  login_deadline_.cancel();
  stage_ = Stage::in;
  agent_ = agent.id();
  connection_->set_line_limit(lobby_.limits().line_bytes);
  spdlog::info("agent {} ({}) is in, connection {} from {}, client {}", agent.record.name,
               storage::number(agent.id()), number(connection_->id()), connection_->peer(),
               client_.empty() ? "unnamed" : client_);
  answer(login_id_, login);
  probe_lag();
}

void Session::not_admitted(const Error& error) {
  stage_ = Stage::greeted;
  answer(login_id_, error);
}

void Session::resume() {
  const auto lines = std::exchange(held_, {});
  const SteadyTime now = std::chrono::steady_clock::now();
  for (const std::string& line : lines) {
    if (connection_->open()) {
      on_line(line, now);
    }
  }
  if (input_over_) {
    lobby_.leaves(*this);  // it logged in and was gone already
  }
}

void Session::probe_lag() {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (lag_.wants_probe(now)) {
    push(protocol::LagProbe{static_cast<std::int64_t>(lag_.probe(now))});
  }
}

void Session::on_line(std::string_view line, SteadyTime read_at) {
  if (stage_ == Stage::logging_in) {
    if (held_.size() < held_lines) {
      held_.emplace_back(line);
    } else {
      close({ErrorCode::rate_limited, "", "too many lines while the login was under way"});
    }
    return;
  }
  auto incoming = meter::metered(meter::Area::json_in,
                                 [&] { return protocol::decode_request(line, lobby_.limits()); });
  if (!incoming) {
    bad_line(incoming.error().id, incoming.error().error);
    return;
  }
  bad_lines_ = 0;
  if (within_rate(*incoming, read_at)) {
    take(std::move(*incoming), read_at);
  }
}

bool Session::within_rate(const protocol::Incoming& incoming, SteadyTime read_at) {
  if ((agent_ && lobby_.is_awaited(*agent_, incoming.request)) || bucket_.take(read_at)) {
    return true;
  }
  const auto& limits = lobby_.limits();
  const Error error{ErrorCode::rate_limited, "",
                    fmt::format("more than {} messages a second (burst {})",
                                limits.messages_per_second, limits.message_burst)};
  if (!refusals_.take(read_at)) {
    close(error);
  } else if (incoming.id) {
    refuse(*incoming.id, error);
  }
  return false;
}

void Session::take(protocol::Incoming incoming, SteadyTime read_at) {
  if (const auto* lag = std::get_if<protocol::Lag>(&incoming.request)) {
    take_lag(incoming.id, *lag, read_at);
    return;
  }
  const protocol::RequestId id = incoming.id.value_or(protocol::RequestId{});
  if (stage_ != Stage::in) {
    take_before_login(id, incoming.request);
    return;
  }
  switch (protocol::method_of(incoming.request)) {
    case protocol::Method::hello:
    case protocol::Method::login:
    case protocol::Method::register_agent:
      refuse(id, {ErrorCode::already_logged_in, "/method",
                  fmt::format("got {}, but this connection is logged in",
                              protocol::name(protocol::method_of(incoming.request)))});
      return;
    case protocol::Method::ping:
      reply(id, protocol::PingReply{std::get<protocol::Ping>(incoming.request).t,
                                    lobby_.time_ms(std::chrono::steady_clock::now())});
      return;
    default:
      ++owed_;
      lobby_.handle({weak_from_this(), id}, *agent_, std::move(incoming.request), read_at);
  }
}

void Session::take_before_login(protocol::RequestId id, const protocol::Request& request) {
  const auto method = protocol::name(protocol::method_of(request));
  if (const auto* hello = std::get_if<protocol::Hello>(&request)) {
    if (stage_ == Stage::silent) {
      greet(id, *hello);
    } else {
      refuse(id, {ErrorCode::already_logged_in, "/method",
                  "got a second hello, expected register or login"});
    }
    return;
  }
  if (stage_ == Stage::silent) {
    bad_line(id, {ErrorCode::not_logged_in, "/method",
                  fmt::format("got {}, expected hello to come first", method)});
    return;
  }
  login_id_ = std::move(id);
  if (const auto* login = std::get_if<protocol::Login>(&request)) {
    stage_ = Stage::logging_in;
    ++owed_;
    lobby_.admit(shared_from_this(), *login);
  } else if (const auto* enroll = std::get_if<protocol::Register>(&request)) {
    stage_ = Stage::logging_in;
    ++owed_;
    lobby_.enroll(shared_from_this(), *enroll);
  } else {
    refuse(login_id_, {ErrorCode::not_logged_in, "/method",
                       fmt::format("got {}, expected login or register first", method)});
  }
}

void Session::greet(const protocol::RequestId& id, const protocol::Hello& hello) {
  if (hello.least_protocol > protocol::protocol_version ||
      hello.most_protocol < protocol::protocol_version) {
    const Error error{
        ErrorCode::unsupported_protocol, "/params/protocol",
        fmt::format("got versions {} to {}, this server speaks {}", hello.least_protocol,
                    hello.most_protocol, protocol::protocol_version)};
    connection_->close(line_of(protocol::encode_error(id, error)), "unsupported_protocol");
    return;
  }
  stage_ = Stage::greeted;
  detail_ = hello.detail;
  client_ = printable(hello.client ? hello.client->name + " " + hello.client->version : hello.name);
  reply(id, lobby_.greeting(*this));
}

void Session::take_lag(const std::optional<protocol::RequestId>& id, const protocol::Lag& lag,
                       SteadyTime read_at) {
  const bool measured = lag_.answered(static_cast<std::uint64_t>(lag.t), read_at);
  if (id) {
    reply(*id, protocol::EmptyReply{});
  }
  if (measured) {
    probe_lag();
  }
}

void Session::bad_line(const protocol::RequestId& id, const Error& error) {
  ++bad_lines_;
  if (bad_lines_ < lobby_.limits().bad_lines_in_a_row) {
    refuse(id, error);
    return;
  }
  refuse(id, error);
  close({ErrorCode::too_many_errors, "",
         fmt::format("{} bad lines in a row; the last: {}", bad_lines_, error.reason)});
}

void Session::on_line_too_long() {
  const auto& limits = lobby_.limits();
  bad_line({}, {ErrorCode::line_too_long, "",
                fmt::format("got a line of more than {} bytes",
                            agent_ ? limits.line_bytes : limits.line_bytes_before_login)});
}

void Session::on_line_too_slow() {
  close({ErrorCode::too_slow, "",
         fmt::format("a line was not finished within {} ms of its first byte",
                     lobby_.limits().line_deadline.count())});
}

void Session::on_output_unread() {
  close({ErrorCode::unread_output, "",
         fmt::format("output was left unread: more than {} bytes by this connection, or the most "
                     "where all together leave more than {}",
                     lobby_.limits().output_queue_bytes, lobby_.limits().output_bytes_in_all)});
}

void Session::on_input_over() {
  input_over_ = true;
  lobby_.leaves(*this);
}

void Session::on_closed(std::string_view why) {
  login_deadline_.cancel();
  spdlog::info("connection {} from {} has ended{}: {}", number(connection_->id()),
               connection_->peer(),
               agent_ ? fmt::format(", agent {}", storage::number(*agent_)) : "", why);
  lobby_.ended(*this);
}

}  // namespace poolhall::net
