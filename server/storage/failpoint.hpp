// Named places at which the fault harness kills the server.
//
//   failpoint(Failpoint::before_commit);
//
// POOLHALL_FAILPOINT=before_commit:37 kills the process (SIGKILL) when it comes to that place for
// the 37th time. Unset, a failpoint costs one relaxed load. POOLHALL_FAILPOINT_COUNT=FILE appends
// the place's name and a newline to FILE before the kill, so that hits can be counted.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace poolhall::storage {

enum class Failpoint : std::uint8_t {
  after_receive,   // a complete shot has been read
  after_simulate,  // it has been played, nothing is stored
  before_commit,   // it is in a transaction that is not committed
  after_commit,    // it is durable, nobody has been told
  before_send,     // its reply is about to be handed to the socket
};
[[nodiscard]] std::string_view name(Failpoint place);
[[nodiscard]] std::optional<Failpoint> failpoint_named(std::string_view name);

void failpoint(Failpoint place);

// For tests: called at every failpoint instead of what the environment says; empty takes it back.
void set_failpoint_handler(std::function<void(Failpoint)> handler);

}  // namespace poolhall::storage
