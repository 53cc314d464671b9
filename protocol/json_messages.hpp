// The server's messages written and read, part by part. For the sources of this room; codec.hpp
// is the door.
#pragma once

#include "protocol/json_node.hpp"
#include "protocol/json_writer.hpp"
#include "protocol/messages.hpp"

namespace poolhall::protocol {

// The members of a notification's params (after `seq`) or of a reply's result, without the braces.
void write_members(JsonWriter& out, const Notification<Outgoing>& notification);
void write_members(JsonWriter& out, const Reply<Outgoing>& reply);

// `index` as in notification_name.
[[nodiscard]] Notification<Received> read_notification(std::size_t index, const JsonNode& params);
[[nodiscard]] Reply<Received> read_reply(Method method, const JsonNode& result);

}  // namespace poolhall::protocol
