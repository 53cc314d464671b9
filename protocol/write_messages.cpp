// What the server sends, member by member, in the order of README.md.
#include <chrono>

#include "protocol/json_messages.hpp"
#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

template <class Id>
void write_id(JsonWriter& out, std::string_view key, Id id) {
  out.key(key).integer(number(id));
}

template <class Id>
void write_id(JsonWriter& out, std::string_view key, const std::optional<Id>& id) {
  out.key(key);
  if (id) {
    out.integer(number(*id));
  } else {
    out.null();
  }
}

void write_hex_pair(JsonWriter& out, const std::array<std::optional<Hex256>, 2>& pair) {
  out.begin_array();
  for (const std::optional<Hex256>& hex : pair) {
    if (hex) {
      out.string(hex->text);
    } else {
      out.null();
    }
  }
  out.end_array();
}

void write_clock_settings(JsonWriter& out, const ClockSettings& clock) {
  out.begin_object().key("game_ms").integer(clock.game_ms);
  out.key("increment_ms").integer(clock.increment_ms);
  out.key("shot_ms").integer_or_null(clock.shot_ms);
  out.end_object();
}

void write_clock(JsonWriter& out, std::string_view key, const ClockReading& clock) {
  out.key(key).begin_object().key("own_ms").integer(clock.own_ms);
  out.key("opponent_ms").integer(clock.opponent_ms);
  out.key("deadline_ms").integer_or_null(clock.deadline_ms);
  out.end_object();
}

void write_terms(JsonWriter& out, const GameTerms<Outgoing>& terms) {
  write_id(out, "game", terms.game);
  write_id(out, "match", terms.match);
  write_id(out, "tournament", terms.tournament);
  out.key("seat");
  write_seat(out, terms.seat);
  out.key("opponent").string(terms.opponent).key("rules").string(rules::name(terms.rules));
  out.key("table").raw(terms.table.text).key("physics").raw(terms.physics.text).key("noise");
  if (terms.noise) {
    write_noise(out, *terms.noise);
  } else {
    out.string("hidden");
  }
  out.key("clock");
  write_clock_settings(out, terms.clock);
  out.key("max_refusals").integer(terms.max_refusals);
  out.key("commitment").string(terms.commitment.text).key("agent_commitments");
  write_hex_pair(out, terms.agent_commitments);
}

void write_legal(JsonWriter& out, const LegalDecisions& legal) {
  out.begin_object().key("decisions");
  write_decisions(out, legal.decisions);
  out.end_object();
}

void write_legal(JsonWriter& out, const LegalBalls& legal) {
  out.begin_object().key("balls");
  write_ball_ids(out, legal.balls);
  out.key("first_balls");
  write_ball_ids(out, legal.first_balls);
  out.key("calls").begin_array();
  for (const rules::Call::Kind kind : legal.calls) {
    out.string(name(kind));
  }
  out.end_array().end_object();
}

// Whose move what is.
template <class Message>
void write_move(JsonWriter& out, const Message& message) {
  write_id(out, "game", message.game);
  out.key("turn").integer(message.turn).key("by");
  write_seat(out, message.by);
}

// ---- Notifications ----

void write(JsonWriter& out, const ChallengeOffer& offer) {
  write_id(out, "challenge", offer.challenge);
  out.key("from").string(offer.from).key("rules").string(rules::name(offer.rules));
  out.key("noise").string(offer.noise).key("clock");
  write_clock_settings(out, offer.clock);
  out.key("expires_ms").integer(offer.expires_ms);
}

void write(JsonWriter& out, const ChallengeOver& over) {
  write_id(out, "challenge", over.challenge);
  out.key("outcome").string(name(over.outcome));
}

void write(JsonWriter& out, const GameStart<Outgoing>& start) {
  write_terms(out, start.terms);
  out.key("state").raw(start.state.text);
}

void write(JsonWriter& out, const GameSnapshot<Outgoing>& snapshot) {
  write_terms(out, snapshot.terms);
  out.key("state").raw(snapshot.state.text);
  write_clock(out, "clocks", snapshot.clocks);
}

void write(JsonWriter& out, const GameTurn<Outgoing>& turn) {
  write_id(out, "game", turn.game);
  out.key("turn").integer(turn.turn).key("kind").string(rules::name(turn.kind));
  out.key("state").raw(turn.state.text);
  write_clock(out, "clock", turn.clock);
  out.key("legal");
  std::visit([&](const auto& legal) { write_legal(out, legal); }, turn.legal);
  out.key("refusals").integer(turn.refusals);
}

void write(JsonWriter& out, const GameShot<Outgoing>& shot) {
  write_move(out, shot);
  out.key("shot_id").raw(shot.shot_id.json).key("call");
  write_call(out, shot.call);
  out.key("cue_ball");
  if (shot.cue_ball) {
    write_point(out, *shot.cue_ball);
  } else {
    out.null();
  }
  out.key("intended");
  write_shot_params(out, shot.intended);
  out.key("executed");
  write_shot_params(out, shot.executed);
  out.key("moved").boolean(shot.moved);
  out.key("ruling").raw(shot.ruling.text).key("events").raw(shot.events.text);
  out.key("state").raw(shot.state.text);
  write_clock(out, "clock", shot.clock);
}

void write(JsonWriter& out, const GameDecision<Outgoing>& decision) {
  write_move(out, decision);
  out.key("choice").string(rules::name(decision.choice));
  out.key("state").raw(decision.state.text);
  write_clock(out, "clock", decision.clock);
}

void write(JsonWriter& out, const GameTurnLost<Outgoing>& lost) {
  write_move(out, lost);
  out.key("ruling").raw(lost.ruling.text).key("state").raw(lost.state.text);
  write_clock(out, "clock", lost.clock);
}

void write(JsonWriter& out, const GameOver& over) {
  write_id(out, "game", over.game);
  write_id(out, "match", over.match);
  out.key("winner");
  write_seat(out, over.winner);
  out.key("reason").string(rules::name(over.reason)).key("scored").boolean(over.scored);
  out.key("checksum").string(over.checksum.text);
}

void write(JsonWriter& out, const MatchOver& over) {
  write_id(out, "match", over.match);
  write_id(out, "tournament", over.tournament);
  out.key("opponent").string(over.opponent).key("own_points").number(over.own_points);
  out.key("opponent_points").number(over.opponent_points).key("seeds").begin_array();
  for (const GameSeeds& seeds : over.seeds) {
    out.begin_object();
    write_id(out, "game", seeds.game);
    out.key("key").string(seeds.key.text).key("rack_seed").integer(seeds.rack_seed);
    out.key("agent_secrets");
    write_hex_pair(out, seeds.agent_secrets);
    out.end_object();
  }
  out.end_array();
}

void write(JsonWriter& out, const TournamentOver& over) {
  write_id(out, "tournament", over.tournament);
  out.key("name").string(over.name).key("standings").begin_array();
  for (const StandingRow& row : over.standings) {
    out.begin_object().key("rank").integer(row.rank).key("agent").string(row.agent);
    out.key("points").number(row.points).key("games").integer(row.games);
    out.key("wins").integer(row.wins).key("losses").integer(row.losses);
    out.key("draws").integer(row.draws).end_object();
  }
  out.end_array();
}

void write(JsonWriter&, const Superseded&) {}

void write(JsonWriter& out, const LagProbe& probe) {
  out.key("t").integer(probe.t);
}

void write(JsonWriter& out, const ShuttingDown& notice) {
  out.key("reason").string(notice.reason);
}

// ---- Replies ----

void write(JsonWriter&, const EmptyReply&) {}

void write_limits(JsonWriter& out, const Limits& limits) {
  using std::chrono::duration_cast;
  using std::chrono::milliseconds;
  out.begin_object().key("line_bytes").integer(limits.line_bytes);
  out.key("line_bytes_before_login").integer(limits.line_bytes_before_login);
  out.key("server_line_bytes").integer(limits.server_line_bytes);
  out.key("nesting").integer(limits.nesting).key("keys").integer(limits.keys);
  out.key("login_ms").integer(limits.login_deadline.count());
  out.key("line_ms").integer(limits.line_deadline.count());
  out.key("messages_per_second").number(limits.messages_per_second);
  out.key("message_burst").number(limits.message_burst);
  out.key("bad_lines_in_a_row").integer(limits.bad_lines_in_a_row);
  out.key("connections_per_address").integer(limits.connections_per_address);
  out.key("output_queue_bytes").integer(limits.output_queue_bytes);
  out.key("name_length").integer(limits.name_length);
  out.key("shot_id_length").integer(limits.shot_id_length);
  out.key("max_refusals").integer(limits.max_refusals);
  out.key("challenge_expiry_ms").integer(limits.challenge_expiry.count());
  out.key("reveal_ms").integer(limits.reveal_deadline.count());
  out.key("lag_credit_per_turn_ms");
  out.integer(duration_cast<milliseconds>(limits.lag_credit_per_turn).count());
  out.key("lag_credit_per_game_ms");
  out.integer(duration_cast<milliseconds>(limits.lag_credit_per_game).count());
  out.end_object();
}

void write(JsonWriter& out, const HelloReply& reply) {
  out.key("protocol").integer(reply.protocol).key("server").begin_object();
  out.key("name").string(reply.server.name).key("version").string(reply.server.version);
  out.end_object().key("session").string(reply.session).key("limits");
  write_limits(out, reply.limits);
  out.key("rules_version").string(reply.rules_version);
  out.key("physics_version").string(reply.physics_version);
  out.key("time_ms").integer(reply.time_ms);
}

void write(JsonWriter& out, const LoginReply& reply) {
  out.key("agent").string(reply.agent);
  if (reply.token) {
    out.key("token").string(reply.token->text);
  }
  out.key("games").begin_array();
  for (const GameListing& game : reply.games) {
    out.begin_object();
    write_id(out, "game", game.game);
    write_id(out, "match", game.match);
    write_id(out, "tournament", game.tournament);
    out.key("seat");
    write_seat(out, game.seat);
    out.key("opponent").string(game.opponent).key("status").string(name(game.status));
    out.end_object();
  }
  out.end_array();
}

void write(JsonWriter& out, const TournamentListReply& reply) {
  out.key("tournaments").begin_array();
  for (const TournamentListing& listing : reply.tournaments) {
    out.begin_object();
    write_id(out, "tournament", listing.tournament);
    out.key("name").string(listing.name).key("status").string(name(listing.status));
    out.key("rules").string(rules::name(listing.rules)).key("format").string(listing.format);
    out.key("agents").begin_array();
    for (const std::string& agent : listing.agents) {
      out.string(agent);
    }
    out.end_array().end_object();
  }
  out.end_array();
}

void write(JsonWriter& out, const TournamentReply& reply) {
  write_id(out, "tournament", reply.tournament);
  out.key("membership").string(name(reply.membership));
}

void write(JsonWriter& out, const ChallengeReply& reply) {
  write_id(out, "challenge", reply.challenge);
  out.key("status").string(name(reply.status));
  write_id(out, "match", reply.match);
}

void write(JsonWriter& out, const ShotReply<Outgoing>& reply) {
  write(out, reply.shot);
  out.key("duplicate").boolean(reply.repetition == Repetition::duplicate);
}

void write(JsonWriter& out, const DecideReply<Outgoing>& reply) {
  write(out, reply.decision);
  out.key("duplicate").boolean(reply.repetition == Repetition::duplicate);
}

void write(JsonWriter& out, const GameReply& reply) {
  write_id(out, "game", reply.game);
}

void write(JsonWriter& out, const AckReply& reply) {
  if (const auto* match = std::get_if<MatchId>(&reply.what)) {
    write_id(out, "match", *match);
  } else if (const auto* tournament = std::get_if<TournamentId>(&reply.what)) {
    write_id(out, "tournament", *tournament);
  } else {
    write_id(out, "game", std::get<GameId>(reply.what));
  }
}

template <class Part>
void write_optional_part(JsonWriter& out, std::string_view key, const std::optional<Part>& part) {
  out.key(key);
  if (part) {
    out.begin_object();
    write(out, *part);
    out.end_object();
  } else {
    out.null();
  }
}

void write(JsonWriter& out, const SyncReply<Outgoing>& reply) {
  write(out, reply.snapshot);
  write_optional_part(out, "pending", reply.pending);
  write_optional_part(out, "over", reply.over);
}

void write(JsonWriter& out, const PingReply& reply) {
  out.key("t").raw(reply.t.text).key("time_ms").integer(reply.time_ms);
}

}  // namespace

void write_members(JsonWriter& out, const Notification<Outgoing>& notification) {
  std::visit([&](const auto& message) { write(out, message); }, notification);
}

void write_members(JsonWriter& out, const Reply<Outgoing>& reply) {
  std::visit([&](const auto& message) { write(out, message); }, reply);
}

}  // namespace poolhall::protocol
