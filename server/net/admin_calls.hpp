// What the host's calls do (server/web/admin.hpp): tournaments, agents, games.
//
//   TournamentDesk desk{...};
//   web::Admin admin{token, host_calls(arena, archive, desk)};
#pragma once

#include "server/net/arena.hpp"
#include "server/net/tournament_desk.hpp"
#include "server/web/admin.hpp"

namespace poolhall::net {

// On the network thread, as everything of the arena's. All three outlive the calls.
[[nodiscard]] web::HostCalls host_calls(Arena& arena, Archive& archive, TournamentDesk& desk);

}  // namespace poolhall::net
