// Checks of lost connections and restarts of the server.
#include <string>

#include "clients/conformance/checks.hpp"

namespace poolhall::conformance {
namespace {

using protocol::ErrorCode;

constexpr std::string_view return_section = "A session";

HostedGame& in_a_game(Host& host) {
  host.arrive();
  return host.begin({});
}

// Back, told where the game stands, and on with it.
void comes_back_and_goes_on(Host& host, HostedGame& game) {
  host.expect_return();
  host.tell_again(game);
  if (game.is_bots_turn()) {
    host.finish(host.acceptable(game));
  }
  host.play_opponent(game);
  host.play_turn(game);
  host.demand(duties::one_content_per_key);
}

void lost_before_the_answer(Host& host, Cut cut) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  host.cut(cut);
  comes_back_and_goes_on(host, game);
}

void lost_with_the_answer(Host& host) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  static_cast<void>(host.answer_of(game));
  host.cut(Cut::close);
  comes_back_and_goes_on(host, game);
}

void lost_with_the_reply(Host& host, Cut cut) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  if (const auto accepted = host.acceptable(game)) {
    host.store(*accepted);
  }
  host.cut(cut);
  comes_back_and_goes_on(host, game);
}

// The shot was being stored when the connection broke: the new one hears of it as of a shot of
// somebody's.
void lost_while_storing(Host& host) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  const auto accepted = host.acceptable(game);
  if (!accepted) {
    throw Stop{Verdict::not_reached, "its shots were refused"};
  }
  host.cut(Cut::close);
  host.expect_return();
  host.push(game.snapshot());
  host.store(*accepted);
  std::visit([&](const auto& told) { host.push(told); }, accepted->played.told);
  host.play_opponent(game);
  host.play_turn(game);
}

void lost_within_a_line(Host& host) {
  HostedGame& game = in_a_game(host);
  const std::string line = host.encoded(game.turn());
  host.send_raw(line.substr(0, line.size() / 2));
  host.cut(Cut::close);
  comes_back_and_goes_on(host, game);
}

void lost_again_and_again(Host& host) {
  HostedGame& game = in_a_game(host);
  for (int time = 0; time < 2; ++time) {
    host.cut(Cut::close);
    host.expect_return();
    host.push(game.snapshot());
  }
  host.cut(Cut::reset);
  comes_back_and_goes_on(host, game);
}

void server_restarts(Host& host) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  host.push(
      protocol::ShuttingDown{"the server stops; games that are not over go on when it is back"});
  host.cut(Cut::close);
  host.stay_away(milliseconds{700});
  comes_back_and_goes_on(host, game);
}

void server_is_full(Host& host) {
  constexpr int too_often = 15;
  HostedGame& game = in_a_game(host);
  host.cut(Cut::close);
  const int times =
      host.turn_away({ErrorCode::server_full, "", "the server has as many connections as it may"},
                     milliseconds{700});
  comes_back_and_goes_on(host, game);
  if (times > too_often) {
    throw Stop{Verdict::warning, "it connected " + std::to_string(times) +
                                     " times in 0.7 s to a server that is full"};
  }
}

// The server has not noticed that the old connection is gone, and takes one login a second.
void login_is_put_off(Host& host) {
  HostedGame& game = in_a_game(host);
  host.refuse_next(protocol::Method::login, {ErrorCode::rate_limited, "",
                                             "this agent has logged in within the last 1000 ms"});
  host.cut(Cut::close);
  comes_back_and_goes_on(host, game);
}

void game_ends_meanwhile(Host& host) {
  HostedGame& game = in_a_game(host);
  host.hand_turn(game);
  host.cut(Cut::close);
  game.end({rules::other(game.plan().seat), rules::EndReason::timeout});
  host.expect_return();
  host.push(game.over());
  host.serve_for(milliseconds{200});
  if (!host.is_connected()) {
    throw Stop{Verdict::not_reached, "it plays one game and goes"};
  }
  HostedGame& next = host.begin({});
  host.play_turn(next);
}

}  // namespace

std::vector<Script> return_scripts() {
  return {
      {{"lost-before-answer", "the connection closes in a turn: it comes back and answers it",
        return_section},
       [](Host& host) { lost_before_the_answer(host, Cut::close); }},
      {{"reset-before-answer", "the connection is reset in a turn: it comes back and answers it",
        return_section},
       [](Host& host) { lost_before_the_answer(host, Cut::reset); }},
      {{"lost-answer", "the connection closes before the answer was stored: it is sent again",
        "Requests"},
       lost_with_the_answer},
      {{"lost-reply",
        "the connection closes after the answer was stored: no other shot under its "
        "shot_id, and the game goes on",
        "Requests"},
       [](Host& host) { lost_with_the_reply(host, Cut::close); }},
      {{"reset-after-answer", "the same with a reset", "Requests"},
       [](Host& host) { lost_with_the_reply(host, Cut::reset); }},
      {{"own-shot-told", "the own shot is told to a new connection, and the game goes on",
        "Notifications"},
       lost_while_storing},
      {{"half-a-line", "a line that broke off with its connection is forgotten", "Lines"},
       lost_within_a_line},
      {{"lost-three-times", "three lost connections in a row, and the game goes on",
        return_section},
       lost_again_and_again},
      {{"restart", "shutting_down, no server for a while, a new session: the game goes on",
        return_section},
       server_restarts},
      {{"server-full", "server_full is retryable: it comes back later", "Errors"}, server_is_full},
      {{"login-put-off", "a login that is refused for now is tried again", "Errors"},
       login_is_put_off},
      {{"end-while-away", "a game that ended while it was away is over, and the next is played",
        return_section},
       game_ends_meanwhile},
  };
}

}  // namespace poolhall::conformance
