// Checks of a session as a whole: login, games that end, several games, takeover, a server that
// does not want the bot.
#include <utility>

#include "clients/conformance/checks.hpp"

namespace poolhall::conformance {
namespace {

constexpr std::string_view session_section = "A session";

void logs_in(Host& host) {
  host.arrive(Verdict::failure);
}

// A whole rack would take too long; so many turns of both show the way of a game.
void plays(Host& host, rules::RuleSet rules) {
  constexpr int turns = 8;
  host.arrive();
  GamePlan plan;
  plan.rules = rules;
  HostedGame& game = host.begin(std::move(plan));
  for (int turn = 0; turn < turns && !game.state().result; ++turn) {
    if (game.is_bots_turn()) {
      host.play_turn(game);
    } else {
      host.play_opponent(game);
    }
  }
}

void ends_game(Host& host, HostedGame& game) {
  game.end({game.plan().seat, rules::EndReason::conceded});
  host.push(game.over());
}

// Bots that play one game and go have nothing to show here.
void needs_another_game(Host& host) {
  host.serve_for(milliseconds{300});
  if (!host.is_connected()) {
    throw Stop{Verdict::not_reached, "it plays one game and goes"};
  }
}

void plays_on_after_an_end(Host& host) {
  host.arrive();
  HostedGame& first = host.begin({});
  host.play_turn(first);
  ends_game(host, first);
  needs_another_game(host);
  HostedGame& second = host.begin({});
  host.play_turn(second);
}

void takes_repeated_ends(Host& host) {
  host.arrive();
  HostedGame& first = host.begin({});
  host.play_turn(first);
  ends_game(host, first);
  needs_another_game(host);
  host.cut(Cut::close);
  host.expect_return();
  host.push(first.over());
  host.push(protocol::MatchOver{first.plan().match,
                                {},
                                first.plan().opponent,
                                1,
                                0,
                                {{first.id(), {std::string(64, 'e')}, 20261130, {}}}});
  host.push(protocol::TournamentOver{
      protocol::TournamentId{77}, "cup", {{1, "under-test", 1, 1, 1, 0, 0}}});
  host.push(first.over());
  HostedGame& second = host.begin({});
  host.play_turn(second);
}

// The opponent gives up while the bot thinks: its answer, if it comes, is too late.
void takes_an_end_in_its_turn(Host& host) {
  host.arrive();
  HostedGame& first = host.begin({});
  host.hold();
  host.hand_turn(first);
  ends_game(host, first);
  host.flush();
  needs_another_game(host);
  HostedGame& second = host.begin({});
  host.play_turn(second);
}

void plays_two_games(Host& host) {
  host.arrive();
  HostedGame& first = host.begin({});
  HostedGame& second = host.begin({});
  host.hold();
  host.hand_turn(first);
  host.hand_turn(second);
  host.flush();
  const auto is_due = [](const HostedGame& game) { return game.state().turn == 1; };
  while (is_due(first) || is_due(second)) {
    host.finish(host.acceptable(host.any_answer()));
  }
}

void obeys_superseded(Host& host) {
  host.arrive();
  HostedGame& game = host.begin({});
  host.play_turn(game);
  host.push(protocol::Superseded{});
  host.cut(Cut::close);
  if (host.comes_back_within(host.options().patience / 4)) {
    throw Stop{Verdict::failure, "it connects again after superseded"};
  }
}

}  // namespace

std::vector<Script> session_scripts() {
  return {
      {{"login", "it connects, says hello and logs in or registers", session_section}, logs_in},
      {{"plays-8-ball", "an answer to every turn of an 8-ball game", session_section},
       [](Host& host) { plays(host, rules::RuleSet::eight_ball); }},
      {{"plays-9-ball", "an answer to every turn of a nine-ball game", session_section},
       [](Host& host) { plays(host, rules::RuleSet::nine_ball); }},
      {{"two-games", "two games at a time: an answer in each, under its own game and turn",
        session_section},
       plays_two_games},
      {{"next-game", "after game.over the next game is played", session_section},
       plays_on_after_an_end},
      {{"repeated-ends",
        "game.over, match.over and tournament.over that are told again change "
        "nothing",
        session_section},
       takes_repeated_ends},
      {{"end-in-own-turn", "a game that ends in the bot's turn is over, and the next is played",
        "Notifications"},
       takes_an_end_in_its_turn},
      {{"superseded", "no new connection after superseded", session_section}, obeys_superseded},
  };
}

}  // namespace poolhall::conformance
