// Checks of turns: refusals, turns that are over, failures of the server, the opponent, the clock.
#include <string>
#include <thread>
#include <utility>

#include "clients/conformance/checks.hpp"

namespace poolhall::conformance {
namespace {

using protocol::Error;
using protocol::ErrorCode;

constexpr std::string_view turn_section = "A turn";

// The bot's next turn in this game is answered.
void goes_on(Host& host, HostedGame& game) {
  host.play_opponent(game);
  host.play_turn(game);
}

Error refusal_of(const HostedGame& game) {
  if (game.state().kind == rules::TurnKind::decision) {
    return {ErrorCode::bad_decision, "/params/choice", "not now", game.id()};
  }
  return {ErrorCode::bad_shot, "/params/params", "the stick cannot get there", game.id()};
}

void answers_again(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  host.refuse_answer(host.answer_of(game), refusal_of(game));
  host.finish(host.acceptable(game));
  goes_on(host, game);
}

void leaves_a_lost_turn(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  const std::uint32_t turn = game.state().turn;
  host.hand_turn(game);
  while (game.state().turn == turn) {
    host.refuse_answer(host.answer_of(game), refusal_of(game));
  }
  const int before = host.past_answers();
  host.serve_for(milliseconds{300});
  if (host.past_answers() > before) {
    throw Stop{Verdict::failure, "it answers a turn again whose refusal had foul: true"};
  }
  goes_on(host, game);
}

// The time of the turn was over before the answer had come.
void leaves_a_stale_turn(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  const Answer late = host.answer_of(game);
  host.push(game.lose_turn(rules::FoulCode::shot_time_exceeded));
  host.refuse(late.id,
              {ErrorCode::stale_turn, "/params/turn", "got a turn that is over", game.id()});
  const int before = host.past_answers();
  host.serve_for(milliseconds{300});
  if (host.past_answers() > before + 1) {
    throw Stop{Verdict::failure, "it goes on answering a turn that is over"};
  }
  goes_on(host, game);
}

// The server cannot store for a while; it says so with an error that may be tried again.
void tries_again(Host& host, ErrorCode code) {
  constexpr milliseconds trouble{400};
  constexpr int too_often = 40;
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  const Instant begin = Clock::now();
  int refused = 0;
  while (refused == 0 || Clock::now() < begin + trouble) {
    // A bot that asks again at once must be seen to, and must not fill the run with its lines.
    Answer answer = host.answer_of(game);
    std::this_thread::sleep_for(milliseconds{5});
    host.put_off(answer, {code, "", "the turn could not be stored", game.id()});
    ++refused;
  }
  host.finish(host.acceptable(game));
  goes_on(host, game);
  if (refused > too_often) {
    throw Stop{Verdict::warning, "it asked " + std::to_string(refused) + " times in " +
                                     std::to_string(trouble.count()) + " ms"};
  }
}

// Requests beside the games are refused for their number.
void bears_rate_limits(Host& host) {
  const Error limited{ErrorCode::rate_limited, "", "more than 50 messages a second (burst 100)"};
  using protocol::Method;
  for (const Method method : {Method::game_ready, Method::game_reveal, Method::ack, Method::ping,
                              Method::sync, Method::tournament_list}) {
    host.refuse_next(method, limited);
  }
  host.arrive();
  HostedGame& game = host.begin({});
  host.play_turn(game);
  goes_on(host, game);
}

void bears_repeated_turns(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  host.push(game.snapshot());
  host.hand_turn(game);
  const auto accepted = host.acceptable(game);
  host.hand_turn(game);
  host.push(game.snapshot());
  host.serve_for(milliseconds{100});
  host.finish(accepted);
  host.serve_for(milliseconds{100});
  goes_on(host, game);
  host.demand(duties::one_content_per_key);
}

void follows_the_opponents_shot(Host& host) {
  host.arrive();
  GamePlan plan;
  plan.seat = rules::Seat::second;
  HostedGame& game = host.begin(std::move(plan));
  host.play_opponent(game);
  host.serve_for(milliseconds{200});  // the turn is not handed out yet
  host.play_turn(game);
}

void follows_the_opponents_decision(Host& host) {
  GamePlan plan;
  HostedGame fresh({}, protocol::EventDetail::summary);
  rules::GameState state = fresh.state();
  state.turn = 2;
  state.kind = rules::TurnKind::decision;
  state.to_move = rules::Seat::second;
  state.options = {rules::Decision::accept, rules::Decision::accept_ball_in_hand};
  plan.position = state;
  host.arrive();
  HostedGame& game = host.begin(std::move(plan));
  goes_on(host, game);
}

void follows_the_opponents_lost_turn(Host& host) {
  host.arrive();
  GamePlan plan;
  plan.seat = rules::Seat::second;
  HostedGame& game = host.begin(std::move(plan));
  host.push(game.lose_turn(rules::FoulCode::shot_time_exceeded));
  goes_on(host, game);
}

void bears_offers(Host& host) {
  host.arrive();
  const protocol::ChallengeId challenge{909};
  host.push(protocol::ChallengeOffer{
      challenge, "somebody", rules::RuleSet::eight_ball, "low", {}, time_ms() + 60'000});
  host.serve_for(milliseconds{100});
  host.push(protocol::ChallengeOver{challenge, protocol::ChallengeOutcome::expired});
  HostedGame& game = host.begin({});
  host.play_turn(game);
}

void answers_in_time(Host& host) {
  host.arrive();
  GamePlan plan;
  plan.left = host.options().clock / 4;
  HostedGame& game = host.begin(std::move(plan));
  host.play_turn(game);
}

void bears_a_long_wait(Host& host) {
  host.arrive();
  GamePlan plan;
  plan.seat = rules::Seat::second;
  HostedGame& game = host.begin(std::move(plan));
  host.serve_for(milliseconds{1'200});
  goes_on(host, game);
}

void bears_probes(Host& host) {
  constexpr int probes = 30;
  host.arrive();
  HostedGame& game = host.begin({});
  host.hand_turn(game);
  for (int probe = 0; probe < probes; ++probe) {
    host.probe(4'000'000'000'000 + probe);
  }
  host.finish(host.acceptable(game));
  goes_on(host, game);
}

// The commitment that the terms show is not the bot's latest: it was lost with a connection.
void keeps_its_secret(Host& host) {
  host.arrive();
  host.serve_for(milliseconds{100});
  if (host.times_asked(protocol::Method::game_ready) == 0) {
    throw Stop{Verdict::not_reached, "it adds nothing to the noise"};
  }
  GamePlan plan;
  plan.own_commitment = protocol::Hex256{std::string(64, 'd')};
  HostedGame& game = host.begin(std::move(plan));
  host.play_turn(game);
}

}  // namespace

std::vector<Script> turn_scripts() {
  return {
      {{"refusal", "after a refusal the turn goes on and is answered again", turn_section},
       answers_again},
      {{"foul-refusal", "after a refusal with foul: true the turn is over, and the next is played",
        turn_section},
       leaves_a_lost_turn},
      {{"stale-turn", "after stale_turn the turn is over, and the next is played", "Errors"},
       leaves_a_stale_turn},
      {{"retry-internal", "an answer that got internal, which is retryable, is sent again",
        "Errors"},
       [](Host& host) { tries_again(host, ErrorCode::internal); }},
      {{"retry-paused", "an answer that got paused, which is retryable, is sent again", "Errors"},
       [](Host& host) { tries_again(host, ErrorCode::paused); }},
      {{"rate-limited", "rate_limited for anything else does not keep it from its turns", "Errors"},
       bears_rate_limits},
      {{"repeated-turn", "game.turn and game.state that come again are the same turn",
        turn_section},
       bears_repeated_turns},
      {{"opponent-shot", "the opponent's shot, and the turn after it", "Notifications"},
       follows_the_opponents_shot},
      {{"opponent-decision", "the opponent's decision, and the turn after it", "Notifications"},
       follows_the_opponents_decision},
      {{"opponent-turn-lost", "the opponent's lost turn, and the turn after it", "Notifications"},
       follows_the_opponents_lost_turn},
      {{"challenge-offer", "an offer may be accepted, declined or ignored; games go on",
        "Notifications"},
       bears_offers},
      {{"short-clock", "an answer before the own clock is at zero", turn_section}, answers_in_time},
      {{"long-wait", "the connection is kept while the opponent thinks", turn_section},
       bears_a_long_wait},
      {{"lag-probes", "probes in the midst of a turn do not disturb it", turn_section},
       bears_probes},
      {{"lost-commitment", "nothing is revealed under a commitment that is not its own",
        "Fair noise"},
       keeps_its_secret},
  };
}

}  // namespace poolhall::conformance
