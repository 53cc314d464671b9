// Every check that is a script: what is played at the bot, and what is demanded of it.
//
//   for (const Script& script : scripts()) { Host host(...); script.run(host); }
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "clients/conformance/conduct.hpp"
#include "clients/conformance/host.hpp"

namespace poolhall::conformance {

struct Script {
  CheckInfo info;
  // Returns when all is well; throws Stop.
  std::function<void(Host&)> run;
};

// In the order in which they are reported.
[[nodiscard]] const std::vector<Script>& scripts();

// Its parts.
[[nodiscard]] std::vector<Script> session_scripts();
[[nodiscard]] std::vector<Script> line_scripts();
[[nodiscard]] std::vector<Script> turn_scripts();
[[nodiscard]] std::vector<Script> return_scripts();
[[nodiscard]] std::vector<Script> position_scripts();

}  // namespace poolhall::conformance
