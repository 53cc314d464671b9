#include "server/web/pages.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "server/web/page_parts.hpp"
#include "server/web/table_pages.hpp"

namespace poolhall::web {

namespace {

std::optional<std::int64_t> number_in(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty() || value < 0) {
    return std::nullopt;
  }
  return value;
}

// "%3A" is ":"; what is no escape stays as it is.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* const begin = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(begin, begin + 2, value, 16).ptr == begin + 2) {
      plain += static_cast<char>(value);
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const auto end = std::min(path.find('/'), path.size());
    segments.push_back(unescaped(path.substr(0, end)));
    path.remove_prefix(end);
  }
  return segments;
}

}  // namespace

Page refusal(unsigned status, std::string_view code, std::string_view reason) {
  JsonWriter out;
  out.begin_object().key("error").begin_object();
  out.key("code").string(code).key("reason").string(reason).end_object().end_object();
  return {status, "application/json", std::move(out).text()};
}

Page unreadable(const storage::StorageError& error) {
  return refusal(503, "database", error.reason);
}

Page not_found(std::string_view what) {
  return refusal(404, "not_found", what);
}

Page page_of(JsonWriter& out) {
  return {200, "application/json", std::move(out).text()};
}

std::int64_t unix_ms(storage::UnixMicros t) {
  return number(t) / 1000;
}

storage::Expected<Names> names_of(Reader& reader) {
  const auto agents = reader.agents();
  if (!agents) {
    return tl::unexpected(agents.error());
  }
  Names names;
  for (const storage::AgentRecord& agent : *agents) {
    names[storage::number(agent.id)] = agent.name;
  }
  return names;
}

const std::string& name_in(const Names& names, storage::AgentId agent) {
  static const std::string unknown = "?";
  const auto found = names.find(storage::number(agent));
  return found == names.end() ? unknown : found->second;
}

void write_agents(JsonWriter& out, const std::array<storage::AgentId, 2>& agents,
                  const Names& names) {
  out.key("agents").begin_array();
  for (const storage::AgentId agent : agents) {
    out.string(name_in(names, agent));
  }
  out.end_array();
}

void write_result(JsonWriter& out, const storage::GameRecord& game) {
  out.key("over").boolean(game.over);
  if (!game.result) {
    return;
  }
  out.key("winner");
  if (game.result->winner) {
    out.integer(rules::index(*game.result->winner));
  } else {
    out.null();
  }
  out.key("reason").string(rules::name(game.result->reason));
  out.key("scored").boolean(game.result->reason != rules::EndReason::void_game);
}

Page answer(Reader& reader, std::string_view path, std::chrono::milliseconds delay) {
  const Horizon horizon{delay};
  const auto segments = segments_of(path);
  if (segments.size() < 2 || segments[0] != "api") {
    return not_found("the API's pages begin with /api/");
  }
  const std::string& what = segments[1];
  if (what == "agents" && segments.size() <= 3) {
    return segments.size() == 2 ? agents_page(reader, horizon)
                                : agent_page(reader, segments[2], horizon);
  }
  if (what == "tournaments" && segments.size() <= 3) {
    return segments.size() == 2 ? tournaments_page(reader, horizon)
                                : tournament_page(reader, segments[2], horizon);
  }
  const bool is_table = segments.size() == 4 && what == "tournaments";
  if (delay.count() > 0 && (is_table || what == "tournaments.txt")) {
    return not_found("tables are not told while spectators are delayed");
  }
  if (segments.size() == 2 && what == "tournaments.txt") {
    return tournament_list_page(reader);
  }
  if (is_table) {
    return table_page(reader, segments[2], segments[3]);
  }
  const bool shot = segments.size() == 5 && segments[3] == "shots";
  if (what == "games" && (segments.size() == 3 || shot)) {
    const auto game = number_in(segments[2]);
    const auto turn = shot ? number_in(segments[4]) : std::optional<std::int64_t>{0};
    if (!game || !turn) {
      return not_found("games and turns are called by their numbers");
    }
    return shot ? shot_page(reader, *game, *turn, horizon) : game_page(reader, *game, horizon);
  }
  return not_found("there is no such page");
}

}  // namespace poolhall::web
