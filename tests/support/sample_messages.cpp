#include "tests/support/sample_messages.hpp"

#include <string>

#include "protocol/shot_path.hpp"
#include "protocol/table_json.hpp"

namespace poolhall::test_support {
namespace {

using namespace protocol;
using rules::Seat;

constexpr GameId game{17};
constexpr MatchId match{5};
constexpr TournamentId tournament{2};
constexpr ChallengeId challenge{9};

Hex256 hex(char digit) {
  return {std::string(64, digit)};
}

physics::Table table() {
  return physics::preset_table("olympiad").value();
}
physics::Materials materials() {
  return physics::preset_materials("olympiad").value();
}

GameTerms<Outgoing> terms(rules::RuleSet rules, const char* table_name, const char* physics_name) {
  GameTerms<Outgoing> t;
  t.game = game;
  t.match = match;
  t.seat = Seat::second;
  t.opponent = "house:greedy";
  t.rules = rules;
  t.table.text = encode_table(physics::preset_table(table_name).value());
  t.physics.text = encode_materials(physics::preset_materials(physics_name).value());
  t.commitment = hex('a');
  t.agent_commitments = {std::nullopt, hex('b')};
  return t;
}

GameShot<Outgoing> shot(const PlayedBreak& played, EventDetail detail) {
  GameShot<Outgoing> s;
  s.game = game;
  s.turn = played.before.turn;
  s.by = played.before.to_move;
  s.shot_id = {"\"break-1\""};
  s.call = played.call;
  s.cue_ball = played.cue_ball;
  s.intended = played.params;
  s.executed = played.params;
  s.ruling.text = encode_ruling(played.ruling);
  s.events.text = encode_events(played.events, detail);
  s.state.text = encode_state(played.ruling.next);
  s.clock = {599'000, 600'000, std::nullopt};
  return s;
}

GameTurn<Outgoing> turn(const rules::GameState& state) {
  GameTurn<Outgoing> t;
  t.game = game;
  t.turn = state.turn;
  t.kind = state.kind;
  t.state.text = encode_state(state);
  t.clock = {600'000, 599'000, 1'700'000'600'000};
  if (state.kind == rules::TurnKind::decision) {
    t.legal = LegalDecisions{state.options};
  } else {
    t.legal = LegalBalls{rules::callable_balls(state), rules::legal_first_balls(state),
                         rules::legal_calls(state)};
  }
  return t;
}

GameTurn<Outgoing> decision_turn(const PlayedBreak& played) {
  rules::GameState state = played.ruling.next;
  state.kind = rules::TurnKind::decision;
  state.options = {rules::Decision::accept, rules::Decision::rerack_chooser_breaks};
  return turn(state);
}

GameDecision<Outgoing> decision(const PlayedBreak& played) {
  return {game,     2, Seat::second, rules::Decision::accept, {encode_state(played.ruling.next)},
          {1, 2, 3}};
}

GameTurnLost<Outgoing> turn_lost(const PlayedBreak& played) {
  const rules::Ruling ruling = rules::judge_lost_turn(
      played.before, rules::FoulCode::too_many_refusals, table(), materials());
  return {game, 1, Seat::first, {encode_ruling(ruling)}, {encode_state(ruling.next)}, {1, 2, {}}};
}

GameOver over() {
  return {game, match, Seat::first, rules::EndReason::eight_pocketed, true, hex('c')};
}

GameSnapshot<Outgoing> snapshot(const PlayedBreak& played) {
  return {terms(rules::RuleSet::eight_ball, "wpa9", "modern"),
          {encode_state(played.ruling.next)},
          {590'000, 600'000, 1'700'000'600'000}};
}

GameListing listing() {
  return {game, match, tournament, Seat::first, "opponent", GameStatus::running};
}

// The legal start of a lost or won game.
rules::GameState ended_state(const PlayedBreak& played) {
  return rules::ended(played.ruling.next, {Seat::second, rules::EndReason::timeout});
}

}  // namespace

PlayedBreak played_break(rules::RuleSet rule_set) {
  PlayedBreak played;
  rules::GameSettings settings;
  settings.rules = rule_set;
  settings.rack_seed = 7;
  played.before = rules::new_game(settings, table(), materials());
  played.cue_ball = {0.5, 0.4};
  played.params = {0.25, -1.5, 5, 89, 8};
  const auto ready =
      ready_shot(played.before, played.call, played.cue_ball, played.params, table(), materials())
          .value();
  auto [simulation, ruling] = play_shot(ready).value();
  played.events = std::move(simulation.events);
  played.ruling = std::move(ruling);
  return played;
}

std::vector<Request> sample_requests() {
  const ShotParams params{0.1, -0.0, 5, 1.0 / 3, 2.5};
  const rules::Call pocket{rules::Call::Kind::pocket, physics::BallId{3},
                           physics::PocketId::side_left};
  return {
      Hello{.name = "bot"},
      Hello{1, 3, "bot.2_x-", ClientInfo{"thing", "1.0"}, EventDetail::summary},
      Register{"bot", {}},
      Register{"bot", hex('1')},
      Login{hex('2')},
      TournamentList{},
      TournamentJoin{tournament},
      TournamentLeave{tournament},
      Challenge{"house:greedy", {}, {}, {}, {}},
      Challenge{"other", rules::RuleSet::nine_ball, "high", ClockSettings{1000, 20, 300},
                ShotId{"\"c\""}},
      ChallengeAccept{challenge},
      ChallengeDecline{challenge},
      Shot{game, 4, {"12"}, params, {}, pocket},
      Shot{game,
           4,
           {"\"\\u0001é\""},
           params,
           physics::Vec2<double>{0.5, 0.25},
           {rules::Call::Kind::safety, {}, {}}},
      Shot{game, 4, {"-1"}, params, {}, {rules::Call::Kind::push_out, {}, {}}},
      Shot{game, 4, {"0"}, params, {}, {}},
      Decide{game, 5, rules::Decision::spot_eight},
      Concede{game},
      Sync{game},
      Ack{game},
      Ack{match},
      Ack{tournament},
      Ping{},
      Ping{{"12.5"}},
      Lag{-3},
      GameReady{hex('3')},
      GameReveal{game, hex('4')},
  };
}

std::vector<SampleReply> sample_replies() {
  const PlayedBreak eight = played_break(rules::RuleSet::eight_ball);
  const PlayedBreak nine = played_break(rules::RuleSet::nine_ball);
  return {
      {Method::hello,
       HelloReply{1, {"poolhall", "0.1.0"}, "s-1", Limits{}, "8-ball/1", "poolhall/1", 123}},
      {Method::register_agent, LoginReply{"bot", hex('5'), {}}},
      {Method::login, LoginReply{"bot", {}, {listing()}}},
      {Method::tournament_list, TournamentListReply{{{tournament,
                                                      "Spring \"cup\"",
                                                      TournamentStatus::open,
                                                      rules::RuleSet::eight_ball,
                                                      "round_robin",
                                                      {"a", "b"}}}}},
      {Method::tournament_join, TournamentReply{tournament, Membership::joined}},
      {Method::tournament_leave, TournamentReply{tournament, Membership::left}},
      {Method::challenge, ChallengeReply{challenge, ChallengeStatus::offered, {}}},
      {Method::challenge_accept, ChallengeReply{challenge, ChallengeStatus::accepted, match}},
      {Method::challenge_decline, ChallengeReply{challenge, ChallengeStatus::declined, {}}},
      {Method::shot, ShotReply<Outgoing>{shot(eight, EventDetail::full), Repetition::duplicate}},
      {Method::shot, ShotReply<Outgoing>{shot(nine, EventDetail::summary), {}}},
      {Method::decide, DecideReply<Outgoing>{decision(eight), Repetition::first_time}},
      {Method::concede, GameReply{game}},
      {Method::sync, SyncReply<Outgoing>{snapshot(eight), turn(eight.ruling.next), {}}},
      {Method::sync, SyncReply<Outgoing>{snapshot(eight), {}, over()}},
      {Method::ack, AckReply{game}},
      {Method::ack, AckReply{match}},
      {Method::ack, AckReply{tournament}},
      {Method::ping, PingReply{{"\"x\""}, 5}},
      {Method::lag, EmptyReply{}},
      {Method::game_ready, EmptyReply{}},
      {Method::game_reveal, GameReply{game}},
  };
}

std::vector<Notification<Outgoing>> sample_notifications() {
  const PlayedBreak eight = played_break(rules::RuleSet::eight_ball);
  const PlayedBreak nine = played_break(rules::RuleSet::nine_ball);
  GameTerms<Outgoing> noisy = terms(rules::RuleSet::nine_ball, "bar7", "marlow");
  noisy.noise = noise_preset("olympiad");
  noisy.tournament = tournament;
  noisy.clock.shot_ms = 30'000;
  return {
      ChallengeOffer{challenge, "other", rules::RuleSet::eight_ball, "low", {}, 99},
      ChallengeOver{challenge, ChallengeOutcome::expired},
      GameStart<Outgoing>{noisy, {encode_state(nine.before)}},
      snapshot(eight),
      turn(eight.before),
      turn(nine.ruling.next),
      decision_turn(eight),
      shot(eight, EventDetail::full),
      shot(eight, EventDetail::summary),
      shot(nine, EventDetail::full),
      decision(nine),
      turn_lost(eight),
      GameSnapshot<Outgoing>{noisy, {encode_state(ended_state(eight))}, {1, 2, {}}},
      over(),
      GameOver{game, match, {}, rules::EndReason::void_game, false, hex('d')},
      MatchOver{match,
                tournament,
                "other",
                1.5,
                0.5,
                {{game, hex('e'), 12345, {hex('f'), std::nullopt}}}},
      TournamentOver{tournament, "Spring cup", {{1, "a", 2.5, 3, 2, 0, 1}}},
      Superseded{},
      LagProbe{77},
      ShuttingDown{"SIGTERM"},
  };
}

}  // namespace poolhall::test_support
