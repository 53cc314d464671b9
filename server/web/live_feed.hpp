// Who watches what, and what they are told: one serialised message for all of them, a bounded queue
// for each, and after a gap a fresh snapshot instead of the backlog.
//
//   LiveFeed feed{io, delay, {begin_telling, end_telling}};
//   feed.join(spectator, game_topic(17));      // asks for a snapshot; then every message
//   feed.publish(game_topic(17), message);     // from any thread
//
// A spectator is told nothing until a snapshot has come; messages and snapshots of one publisher
// come in its order, so that none is missed between them. But for publish and snapshot everything
// here is the web thread's own.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace poolhall::web {

// What one can watch: the lobby (which games go on), or a game.
enum class Topic : std::int64_t { lobby = 0 };
[[nodiscard]] constexpr Topic game_topic(std::int64_t game) {
  return Topic{game};
}
[[nodiscard]] constexpr std::int64_t number(Topic topic) {
  return static_cast<std::int64_t>(topic);
}

using Message = std::shared_ptr<const std::string>;

// Which request for a snapshot one answers: an older one would leave a gap behind it.
enum class Ticket : std::uint64_t {};

// One who watches: a bounded queue, and a bell for whoever writes from it.
class Spectator {
 public:
  static constexpr std::size_t queue_bytes = 256 * 1024;

  explicit Spectator(const boost::asio::any_io_executor& executor)
      : bell_(executor, boost::asio::steady_timer::time_point::max()) {}

  // False when it does not fit: what is queued is dropped then, the spectator has a gap.
  [[nodiscard]] bool offer(const Message& message);
  // The next message to write; null if there is none.
  [[nodiscard]] Message take();
  void leave();
  [[nodiscard]] bool has_gap() const { return gap_; }
  void forget_gap() { gap_ = false; }
  [[nodiscard]] bool has_left() const { return left_; }
  // Waited on by the writer; cancelled when something is to be done.
  [[nodiscard]] boost::asio::steady_timer& bell() { return bell_; }

 private:
  boost::asio::steady_timer bell_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;
  bool gap_ = false;
  bool left_ = false;
};

class LiveFeed {
 public:
  // The publisher's side; called on the web thread, must return at once.
  struct Publisher {
    // Tell of this from now on, a snapshot with this ticket first.
    std::function<void(Topic, Ticket)> watch;
    std::function<void(Topic)> unwatch;  // nobody watches any more
  };

  LiveFeed(boost::asio::io_context& io, std::chrono::milliseconds delay, Publisher publisher);

  void join(const std::shared_ptr<Spectator>& spectator, Topic topic);
  void leave(const std::shared_ptr<Spectator>& spectator, Topic topic);
  // After a gap: a snapshot, please.
  void catch_up(const std::shared_ptr<Spectator>& spectator, Topic topic);
  void close();
  [[nodiscard]] std::size_t spectators() const;

  // From any thread.
  void publish(Topic topic, Message message);
  void snapshot(Topic topic, Ticket ticket, Message message);

 private:
  struct Audience {
    std::set<std::shared_ptr<Spectator>> watching;
    std::set<std::shared_ptr<Spectator>> waiting;  // for a snapshot
    Ticket awaited{};                              // by those who wait
  };
  struct Delayed {
    std::chrono::steady_clock::time_point due;
    std::function<void()> action;
  };

  void after_delay(std::function<void()> action);
  void wait_for_delayed();
  void tell(Topic topic, const Message& message);
  void tell_snapshot(Topic topic, Ticket ticket, const Message& message);

  boost::asio::io_context& io_;
  std::chrono::milliseconds delay_;
  Publisher publisher_;
  std::map<Topic, Audience> audiences_;
  std::uint64_t next_ticket_ = 1;
  std::deque<Delayed> delayed_;
  boost::asio::steady_timer delay_timer_;
};

}  // namespace poolhall::web
