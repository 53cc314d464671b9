#include "server/net/visitors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

// What an address may do follows from the number of connections that it may have, so that whoever
// raises that for a load test has raised it all: as many arrivals a second, as many new agents a
// minute, and several times that at once.
constexpr std::uint32_t least_number = 32;
constexpr std::uint32_t arrivals_at_once = 4;
constexpr std::uint32_t registrations_at_once = 8;
// Full buckets make a visitor one like any other.
constexpr std::chrono::seconds until_arrivals_are_forgotten{arrivals_at_once};
constexpr std::chrono::minutes until_registrations_are_forgotten{registrations_at_once};
constexpr std::size_t forget_from = 1'024;  // addresses

std::uint32_t times(std::uint32_t factor, std::uint32_t value) {
  const std::uint64_t product = std::uint64_t{factor} * value;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(product, std::numeric_limits<std::uint32_t>::max()));
}

Address network_of(const Address& from) {
  if (!from.is_v6()) {
    return from;
  }
  const auto v6 = from.to_v6();
  if (v6.is_v4_mapped()) {
    return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, v6);
  }
  auto bytes = v6.to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  return boost::asio::ip::address_v6(bytes);
}

}  // namespace

Visitors::Visitor& Visitors::at(const Address& from, SteadyTime now) {
  const std::uint32_t most = std::max(least_number, limits_.connections_per_address);
  const auto found = known_.try_emplace(
      network_of(from),
      Visitor{.last = now,
              .arrivals = {most, times(arrivals_at_once, most)},
              .registrations = {std::max(1U, most / 60), times(registrations_at_once, most)}});
  found.first->second.last = now;
  return found.first->second;
}

std::optional<Error> Visitors::arrives(const Address& from, SteadyTime now) {
  if (connections_ >= limits_.connections) {
    return Error{ErrorCode::server_full, "",
                 fmt::format("the server has {} connections, its bound", connections_)};
  }
  forget_long_gone(now);
  Visitor& visitor = at(from, now);
  if (visitor.connections >= limits_.connections_per_address) {
    return Error{ErrorCode::server_full, "",
                 fmt::format("{} connections from your address, the most that one may have",
                             visitor.connections)};
  }
  if (!visitor.arrivals.take(now)) {
    return Error{ErrorCode::rate_limited, "",
                 fmt::format("more than {} connections a second from your address",
                             std::max(least_number, limits_.connections_per_address))};
  }
  ++visitor.connections;
  ++connections_;
  return std::nullopt;
}

void Visitors::leaves(const Address& from) {
  --connections_;
  if (const auto found = known_.find(network_of(from)); found != known_.end()) {
    --found->second.connections;
  }
}

std::optional<Error> Visitors::registers(const Address& from, SteadyTime now) {
  Visitor& visitor = at(from, now);
  visitor.has_registered = true;
  if (visitor.registrations.take(now)) {
    return std::nullopt;
  }
  return Error{ErrorCode::rate_limited, "",
               "too many new agents from your address; log in as one that you have, or come back "
               "later"};
}

void Visitors::forget_long_gone(SteadyTime now) {
  if (known_.size() < forget_from || now - forgot_ < until_arrivals_are_forgotten) {
    return;
  }
  forgot_ = now;
  std::erase_if(known_, [&](const auto& entry) {
    const Visitor& visitor = entry.second;
    const std::chrono::nanoseconds wait =
        visitor.has_registered ? std::chrono::nanoseconds{until_registrations_are_forgotten}
                               : until_arrivals_are_forgotten;
    return visitor.connections == 0 && now - visitor.last > wait;
  });
}

}  // namespace poolhall::net
