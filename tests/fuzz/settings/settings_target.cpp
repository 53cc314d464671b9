#include "tests/fuzz/settings/settings_target.hpp"

#include <string>

#include "server/settings/server_settings.hpp"
#include "server/settings/tournament_settings.hpp"
#include "tests/fuzz/protocol/demand.hpp"

namespace poolhall::fuzz {
namespace {

// An error is one line that a person can act on.
template <class Result>
void demand_usable(const Result& read) {
  if (read) {
    return;
  }
  demand(!read.error().reason.empty(), "an error has a reason");
  demand(settings::text(read.error()).starts_with("fuzz.toml"), "an error names the file");
}

}  // namespace

void settings(std::string_view input) {
  const std::string file = "fuzz.toml";
  demand_usable(settings::parse_server_settings(input, file));
  demand_usable(settings::parse_tournament(input, file));
}

}  // namespace poolhall::fuzz
