// The server's lines: the JSON-RPC frame around replies, errors and notifications.
#include "protocol/codec.hpp"
#include "protocol/json_messages.hpp"

namespace poolhall::protocol {
namespace {

// What a message with raw parts will about need, so that it is put together in one piece of memory.
struct RoomFor {
  std::size_t operator()(const GameShot<Outgoing>& shot) const {
    return 1024 + shot.events.text.size() + shot.state.text.size() + shot.ruling.text.size();
  }
  std::size_t operator()(const ShotReply<Outgoing>& reply) const { return (*this)(reply.shot); }
  template <class Other>
  std::size_t operator()(const Other&) const {
    return 512;
  }
};

std::string finished(JsonWriter&& out) {
  std::string line = std::move(out).text();
  line += '\n';
  return line;
}

}  // namespace

std::string encode_reply(const RequestId& id, const Reply<Outgoing>& reply) {
  JsonWriter out;
  out.reserve(std::visit(RoomFor{}, reply));
  out.begin_object().key("jsonrpc").string("2.0").key("id").raw(id.json);
  out.key("result").begin_object();
  write_members(out, reply);
  out.end_object().end_object();
  return finished(std::move(out));
}

std::string encode_error(const RequestId& id, const Error& error) {
  const ErrorEntry& known = entry(error.code);
  JsonWriter out;
  out.begin_object().key("jsonrpc").string("2.0").key("id").raw(id.json);
  out.key("error").begin_object();
  out.key("code").integer(static_cast<std::int32_t>(known.code));
  out.key("message").string(std::string(known.name) + ": " +
                            (error.reason.empty() ? std::string(known.meaning) : error.reason));
  out.key("data").begin_object().key("code").string(known.name);
  out.key("field").string(error.field).key("retryable").boolean(known.retryable);
  if (error.game) {
    out.key("game").integer(number(*error.game));
  }
  if (error.foul) {
    out.key("foul").boolean(true);
  }
  out.end_object().end_object().end_object();
  return finished(std::move(out));
}

std::string encode_notification(const Notification<Outgoing>& notification, std::uint64_t seq) {
  JsonWriter out;
  out.reserve(std::visit(RoomFor{}, notification));
  out.begin_object().key("jsonrpc").string("2.0");
  out.key("method").string(notification_name(notification.index()));
  out.key("params").begin_object().key("seq").integer(seq);
  write_members(out, notification);
  out.end_object().end_object();
  return finished(std::move(out));
}

}  // namespace poolhall::protocol
