#include "wire_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>

namespace poolhall::net_tests {

using protocol::ServerMessage;

struct WireClient::Tls {
  std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context{SSL_CTX_new(TLS_client_method()),
                                                            SSL_CTX_free};
  std::unique_ptr<SSL, decltype(&SSL_free)> ssl{nullptr, SSL_free};
};

WireClient::WireClient(std::uint16_t port, const std::string& ca_file) : WireClient(port) {
  tls_ = std::make_unique<Tls>();
  SSL_CTX_load_verify_file(tls_->context.get(), ca_file.c_str());
  SSL_CTX_set_verify(tls_->context.get(), SSL_VERIFY_PEER, nullptr);
  tls_->ssl.reset(SSL_new(tls_->context.get()));
  SSL_set_fd(tls_->ssl.get(), socket_);
  if (SSL_connect(tls_->ssl.get()) != 1) {
    throw std::runtime_error("no TLS handshake");
  }
}

WireClient::WireClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    throw std::runtime_error("the server cannot be reached");
  }
}

WireClient::~WireClient() {
  close();
}

void WireClient::end_input() {
  if (tls_) {
    static_cast<void>(SSL_shutdown(tls_->ssl.get()));
  } else {
    ::shutdown(socket_, SHUT_WR);
  }
}

void WireClient::close() {
  if (socket_ >= 0) {
    ::close(std::exchange(socket_, -1));
  }
}

void WireClient::send_bytes(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto sent = tls_
                          ? SSL_write(tls_->ssl.get(), bytes.data(), static_cast<int>(bytes.size()))
                          : ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) {
      return;  // the server has ended the connection; what it said can still be read
    }
    recorder_.sent(bytes.substr(0, static_cast<std::size_t>(sent)));
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

std::optional<std::string> WireClient::read_line() {
  for (;;) {
    const auto end = input_.find('\n');
    if (end != std::string::npos) {
      std::string line = input_.substr(0, end);
      input_.erase(0, end + 1);
      return line;
    }
    if (!receive()) {
      return std::nullopt;
    }
  }
}

bool WireClient::receive() {
  const bool has_bytes = tls_ && SSL_pending(tls_->ssl.get()) > 0;
  pollfd readable{socket_, POLLIN, 0};
  const auto wait = std::chrono::milliseconds{patience}.count();
  if (!has_bytes && ::poll(&readable, 1, static_cast<int>(wait)) <= 0) {
    throw std::runtime_error("no bytes within the deadline");
  }
  char buffer[65536];
  const auto got = tls_ ? SSL_read(tls_->ssl.get(), buffer, sizeof buffer)
                        : ::recv(socket_, buffer, sizeof buffer, 0);
  if (got > 0) {
    input_.append(buffer, static_cast<std::size_t>(got));
    heard_.append(buffer, static_cast<std::size_t>(got));
    recorder_.received({buffer, static_cast<std::size_t>(got)});
  }
  return got > 0;
}

std::string WireClient::read_all() {
  while (receive()) {
  }
  return std::exchange(input_, {});
}

ServerMessage WireClient::decode(const std::string& line) {
  auto message = protocol::decode_server_message(
      line, [this](const protocol::RequestId& id) -> std::optional<protocol::Method> {
        const auto found = methods_.find(id.json);
        return found == methods_.end() ? std::nullopt : std::optional{found->second};
      });
  if (!message) {
    throw std::runtime_error("not a server's message: " + message.error().field + " " +
                             message.error().reason + " in " + line.substr(0, 300));
  }
  return std::move(*message);
}

std::int64_t WireClient::send(const protocol::Request& request) {
  const std::int64_t id = next_id_++;
  methods_[std::to_string(id)] = protocol::method_of(request);
  send_bytes(protocol::encode_request(id, request));
  return id;
}

std::variant<protocol::ReplyMessage, protocol::ErrorMessage> WireClient::answer_to(
    std::int64_t id) {
  for (;;) {
    const auto line = read_line();
    if (!line) {
      throw std::runtime_error("the connection ended before the answer");
    }
    ServerMessage message = decode(*line);
    if (auto* reply = std::get_if<protocol::ReplyMessage>(&message)) {
      if (reply->id.json == std::to_string(id)) {
        return std::move(*reply);
      }
    } else if (auto* error = std::get_if<protocol::ErrorMessage>(&message)) {
      if (error->id.json == std::to_string(id)) {
        return std::move(*error);
      }
    } else if (auto* notification = std::get_if<protocol::NotificationMessage>(&message)) {
      notifications_.push_back(std::move(*notification));
    }
  }
}

protocol::NotificationMessage WireClient::next_notification() {
  if (!notifications_.empty()) {
    auto first = std::move(notifications_.front());
    notifications_.pop_front();
    return first;
  }
  for (;;) {
    auto message = next_message();
    if (!message) {
      throw std::runtime_error("the connection ended before the notification");
    }
    if (auto* notification = std::get_if<protocol::NotificationMessage>(&*message)) {
      return std::move(*notification);
    }
  }
}

std::optional<ServerMessage> WireClient::next_message() {
  if (!notifications_.empty()) {
    auto first = std::move(notifications_.front());
    notifications_.pop_front();
    return first;
  }
  const auto line = read_line();
  if (!line) {
    return std::nullopt;
  }
  return decode(*line);
}

void WireClient::hello() {
  protocol::Hello hello;
  hello.name = "test";
  static_cast<void>(call<protocol::HelloReply>(hello));
}

std::string WireClient::join(const std::string& name) {
  hello();
  const auto reply = call<protocol::LoginReply>(protocol::Register{name, std::nullopt});
  return reply.token.value().text;
}

protocol::LoginReply WireClient::login(const std::string& token) {
  hello();
  return call<protocol::LoginReply>(protocol::Login{{token}});
}

}  // namespace poolhall::net_tests
