// What the page's spectators are told of games: built once a turn and only where somebody watches,
// then handed to the web thread. The network thread's own.
//
//   Broadcast broadcast{io, arena, http.feed()};
//   broadcast.watch(web::game_topic(17), ticket);   // a snapshot, and from then on every turn
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <set>

#include "server/net/arena.hpp"
#include "server/web/live_feed.hpp"

namespace poolhall::net {

class Broadcast {
 public:
  Broadcast(boost::asio::io_context& io, Arena& arena, web::LiveFeed& feed);
  ~Broadcast();
  Broadcast(const Broadcast&) = delete;
  Broadcast& operator=(const Broadcast&) = delete;

  void watch(web::Topic topic, web::Ticket ticket);
  void unwatch(web::Topic topic);

 private:
  void turn_stored(const LiveGame& game, const storage::TurnRecord& turn);
  void games_changed();
  void tell_lobby();
  [[nodiscard]] std::string lobby_text() const;
  [[nodiscard]] std::string snapshot_text(std::int64_t game) const;

  Arena& arena_;
  web::LiveFeed& feed_;
  std::set<web::Topic> watched_;
  boost::asio::steady_timer lobby_timer_;
  bool lobby_due_ = false;
};

}  // namespace poolhall::net
