// One shot from intention to stored row, as a pure function: placement and call checked by the
// referee, the stroke by the simulator; noise added; simulated; judged; written down. Made for
// worker threads: a job holds all it needs, the outcome all there is to store.
//
//   PlayOutcome outcome = play(job);
//   if (auto* played = std::get_if<PlayedTurn>(&outcome)) store(played->record);
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "physics/materials.hpp"
#include "physics/noise.hpp"
#include "physics/simulator.hpp"
#include "physics/table.hpp"
#include "protocol/errors.hpp"
#include "rules/game_state.hpp"
#include "rules/referee.hpp"
#include "server/match/fair_noise.hpp"
#include "server/storage/records.hpp"

namespace poolhall::match {

// What a game is played on.
struct Board {
  physics::Table table;
  physics::Materials materials;
};
// Nothing if there is no such preset.
[[nodiscard]] std::shared_ptr<const Board> preset_board(const std::string& table,
                                                        const std::string& materials);

struct ShotJob {
  std::shared_ptr<const Board> board;
  rules::GameState state;
  protocol::NoiseParams noise;
  // What its deviates are drawn from, by the worker.
  GameKey key{};  // mixed
  ShotIndex index;
  storage::Digest previous{};  // checksum of the row before
  // Complete but for what the shot brings about: `shot->executed`, `moved`, `events`, the ruling,
  // the state after, the result and the checksum.
  storage::TurnRecord row;
};

// Mirrored noise: the shot gets the deviates that its pair shares, under the mixed key and the id
// of the pair's first game.
void share_deviates(ShotJob& job, const GameKey& key, protocol::GameId first);

struct PlayedTurn {
  storage::TurnRecord record;
  rules::GameState next;
};
// The server's own failure; never scored against a player.
struct ServerFault {
  std::string reason;
};
// An error is the player's: what was asked cannot be played.
using PlayOutcome = std::variant<PlayedTurn, protocol::Error, ServerFault>;

[[nodiscard]] PlayOutcome play(const ShotJob& job);

// The scene in which a stroke was played: of the state with the cue ball placed.
[[nodiscard]] physics::Scene<double> scene_of(const rules::GameState& ready, const Board& board,
                                              const protocol::ShotParams& executed);

}  // namespace poolhall::match
