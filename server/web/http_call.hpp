// One HTTP request and its answer, for the commands that talk to a running server. Blocks.
//
//   auto reply = http_call({.server = "127.0.0.1:8080", .target = "/api/tournaments"});
//   if (reply && reply->status == 200) use(reply->body);
#pragma once

#include <string>

#include <tl/expected.hpp>

namespace poolhall::web {

struct HttpCall {
  std::string server;          // HOST:PORT
  std::string method = "GET";  // or POST
  std::string target;
  std::string token{};  // goes out as Authorization: Bearer; empty: none
  std::string body{};
  std::string content_type = "application/json";
};

struct HttpReply {
  unsigned status = 0;
  std::string body;
};

// The error is one line: what could not be done. A server that says nothing for 30 s is one.
[[nodiscard]] tl::expected<HttpReply, std::string> http_call(const HttpCall& call);

}  // namespace poolhall::web
