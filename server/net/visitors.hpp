// Who comes from where: how many connections each address has, how fast it makes them, and how
// many agents it has registered. One for all ports together.
//
//   if (const auto error = visitors.arrives(address, now)) turn_away(*error);
//   ...
//   visitors.leaves(address);
//
// An address is an IPv4 address or the first 64 bits of an IPv6 address: whoever has one of those
// has all that begin with them.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "protocol/errors.hpp"
#include "protocol/limits.hpp"
#include "server/net/deadline_queue.hpp"
#include "server/web/token_bucket.hpp"

namespace poolhall::net {

using Address = boost::asio::ip::address;

class Visitors {
 public:
  // `limits` has to outlive it.
  explicit Visitors(const protocol::Limits& limits) : limits_(limits) {}

  // Counts a new connection, or says why there may be none.
  [[nodiscard]] std::optional<protocol::Error> arrives(const Address& from, SteadyTime now);
  void leaves(const Address& from);
  // Counts a new agent, or says why there may be none.
  [[nodiscard]] std::optional<protocol::Error> registers(const Address& from, SteadyTime now);

  [[nodiscard]] std::size_t connections() const { return connections_; }
  // Addresses that it remembers.
  [[nodiscard]] std::size_t known() const { return known_.size(); }

 private:
  struct Visitor {
    std::uint32_t connections = 0;
    bool has_registered = false;
    SteadyTime last;
    web::TokenBucket arrivals;
    web::TokenBucket registrations;
  };

  Visitor& at(const Address& from, SteadyTime now);
  // Those whose buckets are full again are like those who never came.
  void forget_long_gone(SteadyTime now);

  const protocol::Limits& limits_;
  std::size_t connections_ = 0;
  std::map<Address, Visitor> known_;
  SteadyTime forgot_{};
};

}  // namespace poolhall::net
