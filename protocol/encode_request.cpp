// An agent's lines: what clients send.
#include "protocol/codec.hpp"
#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

void write_game(JsonWriter& out, GameId game) {
  out.key("game").integer(number(game));
}

void write(JsonWriter& out, const Hello& hello) {
  out.key("protocol").begin_array().integer(hello.least_protocol);
  out.integer(hello.most_protocol).end_array().key("name").string(hello.name);
  if (hello.client) {
    out.key("client").begin_object().key("name").string(hello.client->name);
    out.key("version").string(hello.client->version).end_object();
  }
  out.key("detail").string(hello.detail == EventDetail::full ? "full" : "summary");
}

void write(JsonWriter& out, const Register& request) {
  out.key("name").string(request.name);
  if (request.token) {
    out.key("token").string(request.token->text);
  }
}

void write(JsonWriter& out, const Login& login) {
  out.key("token").string(login.token.text);
}

void write(JsonWriter&, const TournamentList&) {}

void write(JsonWriter& out, const TournamentJoin& join) {
  out.key("tournament").integer(number(join.tournament));
}

void write(JsonWriter& out, const TournamentLeave& leave) {
  out.key("tournament").integer(number(leave.tournament));
}

void write(JsonWriter& out, const Challenge& challenge) {
  out.key("opponent").string(challenge.opponent);
  if (challenge.rules) {
    out.key("rules").string(rules::name(*challenge.rules));
  }
  if (challenge.noise) {
    out.key("noise").string(*challenge.noise);
  }
  if (challenge.clock) {
    out.key("clock").begin_object().key("game_ms").integer(challenge.clock->game_ms);
    out.key("increment_ms").integer(challenge.clock->increment_ms);
    if (challenge.clock->shot_ms) {
      out.key("shot_ms").integer(*challenge.clock->shot_ms);
    }
    out.end_object();
  }
  if (challenge.challenge_id) {
    out.key("challenge_id").raw(challenge.challenge_id->json);
  }
}

void write(JsonWriter& out, const ChallengeAccept& accept) {
  out.key("challenge").integer(number(accept.challenge));
}

void write(JsonWriter& out, const ChallengeDecline& decline) {
  out.key("challenge").integer(number(decline.challenge));
}

void write(JsonWriter& out, const Shot& shot) {
  write_game(out, shot.game);
  out.key("turn").integer(shot.turn).key("shot_id").raw(shot.shot_id.json).key("params");
  write_shot_params(out, shot.params);
  if (shot.cue_ball) {
    out.key("cue_ball");
    write_point(out, *shot.cue_ball);
  }
  if (shot.call.kind != rules::Call::Kind::none) {
    out.key("call");
    write_call(out, shot.call);
  }
}

void write(JsonWriter& out, const Decide& decide) {
  write_game(out, decide.game);
  out.key("turn").integer(decide.turn).key("choice").string(rules::name(decide.choice));
}

void write(JsonWriter& out, const Concede& concede) {
  write_game(out, concede.game);
}
void write(JsonWriter& out, const Sync& sync) {
  write_game(out, sync.game);
}
void write(JsonWriter& out, const Ack& ack) {
  if (const auto* match = std::get_if<MatchId>(&ack.what)) {
    out.key("match").integer(number(*match));
  } else if (const auto* tournament = std::get_if<TournamentId>(&ack.what)) {
    out.key("tournament").integer(number(*tournament));
  } else {
    write_game(out, std::get<GameId>(ack.what));
  }
}
void write(JsonWriter& out, const Ping& ping) {
  out.key("t").raw(ping.t.text);
}
void write(JsonWriter& out, const Lag& lag) {
  out.key("t").integer(lag.t);
}

void write(JsonWriter& out, const GameReady& ready) {
  out.key("commitment").string(ready.commitment.text);
}

void write(JsonWriter& out, const GameReveal& reveal) {
  write_game(out, reveal.game);
  out.key("secret").string(reveal.secret.text);
}

// From "method" to the end of the line.
std::string finished(JsonWriter&& out, const Request& request) {
  out.key("method").string(name(method_of(request))).key("params").begin_object();
  std::visit([&](const auto& message) { write(out, message); }, request);
  out.end_object().end_object();
  std::string line = std::move(out).text();
  line += '\n';
  return line;
}

}  // namespace

std::string encode_request(std::int64_t id, const Request& request) {
  JsonWriter out;
  out.begin_object().key("jsonrpc").string("2.0").key("id").integer(id);
  return finished(std::move(out), request);
}

std::string encode_lag(const Lag& lag) {
  JsonWriter out;
  out.begin_object().key("jsonrpc").string("2.0");
  return finished(std::move(out), lag);
}

}  // namespace poolhall::protocol
