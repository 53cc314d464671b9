// A blocking client for tests: raw lines and decoded messages over a real socket. Everything has a
// generous deadline, so that a test that waits in vain fails instead of hanging.
//
//   WireClient client{server.port()};
//   client.join("anna");
//   auto turn = client.wait_for<GameTurn<Received>>();
//   auto reply = client.call<ShotReply<Received>>(Shot{...});
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/codec.hpp"
#include "tests/support/session_recorder.hpp"

namespace poolhall::net_tests {

inline constexpr std::chrono::seconds patience{60};

class WireClient {
 public:
  explicit WireClient(std::uint16_t port);
  // By TLS, believing the certificates in this PEM file.
  WireClient(std::uint16_t port, const std::string& ca_file);
  ~WireClient();
  WireClient(const WireClient&) = delete;
  WireClient& operator=(const WireClient&) = delete;

  void send_bytes(std::string_view bytes);
  // Nothing at the end of the stream. Throws when there is no line within the deadline.
  [[nodiscard]] std::optional<std::string> read_line();
  // Everything until the end of the stream.
  [[nodiscard]] std::string read_all();
  // More bytes into rest(); false at the end of the stream.
  [[nodiscard]] bool receive();
  [[nodiscard]] int descriptor() const { return socket_; }
  // Says that no more will be sent, and can still hear.
  void end_input();
  void close();
  // All bytes that have come so far, and those of them that are no line yet.
  [[nodiscard]] const std::string& heard() const { return heard_; }
  [[nodiscard]] const std::string& rest() const { return input_; }

  // Sends the request; its reply is read by reply_to or call.
  std::int64_t send(const protocol::Request& request);
  // The reply or the error; notifications that come before it are kept for wait_for.
  [[nodiscard]] std::variant<protocol::ReplyMessage, protocol::ErrorMessage> answer_to(
      std::int64_t id);
  template <class Reply>
  Reply call(const protocol::Request& request) {
    auto answer = answer_to(send(request));
    if (auto* error = std::get_if<protocol::ErrorMessage>(&answer)) {
      throw std::runtime_error("refused: " + error->code + " " + error->error.reason);
    }
    return std::get<Reply>(std::get<protocol::ReplyMessage>(answer).reply);
  }
  protocol::ErrorMessage refused(const protocol::Request& request) {
    auto answer = answer_to(send(request));
    if (!std::holds_alternative<protocol::ErrorMessage>(answer)) {
      throw std::runtime_error("was not refused");
    }
    return std::get<protocol::ErrorMessage>(answer);
  }
  // The next notification of this kind; others before it are dropped.
  template <class Kind>
  Kind wait_for() {
    for (;;) {
      const protocol::NotificationMessage message = next_notification();
      if (const auto* found = std::get_if<Kind>(&message.notification)) {
        return *found;
      }
    }
  }
  // How many notifications of this kind have come and were not waited for. What was pushed before
  // a request was read has come when its reply has.
  template <class Kind>
  [[nodiscard]] std::size_t kept() const {
    std::size_t count = 0;
    for (const protocol::NotificationMessage& message : notifications_) {
      count += std::holds_alternative<Kind>(message.notification) ? 1 : 0;
    }
    return count;
  }
  [[nodiscard]] protocol::NotificationMessage next_notification();
  // A notification or an error without an id; nothing at the end of the stream.
  [[nodiscard]] std::optional<protocol::ServerMessage> next_message();

  void hello();
  // hello and register; the token.
  std::string join(const std::string& name);
  protocol::LoginReply login(const std::string& token);

 private:
  [[nodiscard]] protocol::ServerMessage decode(const std::string& line);

  struct Tls;

  int socket_ = -1;
  std::unique_ptr<Tls> tls_;
  test_support::SessionRecorder recorder_;
  std::string input_;
  std::string heard_;
  std::int64_t next_id_ = 1;
  std::map<std::string, protocol::Method> methods_;
  std::deque<protocol::NotificationMessage> notifications_;
};

}  // namespace poolhall::net_tests
