#include "tests/fuzz/protocol/protocol_targets.hpp"

#include <string>
#include <vector>

#include "protocol/codec.hpp"
#include "protocol/events_json.hpp"
#include "protocol/framing.hpp"
#include "protocol/json_node.hpp"
#include "protocol/json_value.hpp"
#include "protocol/scene_json.hpp"
#include "protocol/state_json.hpp"
#include "protocol/table_json.hpp"
#include "tests/fuzz/protocol/demand.hpp"

namespace poolhall::fuzz {
namespace {

using namespace protocol;

void demand_one_line(const std::string& line) {
  demand(!line.empty() && line.find('\n') == line.size() - 1, "one line with its end");
}

void demand_error_can_be_sent(const RequestId& id, const Error& error) {
  const std::string line = encode_error(id, error);
  demand_one_line(line);
  demand(parse_json(line, {16, 256}).has_value(), "an error is JSON");
  demand(!error.reason.empty(), "an error has a reason");
}

// The lines of a stream by the plainest means; nothing for a line that is too long.
std::vector<std::optional<std::string>> plain_lines(std::string_view stream, std::size_t limit) {
  std::vector<std::optional<std::string>> lines;
  for (std::size_t end; (end = stream.find('\n')) != std::string_view::npos;) {
    std::string_view line = stream.substr(0, end);
    stream.remove_prefix(end + 1);
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    lines.push_back(line.size() > limit ? std::nullopt : std::optional<std::string>(line));
  }
  return lines;
}

template <class Value, class Encode, class Decode>
void demand_same_again(const Expected<Value>& value, Encode encode, Decode decode) {
  if (!value) {
    demand(!value.error().reason.empty(), "an error has a reason");
    return;
  }
  const std::string text = encode(*value);
  const Expected<Value> again = decode(text);
  demand(again.has_value(), "what was encoded can be decoded");
  demand(encode(*again) == text, "what was decoded again is the same");
}

}  // namespace

void request(std::string_view input) {
  const Limits limits;
  const auto incoming = decode_request(input, limits);
  if (!incoming) {
    demand_error_can_be_sent(incoming.error().id, incoming.error().error);
    return;
  }
  const std::string line = encode_request(1, incoming->request);
  demand_one_line(line);
  const auto again = decode_request(std::string_view(line).substr(0, line.size() - 1), limits);
  demand(again.has_value(), "a request that was encoded can be decoded");
  demand(encode_request(1, again->request) == line, "it is the same request");
}

void json(std::string_view input) {
  const Expected<JsonValue> line = parse_json(input, json_bounds(Limits{}));
  const Expected<JsonValue> document = parse_json(input, document_bounds);
  demand(!line || document, "what fits the bounds of a line fits those of a document");
  if (!document) {
    demand(!document.error().reason.empty(), "an error has a reason");
    return;
  }
  const std::string text = canonical_text(*document);
  demand(text.find('\n') == std::string::npos, "canonical text is one line");
  const Expected<JsonValue> again = parse_json(text, document_bounds);
  demand(again.has_value(), "canonical text is JSON");
  demand(canonical_text(*again) == text, "canonical text reads back as itself");
}

void framing(std::string_view input) {
  if (input.size() < 2) {
    return;
  }
  const std::size_t limit = 1 + static_cast<unsigned char>(input[0]);
  const std::size_t chunk = 1 + static_cast<unsigned char>(input[1]) % 32U;
  const std::string_view stream = input.substr(2);
  std::vector<std::optional<std::string>> lines;
  LineSplitter splitter(limit);
  for (std::size_t at = 0; at < stream.size(); at += chunk) {
    for (std::string_view rest = stream.substr(at, chunk); !rest.empty();) {
      const auto step = splitter.next(rest);
      demand(step.rest.size() < rest.size(), "every step goes on");
      rest = step.rest;
      if (step.kind == LineSplitter::Kind::line) {
        lines.emplace_back(step.line);
      } else if (step.kind == LineSplitter::Kind::too_long) {
        lines.emplace_back();
      }
    }
  }
  auto expected = plain_lines(stream, limit);
  // The last line has not ended, but may be known to be too long already.
  if (lines.size() == expected.size() + 1 && !lines.back()) {
    lines.pop_back();
  }
  demand(lines == expected, "the lines are those of the plain splitter");
}

void server_message(std::string_view input) {
  if (input.empty()) {
    return;
  }
  const auto methods = std::variant_size_v<Request>;
  const auto method = static_cast<Method>(static_cast<unsigned char>(input[0]) % methods);
  const auto message =
      decode_server_message(input.substr(1), [&](const RequestId&) { return method; });
  demand(message || !message.error().reason.empty(), "an error has a reason");
}

void scene(std::string_view input) {
  const auto file = decode_scene(input);
  if (!file) {
    demand(!file.error().reason.empty(), "an error has a reason");
    return;
  }
  demand_same_again(decode_table(encode_table(file->table)), encode_table, decode_table);
  demand_same_again(decode_materials(encode_materials(file->materials)), encode_materials,
                    decode_materials);
  const auto possible = physics::check_scene(scene_of(*file));
  demand(possible || !possible.error().reason.empty(), "an impossible scene has a reason");
}

void record(std::string_view input) {
  demand_same_again(decode_state(input), encode_state, decode_state);
  const auto encode_full = [](const physics::EventLog<double>& events) {
    return encode_events(events, EventDetail::full);
  };
  demand_same_again(decode_events(input), encode_full, decode_events);
  const auto ruling = decode_ruling(input);
  demand(ruling || !ruling.error().reason.empty(), "an error has a reason");
}

}  // namespace poolhall::fuzz
