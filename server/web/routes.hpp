// Every path of the page's port that programs use, in one table: what is not here is not answered,
// and /api/openapi.json is made from it.
//
//   Routing routing = route_of("GET", "/api/games/17");
//   if (auto* route = std::get_if<const Route*>(&routing)) ...
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace poolhall::web {

struct Route {
  enum class For : std::uint8_t { everybody, host };  // the host: with the admin token

  std::string_view method;  // "GET" stands for HEAD too
  std::string_view path;    // "/api/games/{game}"
  std::string_view summary;
  For who = For::everybody;
  std::string_view request = {};     // what the body is, "" for none
  std::string_view answers = "200";  // statuses of success, with a space between
  std::string_view type = "application/json";
};

[[nodiscard]] std::span<const Route> routes();

enum class NoRoute : std::uint8_t { path, method };  // there is no such path, or not this method
using Routing = std::variant<const Route*, NoRoute>;
[[nodiscard]] Routing route_of(std::string_view method, std::string_view path);

// The table as an OpenAPI 3.1 document, with schemas of what is answered (openapi.cpp).
[[nodiscard]] std::string openapi_document();

}  // namespace poolhall::web
