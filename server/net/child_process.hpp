// A child that dies with this process and inherits nothing of it but standard input, output and
// error.
//
//   std::optional<Child> child = start_child({"/usr/bin/env"}, {"A=1"});
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace poolhall::net {

struct Child {
  pid_t pid = 0;
  int exit_descriptor = -1;  // readable once the child has ended; the caller's to close
};

// Nothing if the system cannot start one now. `arguments[0]` is the program's path.
[[nodiscard]] std::optional<Child> start_child(const std::vector<std::string>& arguments,
                                               const std::vector<std::string>& environment);

}  // namespace poolhall::net
