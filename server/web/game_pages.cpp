// Pages of games and turns.
#include <array>
#include <optional>

#include "protocol/state_json.hpp"
#include "protocol/table_json.hpp"
#include "server/match/chain.hpp"
#include "server/match/play_shot.hpp"
#include "server/match/secrets.hpp"
#include "server/web/page_parts.hpp"
#include "server/web/pages.hpp"

namespace poolhall::web {

namespace {

// What the web's reader may be told of a match's noise.
storage::Expected<match::Secrets> secrets_of(Reader& reader,
                                             const std::optional<storage::MatchRecord>& match,
                                             const Horizon& horizon) {
  if (!match || !match->finished || !horizon.sees(*match->finished)) {
    return match::Secrets::kept;
  }
  return match::secrets_of(reader, *match);
}

void write_noise(JsonWriter& out, const storage::GameRecord& game, match::Secrets secrets) {
  out.key("noise");
  if (!match::tells_level(game.terms, secrets)) {
    out.string("hidden");
    return;
  }
  out.begin_object();
  out.key("a").number(game.noise.a).key("b").number(game.noise.b);
  out.key("theta").number(game.noise.theta).key("phi").number(game.noise.phi);
  out.key("v").number(game.noise.v).end_object();
}

// With all the numbers that it takes to draw the game.
void write_board(JsonWriter& out, const storage::TermsRecord& terms) {
  const auto board = match::preset_board(terms.table, terms.materials);
  out.key("board");
  if (!board) {
    out.null();
    return;
  }
  out.begin_object().key("table").raw(protocol::encode_table(board->table));
  out.key("physics").raw(protocol::encode_materials(board->materials)).end_object();
}

void write_game(JsonWriter& out, const storage::GameRecord& game, const Names& names) {
  out.key("game").integer(protocol::number(game.id));
  out.key("match").integer(protocol::number(game.match));
  out.key("number").integer(game.number);
  write_agents(out, game.agents, names);
  out.key("rules").string(rules::name(game.terms.rules));
  out.key("table").string(game.terms.table);
  out.key("physics").string(game.terms.materials);
  out.key("clock_ms").integer(game.terms.clock.count() / 1000);
  out.key("breaker").integer(rules::index(game.breaker));
  write_board(out, game.terms);
  out.key("commitment").string(match::to_hex(game.commitment));
  out.key("physics_version").string(game.physics_version);
  out.key("rules_version").string(game.rules_version);
  write_result(out, game);
}

void write_params(JsonWriter& out, std::string_view key, const protocol::ShotParams& params) {
  out.key(key).begin_object();
  out.key("a").number(params.a).key("b").number(params.b);
  out.key("theta").number(params.theta).key("phi").number(params.phi);
  out.key("v").number(params.v).end_object();
}

void write_shot(JsonWriter& out, const storage::ShotPart& shot) {
  write_params(out, "intended", shot.intended);
  write_params(out, "executed", shot.executed);
  out.key("moved").boolean(shot.moved);
  out.key("call").raw(protocol::encode_call(shot.call));
  out.key("cue_ball");
  if (shot.cue_ball) {
    out.begin_object().key("x").number(shot.cue_ball->x).key("y").number(shot.cue_ball->y);
    out.end_object();
  } else {
    out.null();
  }
}

void write_turn(JsonWriter& out, const storage::TurnRecord& turn) {
  out.key("turn").integer(turn.number);
  out.key("by").integer(rules::index(turn.seat));
  out.key("action").string(storage::name(turn.action));
  out.key("stored_ms").integer(unix_ms(turn.stored));
  out.key("used_ms").number(static_cast<double>(turn.clock.used.count()) / 1e3);
  out.key("left_ms").begin_array();
  for (const storage::Micros left : turn.clock.left) {
    out.integer(left.count() / 1000);
  }
  out.end_array();
  if (turn.shot) {
    write_shot(out, *turn.shot);
  }
  if (turn.decision) {
    out.key("choice").string(rules::name(*turn.decision));
  }
  out.key("ruling").raw(turn.ruling.value_or("null"));
}

// Games won in the match, by the seats of this game.
storage::Expected<void> write_score(JsonWriter& out, Reader& reader,
                                    const storage::GameRecord& game, const Horizon& horizon) {
  const auto games = reader.games_of(game.match);
  if (!games) {
    return tl::unexpected(games.error());
  }
  std::array<int, 2> won{};
  for (const storage::GameRecord& record : *games) {
    const storage::GameRecord other = horizon.seen(record);
    if (other.over && other.result && other.result->winner) {
      const storage::AgentId winner = other.agents[rules::index(*other.result->winner)];
      ++won[winner == game.agents[0] ? 0 : 1];
    }
  }
  out.key("match_score").begin_array().integer(won[0]).integer(won[1]).end_array();
  return {};
}

// The game's noise, its key once the match is over, and the match's tournament.
storage::Expected<void> write_match(JsonWriter& out, Reader& reader,
                                    const storage::GameRecord& game, const Horizon& horizon) {
  const auto match = reader.match(game.match);
  if (!match) {
    return tl::unexpected(match.error());
  }
  out.key("tournament");
  if (*match && (*match)->tournament) {
    out.string(*(*match)->tournament);
  } else {
    out.null();
  }
  const auto secrets = secrets_of(reader, *match, horizon);
  if (!secrets) {
    return tl::unexpected(secrets.error());
  }
  write_noise(out, game, *secrets);
  if (match::tells_keys(*secrets)) {
    out.key("key").string(match::to_hex(game.key));
    out.key("rack_seed").integer(game.rack_seed);
  }
  return write_score(out, reader, game, horizon);
}

}  // namespace

std::string turn_text(const storage::TurnRecord& turn) {
  JsonWriter out;
  out.begin_object().key("game").integer(protocol::number(turn.game));
  write_turn(out, turn);
  out.key("state_before").raw(turn.state_before);
  out.key("events").raw(turn.shot ? turn.shot->events : "[]");
  out.key("state_after").raw(turn.state_after);
  out.key("checksum").string(match::to_hex(turn.checksum)).end_object();
  return std::move(out).text();
}

Page game_page(Reader& reader, std::int64_t id, const Horizon& horizon) {
  const auto record = reader.game(protocol::GameId{id});
  const auto names = names_of(reader);
  if (!record || !names) {
    return unreadable(record ? names.error() : record.error());
  }
  if (!*record) {
    return not_found("there is no such game");
  }
  const storage::GameRecord game = horizon.seen(**record);
  JsonWriter out;
  out.begin_object();
  write_game(out, game, *names);
  if (const auto written = write_match(out, reader, game, horizon); !written) {
    return unreadable(written.error());
  }
  out.key("initial_state").raw(game.initial_state).key("turns").begin_array();
  const auto read = reader.each_turn(game.id, [&](const storage::TurnRecord& turn) {
    if (!horizon.sees(turn.stored)) {
      return false;
    }
    out.begin_object();
    write_turn(out, turn);
    out.end_object();
    return true;
  });
  if (!read) {
    return unreadable(read.error());
  }
  out.end_array().end_object();
  return page_of(out);
}

Page shot_page(Reader& reader, std::int64_t id, std::int64_t number, const Horizon& horizon) {
  if (number > 0xffff'ffffLL) {
    return not_found("there is no such turn");
  }
  const auto turn = reader.turn(protocol::GameId{id}, static_cast<std::uint32_t>(number));
  if (!turn) {
    return unreadable(turn.error());
  }
  if (!*turn || !horizon.sees((*turn)->stored)) {
    return not_found("there is no such turn");
  }
  return {200, "application/json", turn_text(**turn)};
}

}  // namespace poolhall::web
