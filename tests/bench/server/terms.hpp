// On what terms a server is measured.
#pragma once

#include <string_view>

namespace poolhall::bench {

// Its settings: the limits that one machine full of agents needs, and nothing else.
inline constexpr std::string_view server_settings = R"([log]
level = "warning"
[limits]
connections_per_address = 1000000
connections = 1000000
)";

// Some answers are decisions or refused; time-tables are set for so many more than shots.
inline constexpr double answers_a_shot = 1.06;

}  // namespace poolhall::bench
