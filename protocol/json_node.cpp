#include "protocol/json_node.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace poolhall::protocol {
namespace {

constexpr std::size_t longest_described_string = 40;

// The pointer of `wanted` below `from`, found by its address: nothing is paid for pointers while
// nothing is refused.
std::optional<std::string> pointer_to(const JsonValue& from, const JsonValue& wanted) {
  if (&from == &wanted) {
    return "";
  }
  if (const auto* array = from.as<JsonArray>()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (const auto below = pointer_to((*array)[i], wanted)) {
        return "/" + std::to_string(i) + *below;
      }
    }
  }
  if (const auto* object = from.as<JsonObject>()) {
    for (const auto& [key, value] : *object) {
      if (const auto below = pointer_to(value, wanted)) {
        return pointer_token(key) + *below;
      }
    }
  }
  return std::nullopt;
}

std::string shortened(std::string text) {
  if (text.size() > longest_described_string) {
    std::size_t cut = longest_described_string;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) {
      --cut;  // not inside a UTF-8 sequence
    }
    text = text.substr(0, cut) + "...";
  }
  return text;
}

// The whole number that the value is, if it is one that fits.
std::optional<std::int64_t> whole_number(const JsonValue& value) {
  if (const auto* integer = value.as<std::int64_t>()) {
    return *integer;
  }
  if (const auto* natural = value.as<std::uint64_t>()) {
    constexpr auto top = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    return *natural <= top ? std::optional(static_cast<std::int64_t>(*natural)) : std::nullopt;
  }
  constexpr double exact = 9007199254740992.0;  // 2^53
  const auto* real = value.as<double>();
  if (real != nullptr && std::trunc(*real) == *real && std::fabs(*real) <= exact) {
    return static_cast<std::int64_t>(*real);
  }
  return std::nullopt;
}

// A secret that came in the wrong place is not told, for what is told may be logged.
bool may_be_secret(std::string_view text) {
  return text.size() > longest_described_string &&
         std::all_of(text.begin(), text.begin() + longest_described_string,
                     [](unsigned char c) { return std::isxdigit(c) != 0; });
}

}  // namespace

std::string described(const JsonValue& value) {
  if (const auto* text = value.as<std::string>()) {
    if (may_be_secret(*text)) {
      return "a string of " + std::to_string(text->size()) + " characters";
    }
    return canonical_text(JsonValue{shortened(*text)});
  }
  if (const auto* array = value.as<JsonArray>()) {
    return "an array of " + std::to_string(array->size());
  }
  if (value.as<JsonObject>() != nullptr) {
    return "an object";
  }
  return canonical_text(value);
}

JsonNode JsonNode::at(std::string_view key) const {
  if (!object_or_refuse()) {
    return JsonNode(*reading_);
  }
  const JsonValue* member = value_->member(key);
  if (member == nullptr) {
    reading_->refuse(*value_, pointer_token(key), "is missing");
    return JsonNode(*reading_);
  }
  return JsonNode(*reading_, *member);
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (!object_or_refuse()) {
    return std::nullopt;
  }
  const JsonValue* member = value_->member(key);
  if (member == nullptr || member->is_null()) {
    return std::nullopt;
  }
  return JsonNode(*reading_, *member);
}

std::optional<JsonNode> JsonNode::nullable(std::string_view key) const {
  const JsonNode node = at(key);
  if (node.value_ == nullptr || node.value_->is_null()) {
    return std::nullopt;
  }
  return node;
}

double JsonNode::number() const {
  if (value_ == nullptr) {
    return 0;
  }
  if (const auto* real = value_->as<double>()) {
    return *real;
  }
  if (const auto* integer = value_->as<std::int64_t>()) {
    return static_cast<double>(*integer);
  }
  if (const auto* natural = value_->as<std::uint64_t>()) {
    return static_cast<double>(*natural);
  }
  refuse_expecting("a number");
  return 0;
}

bool JsonNode::boolean() const {
  if (value_ == nullptr) {
    return false;
  }
  if (const auto* truth = value_->as<bool>()) {
    return *truth;
  }
  refuse_expecting("true or false");
  return false;
}

std::string JsonNode::string() const {
  const std::string* text = text_or_refuse("a string");
  return text == nullptr ? std::string() : *text;
}

bool JsonNode::is_string(std::string_view text) const {
  const std::string* own = value_ == nullptr ? nullptr : value_->as<std::string>();
  return own != nullptr && *own == text;
}

bool JsonNode::is_object() const {
  return value_ != nullptr && value_->as<JsonObject>() != nullptr;
}

std::vector<JsonNode> JsonNode::elements() const {
  std::vector<JsonNode> nodes;
  if (value_ == nullptr) {
    return nodes;
  }
  const auto* array = value_->as<JsonArray>();
  if (array == nullptr) {
    refuse_expecting("an array");
    return nodes;
  }
  nodes.reserve(array->size());
  for (const JsonValue& element : *array) {
    nodes.emplace_back(*reading_, element);
  }
  return nodes;
}

std::vector<JsonNode> JsonNode::elements(std::size_t count) const {
  std::vector<JsonNode> nodes = elements();
  if (nodes.size() != count) {
    refuse_expecting("an array of " + std::to_string(count));
    nodes.resize(count, JsonNode(*reading_));
  }
  return nodes;
}

void JsonNode::only(std::initializer_list<std::string_view> known) const {
  if (!object_or_refuse()) {
    return;
  }
  for (const auto& [key, value] : *value_->as<JsonObject>()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) {
      continue;
    }
    std::string reason = "unknown key; expected one of";
    for (const std::string_view name : known) {
      reason += " ";
      reason += name;
    }
    reading_->refuse(value, "", std::move(reason));
    return;
  }
}

void JsonNode::refuse(std::string reason) const {
  if (value_ != nullptr) {
    reading_->refuse(*value_, "", std::move(reason));
  }
}

void JsonNode::refuse_expecting(std::string_view expected) const {
  if (value_ != nullptr) {
    refuse("expected " + std::string(expected) + ", got " + described(*value_));
  }
}

void JsonNode::refuse_as(ErrorCode code, std::string reason) const {
  if (value_ != nullptr) {
    reading_->refuse_as(code, *value_, std::move(reason));
  }
}

std::int64_t JsonNode::whole(std::int64_t least, std::int64_t most) const {
  if (value_ == nullptr) {
    return least;
  }
  const auto integer = whole_number(*value_);
  if (!integer || *integer < least || *integer > most) {
    refuse_expecting("an integer from " + std::to_string(least) + " to " + std::to_string(most));
    return least;
  }
  return *integer;
}

const std::string* JsonNode::text_or_refuse(std::string_view expected) const {
  if (value_ == nullptr) {
    return nullptr;
  }
  const auto* text = value_->as<std::string>();
  if (text == nullptr) {
    refuse_expecting(expected);
  }
  return text;
}

bool JsonNode::object_or_refuse() const {
  if (value_ == nullptr) {
    return false;
  }
  if (value_->as<JsonObject>() == nullptr) {
    refuse_expecting("an object");
    return false;
  }
  return true;
}

void Reading::refuse(const JsonValue& value, std::string_view below, std::string reason) {
  if (error_) {
    return;
  }
  error_ = Error{code_, pointer_to(document_, value).value_or("") + std::string(below),
                 std::move(reason)};
}

void Reading::refuse_as(ErrorCode code, const JsonValue& value, std::string reason) {
  if (error_) {
    return;
  }
  error_ = Error{code, pointer_to(document_, value).value_or(""), std::move(reason)};
}

}  // namespace poolhall::protocol
