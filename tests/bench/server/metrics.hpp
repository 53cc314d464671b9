// What a server tells of itself: the figures at /metrics, and any page of its API.
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

// The body of what is answered to a GET.
[[nodiscard]] std::string body_at(std::uint16_t port, const std::string& path);

}  // namespace poolhall::bench
