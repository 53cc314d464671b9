// Lines to messages and back. Everything that is encoded is one line with its "\n".
//
//   server:  auto incoming = decode_request(line, limits);
//            if (!incoming) send(encode_error(incoming.error().id, incoming.error().error));
//            send(encode_reply(*incoming->id, PingReply{t, now_ms}));
//            send(encode_notification(GameOver{...}, ++seq));
//   client:  send(encode_request(7, Login{token}));
//            auto message = decode_server_message(line, [&](const RequestId& id) {...});
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <tl/expected.hpp>

#include "protocol/errors.hpp"
#include "protocol/ids.hpp"
#include "protocol/limits.hpp"
#include "protocol/messages.hpp"

namespace poolhall::protocol {

// ---- The server's side ----

struct Incoming {
  std::optional<RequestId> id{};  // unset: a notification, which only `lag` may be
  Request request;
};

// Why a line is no request, and the id to answer under (null where none could be read).
struct BadLine {
  RequestId id;
  Error error;
};

// `line` without its end. Error.field points into the line ("/params/turn").
[[nodiscard]] tl::expected<Incoming, BadLine> decode_request(std::string_view line,
                                                             const Limits& limits);

[[nodiscard]] std::string encode_reply(const RequestId& id, const Reply<Outgoing>& reply);
[[nodiscard]] std::string encode_error(const RequestId& id, const Error& error);
[[nodiscard]] std::string encode_notification(const Notification<Outgoing>& notification,
                                              std::uint64_t seq);

// ---- The client's side ----

[[nodiscard]] std::string encode_request(std::int64_t id, const Request& request);
// A `lag` without an id, which gets no reply.
[[nodiscard]] std::string encode_lag(const Lag& lag);

struct ReplyMessage {
  RequestId id;
  Reply<Received> reply;
};
struct ErrorMessage {
  RequestId id;
  std::string code;  // data.code, or message where a server sends no data
  std::int64_t number = 0;
  Error error;  // .code is `internal` if the number is not in the registry
  bool retryable = false;
};
struct NotificationMessage {
  std::uint64_t seq = 0;
  Notification<Received> notification;
};
// A notification that this version does not know; to be ignored.
struct UnknownNotification {
  std::uint64_t seq = 0;
  std::string method;
};
using ServerMessage =
    std::variant<ReplyMessage, ErrorMessage, NotificationMessage, UnknownNotification>;

// Which request a reply's id belongs to; nothing if there is none.
using MethodLookup = std::function<std::optional<Method>(const RequestId&)>;

[[nodiscard]] Expected<ServerMessage> decode_server_message(std::string_view line,
                                                            const MethodLookup& method_of_request);

}  // namespace poolhall::protocol
