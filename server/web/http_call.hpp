// One HTTP request and its answer, for the commands that talk to a running server. Blocks.
//
//   auto reply = http_call({.server = "127.0.0.1:8080", .target = "/api/tournaments"});
//   if (reply && reply->status == 200) use(reply->body);
//   auto other = http_call({.server = "https://pool.example", .ca_file = "host.pem", ...});
#pragma once

#include <chrono>
#include <string>

#include <tl/expected.hpp>

namespace poolhall::web {

struct HttpCall {
  std::string server;     // HOST:PORT, http://HOST[:PORT] or https://HOST[:PORT]
  std::string ca_file{};  // PEM: whose certificates are believed; empty: those the system believes
  std::string method = "GET";  // or POST
  std::string target;
  std::string token{};  // goes out as Authorization: Bearer; empty: none
  std::string body{};
  std::string content_type = "application/json";
  std::chrono::milliseconds patience{30'000};  // for the whole answer
};

struct HttpReply {
  unsigned status = 0;
  std::string body;
};

// The error is one line: what could not be done.
[[nodiscard]] tl::expected<HttpReply, std::string> http_call(const HttpCall& call);

}  // namespace poolhall::web
