#include "protocol/json_value.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/json_writer.hpp"

namespace poolhall::protocol {
namespace {

// What was read may hold a token, so only as much of it is repeated as shows the mistake.
constexpr std::size_t longest_repeated_token = 16;

// No object of the protocol or of a file comes near it; it bounds the search for duplicate keys.
constexpr std::size_t most_members = 1024;

// One open array or object while parsing.
struct Open {
  JsonValue value;
  std::string key;  // of the member that is being read, when value is an object
};

// "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while parsing
// value - invalid literal; last read: 'x'; expected y" to "line 1, column 5: invalid literal;
// expected y".
std::string in_short(std::string_view what) {
  const auto between = [&](std::string_view from, std::string_view to) {
    const std::size_t start = what.find(from);
    if (start == std::string_view::npos) {
      return std::string_view();
    }
    const std::string_view tail = what.substr(start + from.size());
    return tail.substr(0, tail.find(to));
  };
  std::string place(between("parse error at ", ": "));
  std::string problem(between(" - ", "; last read: "));
  const std::size_t expected = what.rfind("; expected ");
  if (problem.empty()) {
    return std::string(between("] ", "; last read: "));
  }
  return place + ": " + problem +
         (expected == std::string_view::npos ? "" : std::string(what.substr(expected)));
}

// Builds the tree while the bounds hold; the first failure is kept and ends the parse.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit TreeBuilder(JsonBounds bounds) : bounds_(bounds) {}

  bool null() override { return add({}); }
  bool boolean(bool value) override { return add({value}); }
  bool number_integer(number_integer_t value) override { return add({value}); }
  bool number_unsigned(number_unsigned_t value) override { return add({value}); }
  bool number_float(number_float_t value, const string_t&) override { return add({value}); }
  bool string(string_t& value) override { return add({std::move(value)}); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open({JsonObject{}}); }
  bool start_array(std::size_t) override { return open({JsonArray{}}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override;
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception& failure) override;

  [[nodiscard]] Expected<JsonValue> take() &&;

 private:
  bool add(JsonValue value);
  bool open(JsonValue value);
  bool close();
  bool refuse(std::string field, std::string reason);
  [[nodiscard]] std::string here() const;

  JsonBounds bounds_;
  std::vector<Open> open_;
  JsonValue root_;
  std::size_t keys_ = 0;
  std::optional<Error> error_;
};

bool TreeBuilder::add(JsonValue value) {
  if (open_.empty()) {
    root_ = std::move(value);
    return true;
  }
  Open& top = open_.back();
  if (auto* array = std::get_if<JsonArray>(&top.value.data)) {
    array->push_back(std::move(value));
  } else {
    std::get<JsonObject>(top.value.data).emplace_back(std::move(top.key), std::move(value));
  }
  return true;
}

bool TreeBuilder::open(JsonValue value) {
  if (open_.size() == bounds_.nesting) {
    return refuse(here(),
                  "nested deeper than " + std::to_string(bounds_.nesting) + " arrays and objects");
  }
  open_.push_back({std::move(value), {}});
  return true;
}

bool TreeBuilder::close() {
  JsonValue done = std::move(open_.back().value);
  open_.pop_back();
  return add(std::move(done));
}

bool TreeBuilder::key(string_t& name) {
  Open& top = open_.back();
  const std::string object = here();
  if (++keys_ > bounds_.keys) {
    return refuse(object, "more than " + std::to_string(bounds_.keys) + " keys in all");
  }
  if (std::get<JsonObject>(top.value.data).size() == most_members) {
    return refuse(object, "more than " + std::to_string(most_members) + " keys in one object");
  }
  if (top.value.member(name) != nullptr) {
    return refuse(object + pointer_token(name), "the key stands twice in one object");
  }
  top.key = std::move(name);
  return true;
}

bool TreeBuilder::parse_error(std::size_t position, const std::string& last_token,
                              const nlohmann::detail::exception& failure) {
  const bool overflow = dynamic_cast<const nlohmann::detail::out_of_range*>(&failure) != nullptr;
  std::string reason =
      overflow ? "a number that is too large for a double at byte " + std::to_string(position)
               : "not JSON at " + in_short(failure.what());
  // A token of nlohmann's with control characters in it is written "<U+000A>".
  if (!last_token.empty() && last_token.size() <= longest_repeated_token &&
      last_token.find("<U+") == std::string::npos) {
    reason += "; got " + last_token;
  }
  return refuse(here(), std::move(reason));
}

bool TreeBuilder::refuse(std::string field, std::string reason) {
  error_ = Error{ErrorCode::parse_error, std::move(field), std::move(reason)};
  return false;
}

// The pointer to the value that is being read.
std::string TreeBuilder::here() const {
  std::string pointer;
  for (const Open& level : open_) {
    if (const auto* array = level.value.as<JsonArray>()) {
      pointer += "/" + std::to_string(array->size());
    } else if (!level.key.empty()) {
      pointer += pointer_token(level.key);
    }
  }
  return pointer;
}

Expected<JsonValue> TreeBuilder::take() && {
  if (error_) {
    return tl::unexpected(std::move(*error_));
  }
  return std::move(root_);
}

void write_value(JsonWriter& out, const JsonValue& value);

struct ValueWriter {
  JsonWriter& out;
  void operator()(std::monostate) const { out.null(); }
  void operator()(bool value) const { out.boolean(value); }
  void operator()(std::int64_t value) const { out.integer(value); }
  void operator()(std::uint64_t value) const { out.integer(value); }
  void operator()(double value) const { out.number(value); }
  void operator()(const std::string& value) const { out.string(value); }
  void operator()(const JsonArray& values) const {
    out.begin_array();
    for (const JsonValue& value : values) {
      write_value(out, value);
    }
    out.end_array();
  }
  void operator()(const JsonObject& members) const {
    out.begin_object();
    for (const auto& [key, value] : members) {
      out.key(key);
      write_value(out, value);
    }
    out.end_object();
  }
};

void write_value(JsonWriter& out, const JsonValue& value) {
  std::visit(ValueWriter{out}, value.data);
}

}  // namespace

const JsonValue* JsonValue::member(std::string_view key) const {
  const auto* object = as<JsonObject>();
  if (object == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(object->begin(), object->end(),
                                  [&](const auto& entry) { return entry.first == key; });
  return found == object->end() ? nullptr : &found->second;
}

Expected<JsonValue> parse_json(std::string_view text, JsonBounds bounds) {
  TreeBuilder builder(bounds);
  // The builder keeps the reason of a failure, so the parser's yes or no is not needed.
  static_cast<void>(nlohmann::json::sax_parse(text.begin(), text.end(), &builder));
  return std::move(builder).take();
}

std::string canonical_text(const JsonValue& value) {
  JsonWriter out;
  write_value(out, value);
  return std::move(out).text();
}

std::string pointer_token(std::string_view key) {
  // A key may be as long as the line; an error need not repeat it.
  constexpr std::size_t longest_key = 64;
  std::string token = "/";
  for (const char c : key.substr(0, longest_key)) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace poolhall::protocol
