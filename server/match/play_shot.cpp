#include "server/match/play_shot.hpp"

#include <optional>
#include <utility>

#include "protocol/events_json.hpp"
#include "protocol/shot_path.hpp"
#include "protocol/state_json.hpp"
#include "server/match/chain.hpp"
#include "server/meter/work_meter.hpp"

namespace poolhall::match {

using meter::Area;
using meter::metered;

namespace {

PlayOutcome fault(const std::string& what, const std::string& why) {
  return ServerFault{what + ": " + why};
}

PlayOutcome judged(const ShotJob& job, const protocol::ReadyShot& ready,
                   const protocol::ExecutedShot& executed,
                   const physics::EventLog<double>& events) {
  const Board& board = *job.board;
  auto ruling = metered(Area::rules, [&] {
    return rules::judge(ready.state, ready.call, events, board.table, board.materials);
  });
  if (!ruling)
    return fault("the referee refused a simulated shot", ruling.error().reason);
  PlayedTurn played{.record = job.row, .next = std::move(ruling->next)};
  storage::TurnRecord& row = played.record;
  row.shot->executed = executed.params;
  row.shot->moved = executed.moved;
  ruling->next = played.next;
  {
    const meter::Metered timed{Area::json_out};
    row.shot->events = protocol::encode_events(events, protocol::EventDetail::full);
    row.ruling = protocol::encode_ruling(*ruling);
    row.state_after = protocol::encode_state(played.next);
  }
  row.result = played.next.result;
  row.checksum = metered(Area::checksums, [&] { return chained(job.previous, row); });
  return played;
}

}  // namespace

std::shared_ptr<const Board> preset_board(const std::string& table, const std::string& materials) {
  const auto known_table = physics::preset_table(table);
  const auto known_materials = physics::preset_materials(materials);
  if (!known_table || !known_materials)
    return nullptr;
  return std::make_shared<const Board>(Board{*known_table, *known_materials});
}

physics::Scene<double> scene_of(const rules::GameState& ready, const Board& board,
                                const protocol::ShotParams& executed) {
  return {.table = board.table,
          .materials = board.materials,
          .balls = rules::balls_on_table(ready),
          .shot = protocol::to_physics(executed)};
}

void share_deviates(ShotJob& job, const GameKey& key, protocol::GameId first) {
  job.key = key;
  job.index = {first, job.row.seat, job.row.shot->index, Stream::shared};
  job.row.shot->shared = true;
}

PlayOutcome play(const ShotJob& job) {
  const Board& board = *job.board;
  const storage::ShotPart& shot = *job.row.shot;
  auto ready = metered(Area::rules, [&] {
    return protocol::ready_shot(job.state, shot.call, shot.cue_ball, shot.intended, board.table,
                                board.materials);
  });
  if (!ready)
    return protocol::request_error(ready.error());

  const protocol::ExecutedShot executed = metered(Area::physics, [&] {
    return protocol::executed_shot(shot.intended, job.noise, shot_deviates(job.key, job.index),
                                   ready->scene.balls, board.table, board.materials);
  });
  ready->scene.shot = protocol::to_physics(executed.params);
  const auto simulation =
      metered(Area::physics, [&] { return physics::simulate(ready->scene, {}); });
  if (!simulation)
    return fault("the simulator refused a shot", simulation.error().reason);
  if (simulation->ending != physics::Ending::at_rest)
    return fault("the simulator did not come to an end", std::string(name(simulation->ending)));
  return judged(job, *ready, executed, simulation->events);
}

}  // namespace poolhall::match
