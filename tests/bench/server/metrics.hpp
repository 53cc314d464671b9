// What a server tells of itself at /metrics.
//
//   const Metrics before = metrics_at(server.http_port());
//   before.at("poolhall_commits_total");
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace poolhall::bench {

using Metrics = std::map<std::string, double>;

// Throws std::runtime_error when the server does not answer.
[[nodiscard]] Metrics metrics_at(std::uint16_t port);

}  // namespace poolhall::bench
