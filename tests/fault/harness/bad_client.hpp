// Clients that behave badly, each in its own way, over plain blocking sockets. What they do is
// written in bad_client.cpp, one function each; what the server says to it comes from its log.
//
//   for (const BadClient& client : bad_clients()) {
//     const BadVisit visit = client.visit(port, log);
//     log.await_end(visit.local_port);    // "too_slow: no login within 2000 ms ..."
//   }
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/limits.hpp"

namespace poolhall::fault {

// How one visit went, as the client saw it.
struct BadVisit {
  std::uint16_t local_port = 0;      // of the connection that was to end
  std::optional<std::string> fault;  // what the server did and should not have
};

class EndLog;

struct BadClient {
  std::string_view name;
  // What the reason for the connection's end begins with, in the server's log.
  std::string_view expected;
  BadVisit (*visit)(std::uint16_t port, EndLog& log);
};

[[nodiscard]] const std::vector<BadClient>& bad_clients();

// Limits under which their visits are short.
[[nodiscard]] protocol::Limits limits_for_bad_clients();

}  // namespace poolhall::fault
