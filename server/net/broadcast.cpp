#include "server/net/broadcast.hpp"

#include <memory>
#include <utility>

#include "protocol/json_writer.hpp"
#include "server/net/figures.hpp"
#include "server/web/pages.hpp"

namespace poolhall::net {

using protocol::JsonWriter;
using std::chrono::steady_clock;

namespace {

// Lobbies change with every game; nobody reads faster than this.
constexpr std::chrono::milliseconds lobby_pause{500};

web::Message message(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

void write_clock(JsonWriter& out, const match::Game& game) {
  const match::Instant now = match::rounded_up(steady_clock::now());
  out.key("clock").begin_object().key("left_ms").begin_array();
  for (const Seat seat : {Seat::first, Seat::second}) {
    out.integer(game.clock().left(seat, now).count() / 1000);
  }
  out.end_array().key("running");
  if (game.clock().running()) {
    out.integer(rules::index(game.state().to_move));
  } else {
    out.null();
  }
  out.end_object();
}

}  // namespace

Broadcast::Broadcast(boost::asio::io_context& io, Arena& arena, web::LiveFeed& feed)
    : arena_(arena), feed_(feed), lobby_timer_(io) {
  arena_.on_turn(
      [this](const LiveGame& game, const storage::TurnRecord& turn) { turn_stored(game, turn); });
  arena_.on_games_changed([this] { games_changed(); });
}

Broadcast::~Broadcast() {
  arena_.on_turn({});
  arena_.on_games_changed({});
}

void Broadcast::watch(web::Topic topic, web::Ticket ticket) {
  watched_.insert(topic);
  feed_.snapshot(
      topic, ticket,
      message(topic == web::Topic::lobby ? lobby_text() : snapshot_text(web::number(topic))));
}

void Broadcast::unwatch(web::Topic topic) {
  watched_.erase(topic);
}

void Broadcast::turn_stored(const LiveGame& game, const storage::TurnRecord& turn) {
  const web::Topic topic = web::game_topic(protocol::number(turn.game));
  if (!watched_.contains(topic)) {
    return;
  }
  JsonWriter out;
  out.begin_object().key("type").string("turn");
  out.key("game").integer(protocol::number(turn.game));
  out.key("time_ms").integer(arena_.time().ms(steady_clock::now()));
  out.key("over").boolean(game.game().phase() == match::Phase::over);
  write_clock(out, game.game());
  out.key("turn").raw(web::turn_text(turn)).end_object();
  feed_.publish(topic, message(std::move(out).text()));
}

// The first change is told at once, those that follow together.
void Broadcast::games_changed() {
  if (!watched_.contains(web::Topic::lobby) || std::exchange(lobby_due_, true)) {
    return;
  }
  tell_lobby();
  lobby_timer_.expires_after(lobby_pause);
  lobby_timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) {
      return;
    }
    lobby_due_ = false;
    if (watched_.contains(web::Topic::lobby)) {
      tell_lobby();
    }
  });
}

void Broadcast::tell_lobby() {
  feed_.publish(web::Topic::lobby, message(lobby_text()));
}

std::string Broadcast::lobby_text() const {
  JsonWriter out;
  out.begin_object().key("type").string("lobby");
  out.key("time_ms").integer(arena_.time().ms(steady_clock::now()));
  out.key("games_over").integer(arena_.figures().games_over);
  out.key("live").raw(live_json(arena_, States::left_out)).end_object();
  return std::move(out).text();
}

std::string Broadcast::snapshot_text(std::int64_t id) const {
  JsonWriter out;
  out.begin_object().key("type").string("snapshot").key("game").integer(id);
  out.key("time_ms").integer(arena_.time().ms(steady_clock::now()));
  const LiveGame* live = arena_.find_game(protocol::GameId{id});
  out.key("live").boolean(live != nullptr);
  if (live != nullptr) {
    const match::Game& game = live->game();
    out.key("agents").begin_array();
    out.string(live->card().names[0]).string(live->card().names[1]).end_array();
    write_clock(out, game);
    out.key("state").raw(game.state_json()).key("last");
    if (game.last_turn()) {
      out.raw(web::turn_text(*game.last_turn()));
    } else {
      out.null();
    }
  }
  out.end_object();
  return std::move(out).text();
}

}  // namespace poolhall::net
