// What the ten-line bot of clients/cpp/README.md does, as it stands there.
#pragma once

#include "clients/cpp/client.hpp"

namespace poolhall::test_support {

inline client::Move ten_lines(const client::TurnView& turn) {
  // clang-format off
    if (turn.state.kind == rules::TurnKind::decision) return turn.state.options.front();
    if (turn.state.kind != rules::TurnKind::shot) return client::Shot{{.b = 5, .theta = 10, .phi = 90, .v = 4}, {{0.5, 0.3}}, {.kind = rules::legal_calls(turn.state).back()}};
    return client::Shot{{.b = 5, .theta = 10, .phi = 37.0 * turn.state.turn, .v = 4}, {}, {.kind = rules::legal_calls(turn.state).back()}};
  // clang-format on
}

}  // namespace poolhall::test_support
