// The server's line to a message: reply, error or notification.
#include "protocol/codec.hpp"
#include "protocol/json_messages.hpp"

namespace poolhall::protocol {
namespace {

ErrorMessage read_error(const JsonNode& root, RequestId id) {
  const JsonNode error = root.at("error");
  ErrorMessage message;
  message.id = std::move(id);
  message.number = error.at("code").integer<std::int64_t>();
  message.code = error.at("message").string();
  message.error.reason = message.code;
  message.error.code = error_code(message.number).value_or(ErrorCode::internal);
  if (const auto data = error.find("data")) {
    if (const auto code = data->find("code")) {
      message.code = code->string();
    }
    if (const auto field = data->find("field")) {
      message.error.field = field->string();
    }
    if (const auto retryable = data->find("retryable")) {
      message.retryable = retryable->boolean();
    }
    if (const auto game = data->find("game")) {
      message.error.game = GameId{game->integer<std::int64_t>()};
    }
    if (const auto foul = data->find("foul")) {
      message.error.foul = foul->boolean();
    }
  }
  return message;
}

ServerMessage read_pushed(const JsonNode& root) {
  const std::string name = root.at("method").string();
  const auto index = notification_index(name);
  const auto params = root.find("params");
  std::uint64_t seq = 0;
  if (const auto node = params ? params->find("seq") : std::nullopt) {
    seq = node->integer<std::uint64_t>();
  }
  if (!index) {
    return UnknownNotification{seq, name};
  }
  return NotificationMessage{seq, read_notification(*index, root.at("params"))};
}

Error unexpected_reply(const RequestId& id) {
  return {ErrorCode::invalid_request,
          "/id",
          "no request with id " + id.json + " awaits a reply",
          {},
          false};
}

}  // namespace

Expected<ServerMessage> decode_server_message(std::string_view line,
                                              const MethodLookup& method_of_request) {
  const Expected<JsonValue> document = parse_json(line, document_bounds);
  if (!document) {
    return tl::unexpected(document.error());
  }
  const JsonValue* id_value = document->member("id");
  const RequestId id{id_value == nullptr ? "null" : canonical_text(*id_value)};
  Reading reading(*document);
  const JsonNode root = reading.root();
  std::optional<ServerMessage> message;
  if (document->member("method") != nullptr) {
    message = read_pushed(root);
  } else if (document->member("error") != nullptr) {
    message = read_error(root, id);
  } else {
    const auto method = method_of_request(id);
    if (!method) {
      return tl::unexpected(unexpected_reply(id));
    }
    message = ReplyMessage{id, read_reply(*method, root.at("result"))};
  }
  if (!reading.ok()) {
    return tl::unexpected(reading.error());
  }
  return std::move(*message);
}

}  // namespace poolhall::protocol
