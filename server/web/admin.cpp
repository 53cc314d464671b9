#include "server/web/admin.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "protocol/json_node.hpp"
#include "protocol/json_writer.hpp"
#include "server/match/sha256.hpp"

namespace poolhall::web {

namespace {

constexpr std::string_view root = "/api/admin/";
constexpr protocol::JsonBounds settings_bounds{8, 10'000};

storage::Digest digest_of(std::string_view text) {
  return match::sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::optional<HostCalls::Change> change_named(std::string_view name) {
  using Change = HostCalls::Change;
  if (name == "start") {
    return Change::start;
  }
  if (name == "pause") {
    return Change::pause;
  }
  if (name == "resume") {
    return Change::resume;
  }
  return name == "abort" ? std::optional{Change::abort} : std::nullopt;
}

std::optional<HostCalls::EntryChange> entry_change_named(std::string_view name) {
  if (name == "enter") {
    return HostCalls::EntryChange::enter;
  }
  return name == "withdraw" ? std::optional{HostCalls::EntryChange::withdraw} : std::nullopt;
}

Page no_such_call() {
  return refusal(404, "not_found", "there is no such call; see /api/openapi.json");
}

// The text of a body's one member; without it `then` hears why.
std::optional<std::string> member_of(std::string_view body, std::string_view key,
                                     const Then& then) {
  const auto text = protocol::read_document(
      body, settings_bounds,
      [key](const protocol::JsonNode& root_node) { return root_node.at(key).string(); });
  if (text) {
    return *text;
  }
  then(refusal(400, "bad_request", text.error().field + ": " + text.error().reason));
  return std::nullopt;
}

// A bare TOML key, or a quoted one.
std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? key : protocol::canonical_text({key});
}

bool append_toml(std::string& out, const protocol::JsonValue& value);

bool append_members(std::string& out, const protocol::JsonObject& members,
                    std::string_view separator) {
  bool first = true;
  for (const auto& [key, value] : members) {
    out += std::exchange(first, false) ? "" : separator;
    out += toml_key(key) + " = ";
    if (!append_toml(out, value)) {
      return false;
    }
  }
  return true;
}

// JSON's strings and numbers are TOML's; null has no counterpart.
bool append_toml(std::string& out, const protocol::JsonValue& value) {
  if (value.is_null()) {
    return false;
  }
  if (const auto* object = value.as<protocol::JsonObject>()) {
    out += "{";
    const bool done = append_members(out, *object, ", ");
    out += "}";
    return done;
  }
  if (const auto* array = value.as<protocol::JsonArray>()) {
    out += "[";
    for (std::size_t i = 0; i < array->size(); ++i) {
      out += i == 0 ? "" : ", ";
      if (!append_toml(out, (*array)[i])) {
        return false;
      }
    }
    out += "]";
    return true;
  }
  out += protocol::canonical_text(value);
  return true;
}

}  // namespace

tl::expected<std::string, std::string> toml_from_json(std::string_view json) {
  const auto document = protocol::parse_json(json, settings_bounds);
  if (!document) {
    return tl::unexpected(document.error().field + ": " + document.error().reason);
  }
  const auto* object = document->as<protocol::JsonObject>();
  if (object == nullptr) {
    return tl::unexpected("expected an object, got " + protocol::described(*document));
  }
  std::string toml;
  if (!append_members(toml, *object, "\n")) {
    return tl::unexpected(std::string("null is no setting: leave out what is not set"));
  }
  return toml + "\n";
}

Admin::Admin(const std::optional<std::string>& token, HostCalls calls) : calls_(std::move(calls)) {
  if (token) {
    token_hash_ = digest_of(*token);
  }
}

bool Admin::is_for(std::string_view path) {
  return path.starts_with(root);
}

bool Admin::is_authorized(std::string_view authorization) const {
  constexpr std::string_view scheme = "Bearer ";
  if (!token_hash_ || !authorization.starts_with(scheme)) {
    return false;
  }
  const storage::Digest came = digest_of(authorization.substr(scheme.size()));
  return CRYPTO_memcmp(came.data(), token_hash_->data(), came.size()) == 0;
}

void Admin::answer(const AdminRequest& request, const Then& then) const {
  if (!token_hash_) {
    then(refusal(403, "no_admin", "the server was started without --admin-token-file"));
    return;
  }
  if (!is_authorized(request.authorization)) {
    then(refusal(401, "unauthorized",
                 "expected the header \"Authorization: Bearer TOKEN\" with the admin token"));
    return;
  }
  std::string_view rest{request.path};
  rest.remove_prefix(root.size());
  constexpr std::string_view games = "games/";
  constexpr std::string_view tournaments = "tournaments";
  if (rest == "agents") {
    agent_call(request, then);
  } else if (rest.starts_with(games)) {
    game_call(rest.substr(games.size()), then);
  } else if (rest.starts_with(tournaments)) {
    tournament_call(request, rest.substr(tournaments.size()), then);
  } else {
    then(no_such_call());
  }
}

void Admin::tournament_call(const AdminRequest& request, std::string_view rest,
                            const Then& then) const {
  if (rest.empty()) {
    const auto first = request.body.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || request.body[first] != '{') {
      calls_.create_tournament(request.body, then);
      return;
    }
    const auto toml = toml_from_json(request.body);
    if (toml) {
      calls_.create_tournament(*toml, then);
    } else {
      then(refusal(400, "bad_settings", toml.error()));
    }
    return;
  }
  const auto slash = rest.rfind('/');
  const std::string_view call = rest.substr(slash + 1);
  if (rest.front() != '/' || slash < 2) {
    then(no_such_call());
    return;
  }
  const std::string id{rest.substr(1, slash - 1)};
  if (const auto change = change_named(call)) {
    calls_.change_tournament(id, *change, then);
  } else if (const auto entry_change = entry_change_named(call)) {
    entry_call(request, id, *entry_change, then);
  } else {
    then(no_such_call());
  }
}

void Admin::entry_call(const AdminRequest& request, const std::string& id,
                       HostCalls::EntryChange change, const Then& then) const {
  if (const auto agent = member_of(request.body, "agent", then)) {
    calls_.change_entry(id, change, *agent, then);
  }
}

void Admin::agent_call(const AdminRequest& request, const Then& then) const {
  if (const auto name = member_of(request.body, "name", then)) {
    calls_.add_agent(*name, then);
  }
}

void Admin::game_call(std::string_view rest, const Then& then) const {
  constexpr std::string_view call = "/void";
  std::int64_t game = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), game);
  if (error != std::errc{} || game < 1 ||
      rest.substr(static_cast<std::size_t>(end - rest.data())) != call) {
    then(no_such_call());
    return;
  }
  calls_.void_game(game, then);
}

}  // namespace poolhall::web
