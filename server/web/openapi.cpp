// The table of routes as an OpenAPI document: what is asked, what is answered.
#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "protocol/json_writer.hpp"
#include "server/web/openapi_schemas.hpp"
#include "server/web/routes.hpp"

namespace poolhall::web {

using protocol::JsonWriter;

namespace {

// Which schema what a path answers has; those that are not here answer text, or a scene's log.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> answers{{
    {"/healthz", "Health"},
    {"/api/live", "Live"},
    {"/api/agents", "Agents"},
    {"/api/agents/{agent}", "AgentPage"},
    {"/api/tournaments", "Tournaments"},
    {"/api/tournaments/{tournament}", "TournamentPage"},
    {"/api/games/{game}", "Game"},
    {"/api/games/{game}/shots/{turn}", "Turn"},
    {"/api/evaluate", "Cloud"},
}};

std::string_view schema_of(const Route& route) {
  if (route.who == Route::For::host) {
    return "Done";
  }
  const auto* const found = std::find_if(answers.begin(), answers.end(), [&](const auto& answer) {
    return answer.first == route.path;
  });
  return found == answers.end() ? "" : found->second;
}

// "getApiGamesGame" of GET /api/games/{game}: each stands for one operation.
std::string operation_id(const Route& route) {
  std::string id;
  for (const char c : route.method) {
    id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  bool begins = true;
  for (const char c : route.path) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      begins = true;
    } else {
      id += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      begins = false;
    }
  }
  return id;
}

void write_parameter(JsonWriter& out, std::string_view name) {
  const bool is_name = name == "tournament" || name == "agent" || name == "table";
  out.begin_object().key("name").string(name).key("in").string("path");
  out.key("required").boolean(true).key("schema").begin_object();
  out.key("type").string(is_name ? "string" : "integer").end_object().end_object();
}

void write_parameters(JsonWriter& out, std::string_view path) {
  out.key("parameters").begin_array();
  for (auto open = path.find('{'); open != std::string_view::npos;
       open = path.find('{', open + 1)) {
    write_parameter(out, path.substr(open + 1, path.find('}', open) - open - 1));
  }
  out.end_array();
}

void write_response(JsonWriter& out, std::string_view status, std::string_view meaning,
                    std::string_view type, std::string_view schema) {
  out.key(status).begin_object().key("description").string(meaning);
  out.key("content").begin_object().key(type).begin_object();
  if (!schema.empty()) {
    out.key("schema").begin_object().key("$ref");
    out.string("#/components/schemas/" + std::string(schema)).end_object();
  }
  out.end_object().end_object().end_object();
}

// A table of a tournament comes in three forms.
void write_tables(JsonWriter& out, const Route& route) {
  out.key(route.answers).begin_object().key("description").string(route.summary);
  out.key("content").begin_object();
  for (const std::string_view type : {"application/json", "text/csv", "text/plain"}) {
    out.key(type).begin_object().end_object();
  }
  out.end_object().end_object();
}

void write_operation(JsonWriter& out, const Route& route) {
  const std::string id = operation_id(route);
  out.key(id.substr(0, route.method.size())).begin_object();
  out.key("operationId").string(id).key("summary").string(route.summary);
  write_parameters(out, route.path);
  if (!route.request.empty()) {
    out.key("requestBody").begin_object().key("required").boolean(true);
    out.key("description").string(route.request).key("content").begin_object();
    out.key("*/*").begin_object().end_object().end_object().end_object();
  }
  out.key("responses").begin_object();
  if (route.path.ends_with("/{table}")) {
    write_tables(out, route);
  } else {
    write_response(out, route.answers, route.summary, route.type, schema_of(route));
  }
  write_response(out, "default", "A refusal, with its reason", "application/json", "Refusal");
  out.end_object();
  if (route.who == Route::For::host) {
    out.key("security").begin_array().begin_object();
    out.key("adminToken").begin_array().end_array().end_object().end_array();
  }
  out.end_object();
}

}  // namespace

std::string openapi_document() {
  JsonWriter out;
  out.begin_object().key("openapi").string("3.1.0").key("info").begin_object();
  out.key("title").string("Poolhall").key("version").string("1").end_object();
  out.key("paths").begin_object();
  for (const Route& route : routes()) {
    // One method a path, so that each path stands here once.
    out.key(route.path).begin_object();
    write_operation(out, route);
    out.end_object();
  }
  out.end_object().key("components").begin_object();
  out.key("schemas").raw(openapi_schemas());
  out.key("securitySchemes").begin_object();
  out.key("adminToken").begin_object().key("type").string("http");
  out.key("scheme").string("bearer").end_object().end_object().end_object().end_object();
  return std::move(out).text();
}

}  // namespace poolhall::web
