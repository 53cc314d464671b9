#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "protocol/codec.hpp"
#include "protocol/framing.hpp"
#include "protocol/json_value.hpp"
#include "protocol/json_writer.hpp"
#include "protocol/state_json.hpp"
#include "tests/support/sample_messages.hpp"

namespace poolhall::protocol {
namespace {

const Limits limits;

RC_GTEST_PROP(JsonNumbers, ComeBackBitForBit, (std::uint64_t bits)) {
  const double value = std::bit_cast<double>(bits);
  RC_PRE(std::isfinite(value));
  JsonWriter out;
  out.begin_array().number(value).end_array();
  const auto document = parse_json(out.text(), {1, 0});
  RC_ASSERT(document.has_value());
  const JsonValue& element = document->as<JsonArray>()->front();
  double back = 0;
  if (const auto* integer = element.as<std::int64_t>()) {
    back = static_cast<double>(*integer);
  } else if (const auto* natural = element.as<std::uint64_t>()) {
    back = static_cast<double>(*natural);
  } else {
    back = *element.as<double>();
  }
  RC_ASSERT(std::bit_cast<std::uint64_t>(back) == bits);
}

RC_GTEST_PROP(JsonStrings, ComeBackByteForByte, (const std::vector<unsigned char>& bytes)) {
  std::string text;
  for (const unsigned char byte : bytes) {
    text += static_cast<char>(byte & 0x7FU);
  }
  JsonWriter out;
  out.string(text);
  RC_ASSERT(*parse_json(out.text(), {0, 0})->as<std::string>() == text);
}

RC_GTEST_PROP(JsonStrings, AreValidWhateverTheirBytes, (const std::vector<unsigned char>& bytes)) {
  JsonWriter out;
  out.string(std::string(bytes.begin(), bytes.end()));
  RC_ASSERT(parse_json(out.text(), {0, 0}).has_value());
}

// The lines of a stream, however it is cut into chunks.
std::vector<std::string> lines_of(const std::string& stream, const std::vector<std::size_t>& cuts,
                                  std::size_t limit) {
  LineSplitter splitter(limit);
  std::vector<std::string> lines;
  std::size_t at = 0;
  for (std::size_t i = 0; at < stream.size(); ++i) {
    const std::size_t size = cuts.empty() ? stream.size() : 1 + cuts[i % cuts.size()] % 9;
    for (std::string_view rest = std::string_view(stream).substr(at, size); !rest.empty();) {
      const auto step = splitter.next(rest);
      rest = step.rest;
      if (step.kind == LineSplitter::Kind::line) {
        lines.emplace_back(step.line);
      } else if (step.kind == LineSplitter::Kind::too_long) {
        lines.emplace_back("too long");
      }
    }
    at += size;
  }
  return lines;
}

RC_GTEST_PROP(LineSplitterProperty, FindsTheSameLinesHoweverTheStreamIsCut,
              (const std::vector<std::size_t>& cuts)) {
  const auto stream = *rc::gen::container<std::string>(rc::gen::element('a', 'b', '\r', '\n'));
  RC_ASSERT(lines_of(stream, cuts, 4) == lines_of(stream, {}, 4));
}

// One byte of a good line changed, or the line cut short.
std::string damaged(std::string line) {
  const auto at = *rc::gen::inRange<std::size_t>(0, line.size());
  if (*rc::gen::arbitrary<bool>()) {
    line.resize(at);
  } else {
    line[at] = *rc::gen::arbitrary<char>();
  }
  return line;
}

RC_GTEST_PROP(DecodeRequestProperty, AnswersADamagedLineWithAnErrorThatCanBeSent, ()) {
  static const std::vector<Request> samples = test_support::sample_requests();
  const Request sample = *rc::gen::elementOf(samples);
  std::string line = encode_request(1, sample);
  line.pop_back();
  const auto incoming = decode_request(damaged(line), limits);
  if (!incoming) {
    const Error& error = incoming.error().error;
    RC_ASSERT(!error.reason.empty());
    RC_ASSERT(error.reason.find('\n') == std::string::npos);
    const std::string answer = encode_error(incoming.error().id, error);
    RC_ASSERT(parse_json(answer, {16, 256}).has_value());
  }
}

RC_GTEST_PROP(DecodeServerMessageProperty, TakesDamagedLinesWithoutHarm, ()) {
  static const auto samples = test_support::sample_notifications();
  const auto index = *rc::gen::inRange<std::size_t>(0, samples.size());
  std::string line = encode_notification(samples[index], 1);
  line.pop_back();
  const std::string text = damaged(line);
  const auto message = decode_server_message(text, [](const RequestId&) { return Method::shot; });
  RC_ASSERT(message.has_value() || !message.error().reason.empty());
}

RC_GTEST_PROP(StateJsonProperty, KeepsEveryPlace, (const std::vector<std::uint64_t>& bits)) {
  static const rules::GameState start =
      test_support::played_break(rules::RuleSet::eight_ball).before;
  rules::GameState state = start;
  for (std::size_t i = 0; i < state.balls.size() && i < bits.size(); ++i) {
    const double x = std::bit_cast<double>(bits[i]);
    state.balls[i].position = {std::isfinite(x) ? x : 0.5, std::ldexp(1.0, -static_cast<int>(i))};
  }
  const auto again = decode_state(encode_state(state));
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == state);
}

}  // namespace
}  // namespace poolhall::protocol
