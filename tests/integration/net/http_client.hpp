// One HTTP request over a connection of its own, for tests.
//
//   HttpAnswer answer = http_call(port, {"POST", "/api/admin/agents", R"({"name":"anna"})",
//   token}); answer.status; answer.body;
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace poolhall::net_tests {

struct HttpCall {
  std::string method = "GET";
  std::string path;
  std::string body{};
  std::string token{};                 // as "Authorization: Bearer TOKEN", unless it is empty
  std::vector<std::string> headers{};  // more of them, "Name: value"
  std::string host = "127.0.0.1";
  std::string ca_file{};  // of a server that is asked by HTTPS; empty: plain HTTP
};

struct HttpAnswer {
  int status = 0;
  std::string head;
  std::string body;
};

[[nodiscard]] HttpAnswer http_call(std::uint16_t port, const HttpCall& call);

// The string that a JSON text has under this key, "" if there is none; for flat answers.
[[nodiscard]] std::string member(const std::string& json, const std::string& key);

}  // namespace poolhall::net_tests
