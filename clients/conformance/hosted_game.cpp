#include "clients/conformance/hosted_game.hpp"

#include <utility>

#include "clients/bots/house_bots.hpp"
#include "protocol/events_json.hpp"
#include "protocol/shot_path.hpp"
#include "protocol/state_json.hpp"
#include "protocol/table_json.hpp"

namespace poolhall::conformance {

using protocol::ErrorCode;
using rules::Seat;

namespace {

// Enough draws that one of them leaves the table to the bot.
constexpr std::uint64_t most_draws = 40;

protocol::Hex256 hex(char digit) {
  return {std::string(64, digit)};
}

}  // namespace

std::int64_t time_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

HostedGame::HostedGame(GamePlan plan, protocol::EventDetail detail)
    : plan_(std::move(plan)),
      detail_(detail),
      table_(physics::preset_table(plan_.table).value()),
      materials_(physics::preset_materials(plan_.materials).value()),
      state_(plan_.position.value_or(
          rules::new_game({.rules = plan_.rules, .breaker = Seat::first, .rack_seed = plan_.seed},
                          table_, materials_))) {}

protocol::GameTerms<Outgoing> HostedGame::terms() const {
  protocol::GameTerms<Outgoing> terms;
  terms.game = plan_.id;
  terms.match = plan_.match;
  terms.tournament = plan_.tournament;
  terms.seat = plan_.seat;
  terms.opponent = plan_.opponent;
  terms.rules = plan_.rules;
  terms.table.text = protocol::encode_table(table_);
  terms.physics.text = protocol::encode_materials(materials_);
  terms.noise = plan_.noise;
  terms.clock = plan_.clock;
  terms.commitment = hex('a');
  terms.agent_commitments[rules::index(plan_.seat)] = plan_.own_commitment;
  terms.agent_commitments[rules::index(rules::other(plan_.seat))] = hex('b');
  return terms;
}

protocol::ClockReading HostedGame::clock() const {
  protocol::ClockReading reading{plan_.left.count(), plan_.left.count(), {}};
  if (!state_.result) {
    reading.deadline_ms = time_ms() + plan_.left.count();
  }
  return reading;
}

protocol::GameStart<Outgoing> HostedGame::start() const {
  return {terms(), {protocol::encode_state(state_)}};
}

protocol::GameSnapshot<Outgoing> HostedGame::snapshot() const {
  return {terms(), {protocol::encode_state(state_)}, clock()};
}

protocol::GameTurn<Outgoing> HostedGame::turn() const {
  protocol::GameTurn<Outgoing> turn;
  turn.game = plan_.id;
  turn.turn = state_.turn;
  turn.kind = state_.kind;
  turn.state.text = protocol::encode_state(state_);
  turn.clock = clock();
  if (state_.kind == rules::TurnKind::decision) {
    turn.legal = protocol::LegalDecisions{state_.options};
  } else {
    turn.legal = protocol::LegalBalls{rules::callable_balls(state_),
                                      rules::legal_first_balls(state_), rules::legal_calls(state_)};
  }
  turn.refusals = refusals_;
  return turn;
}

protocol::GameOver HostedGame::over() const {
  const rules::GameResult result =
      state_.result.value_or(rules::GameResult{{}, rules::EndReason::void_game});
  return {plan_.id, plan_.match, result.winner, result.reason, true, hex('c')};
}

protocol::GameListing HostedGame::listing() const {
  return {
      plan_.id,         plan_.match,
      plan_.tournament, plan_.seat,
      plan_.opponent,   state_.result ? protocol::GameStatus::over : protocol::GameStatus::running};
}

protocol::Error HostedGame::error(ErrorCode code, std::string field, std::string reason) const {
  return {code, std::move(field), std::move(reason), plan_.id};
}

protocol::Expected<Played> HostedGame::judge(const protocol::Shot& shot) const {
  return play(shot, plan_.seat);
}

protocol::Expected<Played> HostedGame::play(const protocol::Shot& shot, Seat by) const {
  const auto ready =
      protocol::ready_shot(state_, shot.call, shot.cue_ball, shot.params, table_, materials_);
  if (!ready) {
    auto refused = protocol::request_error(ready.error());
    refused.game = plan_.id;
    return tl::unexpected(std::move(refused));
  }
  auto played = protocol::play_shot(*ready);
  if (!played) {
    return tl::unexpected(
        error(ErrorCode::internal, "", protocol::request_error(played.error()).reason));
  }
  protocol::GameShot<Outgoing> told;
  told.game = plan_.id;
  told.turn = state_.turn;
  told.by = by;
  told.shot_id = shot.shot_id;
  told.call = shot.call;
  told.cue_ball = shot.cue_ball;
  told.intended = told.executed = shot.params;
  told.ruling.text = protocol::encode_ruling(played->ruling);
  told.events.text = protocol::encode_events(played->simulation.events, detail_);
  told.state.text = protocol::encode_state(played->ruling.next);
  told.clock = {plan_.left.count(), plan_.left.count(), {}};
  return Played{std::move(told), std::move(played->ruling.next)};
}

protocol::Expected<Played> HostedGame::judge(const protocol::Decide& decide) const {
  auto next = rules::decide(state_, decide.choice, table_, materials_);
  if (!next) {
    auto refused = protocol::error_from(next.error(), "/params");
    refused.game = plan_.id;
    return tl::unexpected(std::move(refused));
  }
  protocol::GameDecision<Outgoing> told{plan_.id,
                                        state_.turn,
                                        state_.to_move,
                                        decide.choice,
                                        {protocol::encode_state(*next)},
                                        {plan_.left.count(), plan_.left.count(), {}}};
  return Played{std::move(told), *std::move(next)};
}

void HostedGame::store(const Played& played) {
  if (const auto* shot = std::get_if<protocol::GameShot<Outgoing>>(&played.told)) {
    const protocol::Shot asked{shot->game,     shot->turn,     shot->shot_id,
                               shot->intended, shot->cue_ball, shot->call};
    if (shot->by == plan_.seat) {
      stored_.insert_or_assign(state_.turn, std::pair{protocol::Request{asked}, played});
    }
  } else if (state_.to_move == plan_.seat) {
    const auto& decision = std::get<protocol::GameDecision<Outgoing>>(played.told);
    const protocol::Decide asked{decision.game, decision.turn, decision.choice};
    stored_.insert_or_assign(state_.turn, std::pair{protocol::Request{asked}, played});
  }
  state_ = played.next;
  refusals_ = 0;
}

protocol::GameTurnLost<Outgoing> HostedGame::lose_turn(rules::FoulCode code) {
  const rules::Ruling ruling = rules::judge_lost_turn(state_, code, table_, materials_);
  protocol::GameTurnLost<Outgoing> lost{plan_.id,
                                        state_.turn,
                                        state_.to_move,
                                        {protocol::encode_ruling(ruling)},
                                        {protocol::encode_state(ruling.next)},
                                        {plan_.left.count(), plan_.left.count(), {}}};
  state_ = ruling.next;
  refusals_ = 0;
  return lost;
}

void HostedGame::end(const rules::GameResult& result) {
  state_ = rules::ended(state_, result);
}

protocol::Expected<protocol::Reply<Outgoing>> HostedGame::again(const protocol::Shot& shot) const {
  const auto found = stored_.find(shot.turn);
  const auto* first =
      found == stored_.end() ? nullptr : std::get_if<protocol::Shot>(&found->second.first);
  if (first == nullptr || first->shot_id != shot.shot_id) {
    return tl::unexpected(error(ErrorCode::stale_turn, "/params/turn", "got a turn that is over"));
  }
  if (*first != shot) {
    return tl::unexpected(error(ErrorCode::conflicting_shot, "/params/shot_id",
                                "this shot_id stands for a shot with another content"));
  }
  return protocol::ShotReply<Outgoing>{
      std::get<protocol::GameShot<Outgoing>>(found->second.second.told),
      protocol::Repetition::duplicate};
}

protocol::Expected<protocol::Reply<Outgoing>> HostedGame::again(
    const protocol::Decide& decide) const {
  const auto found = stored_.find(decide.turn);
  const auto* first =
      found == stored_.end() ? nullptr : std::get_if<protocol::Decide>(&found->second.first);
  if (first == nullptr) {
    return tl::unexpected(error(ErrorCode::stale_turn, "/params/turn", "got a turn that is over"));
  }
  if (first->choice != decide.choice) {
    return tl::unexpected(error(ErrorCode::conflicting_request, "/params/choice",
                                "got another choice than the one that was taken"));
  }
  return protocol::DecideReply<Outgoing>{
      std::get<protocol::GameDecision<Outgoing>>(found->second.second.told),
      protocol::Repetition::duplicate};
}

Played HostedGame::opponent_plays() {
  const std::uint64_t seed = plan_.seed + state_.turn * most_draws;
  const client::GameInfo info{
      .seat = state_.to_move, .rules = plan_.rules, .table = table_, .materials = materials_};
  std::optional<Played> chosen;
  for (std::uint64_t draw = 0; draw < most_draws; ++draw) {
    const auto player = bots::house_bot("random", {.seed = seed + draw}).value()(info);
    const client::Move move = player->choose({info, state_});
    std::optional<protocol::Expected<Played>> played;
    if (const auto* shot = std::get_if<client::Shot>(&move)) {
      const std::string shot_id = "\"o" + std::to_string(state_.turn) + "\"";
      played = play({plan_.id, state_.turn, {shot_id}, shot->stroke, shot->cue_ball, shot->call},
                    state_.to_move);
    } else if (const auto* choice = std::get_if<rules::Decision>(&move)) {
      played = judge(protocol::Decide{plan_.id, state_.turn, *choice});
    }
    if (!played || !*played || (*played)->next.result) {
      continue;
    }
    chosen = **played;
    if (chosen->next.to_move == plan_.seat) {
      break;
    }
  }
  Played played = chosen.value();
  store(played);
  return played;
}

}  // namespace poolhall::conformance
