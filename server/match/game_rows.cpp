#include "server/match/game_rows.hpp"

#include "physics/version.hpp"
#include "protocol/state_json.hpp"
#include "rules/referee.hpp"
#include "rules/version.hpp"
#include "server/match/chain.hpp"
#include "server/match/play_shot.hpp"

namespace poolhall::match {
namespace {

using protocol::Error;
using protocol::ErrorCode;

Error stale(const storage::TurnRecord& row) {
  return {ErrorCode::stale_turn, "/params/turn",
          "got " + std::to_string(row.number) + ", which is over", row.game, false};
}

}  // namespace

tl::expected<storage::GameRecord, std::string> new_game_record(const GameOrder& order) {
  storage::GameRecord game;
  game.id = order.id;
  game.match = order.match;
  game.number = order.number;
  game.attempt = order.attempt;
  game.agents = order.agents;
  game.terms = order.terms;
  game.breaker = order.breaker;
  game.rack_seed = order.rack_seed;
  game.key = order.key;
  game.created = order.created;
  game.agent_commitments = order.agent_commitments;
  game.shared_from = order.shared_from;
  game.physics_version = physics::version;
  game.rules_version = rules::version;

  const auto board = preset_board(order.terms.table, order.terms.materials);
  if (!board)
    return tl::unexpected("no preset table \"" + order.terms.table + "\" or materials \"" +
                          order.terms.materials + "\"");
  const auto noise = game_noise(order.terms.noise, order.key, order.id);
  if (!noise)
    return tl::unexpected("no noise track \"" + order.terms.noise + "\"");
  game.noise = *noise;
  const rules::GameSettings settings = game.settings();
  if (auto checked = rules::check_settings(settings, board->table, board->materials); !checked)
    return tl::unexpected(checked.error().field + ": " + checked.error().reason);
  game.initial_state =
      protocol::encode_state(rules::new_game(settings, board->table, board->materials));
  game.commitment = commit({.game = game.id,
                            .key = game.key,
                            .noise = game.noise,
                            .rack_seed = game.rack_seed,
                            .rack_gap = game.terms.rack_gap,
                            .rack_jitter = game.terms.rack_jitter});
  game.seal = seal(game);
  return game;
}

storage::MatchRecord finished(storage::MatchRecord match, storage::UnixMicros when) {
  match.over = true;
  match.finished = when;
  match.seal = seal(match);
  return match;
}

storage::GameRecord finished(storage::GameRecord game, const storage::TurnRecord& last) {
  game.over = true;
  game.result = last.result;
  game.turns = last.number;
  game.head = last.checksum;
  game.finished = last.stored;
  game.seal = seal(game);
  return game;
}

bool is_played(storage::TurnAction action) {
  return action == storage::TurnAction::shot || action == storage::TurnAction::decision ||
         action == storage::TurnAction::lost_turn;
}

std::optional<Error> repeated_shot(const storage::TurnRecord& row, Seat by,
                                   const protocol::Shot& shot) {
  if (!row.shot || row.seat != by || row.request != shot.shot_id)
    return stale(row);
  if (row.shot->intended == shot.params && row.shot->cue_ball == shot.cue_ball &&
      row.shot->call == shot.call)
    return std::nullopt;
  return Error{ErrorCode::conflicting_shot, "/params/shot_id",
               "got " + shot.shot_id.json + " again with another content", row.game, false};
}

std::optional<Error> repeated_decision(const storage::TurnRecord& row, Seat by,
                                       const protocol::Decide& decide) {
  if (!row.decision || row.seat != by)
    return stale(row);
  if (*row.decision == decide.choice)
    return std::nullopt;
  return Error{ErrorCode::conflicting_request, "/params/choice",
               "got another choice than the one that was taken", row.game, false};
}

}  // namespace poolhall::match
