// One game that is going on, between its agents' sessions, the worker threads and the database.
// What is legal and whose time runs is match::Game's business; here is when things happen and who
// hears of them: nothing is told before it is stored.
//
//   auto game = std::make_shared<LiveGame>(std::move(opened), card, services, Start::fresh);
//   game->begin();
//   game->take({asker, Seat::first, request, arrival});
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "server/match/game.hpp"
#include "server/net/archive.hpp"
#include "server/net/notices.hpp"
#include "server/net/session.hpp"
#include "server/net/shared_noise.hpp"
#include "server/storage/writer.hpp"

namespace poolhall::net {

class LiveGame;

inline constexpr std::array<rules::Seat, 2> both_seats{rules::Seat::first, rules::Seat::second};

struct GameServices {
  boost::asio::io_context& io;
  boost::asio::thread_pool& workers;
  storage::Writer& writer;
  Archive& archive;
  DeadlineQueue& deadlines;
  AgentBook& book;
  const WireTime& time;
  const protocol::Limits& limits;
  // The end is stored and told.
  std::function<void(LiveGame&)> on_over;
  // Nothing is in flight any more; only asked for once the server stops.
  std::function<void()> on_quiet;
  // Whether the bots of the house that play it can come; if not, `places_given` is called later.
  std::function<bool(protocol::GameId)> has_places;
  // A turn is stored and told to its players; for those who only watch.
  std::function<void(const LiveGame&, const storage::TurnRecord&)> on_turn{};
};

// The first turn waits for the agents, but not for ever.
enum class Start : std::uint8_t {
  fresh,   // for both; who alone has not come by then forfeits
  resume,  // for the one to move; then the clock runs
};

// A request about a game, from a player of it.
struct GameRequest {
  Asker asker;
  Seat seat = Seat::first;
  std::variant<protocol::Shot, protocol::Decide, protocol::Concede> what;
  SteadyTime read_at;
};

// A game's place in a pair with mirrored noise.
struct PairPlace {
  std::shared_ptr<SharedNoise> noise;
  PairSide side = PairSide::first;
  std::shared_ptr<const LiveGame> first;  // unset: it is the first itself
};

class LiveGame : public std::enable_shared_from_this<LiveGame> {
 public:
  LiveGame(match::Game game, GameCard card, GameServices& services, Start start);

  // Tells the agents of it; the first turn comes when they are in.
  void begin();
  void take(const GameRequest& request);
  void sync(const Asker& asker, Seat seat) const;
  void reveal(const Asker& asker, Seat seat, const protocol::GameReveal& request);
  // The bots of the house that play it can come now.
  void places_given();
  // A session of this player's is new: all that a bot without memory needs.
  void agent_came(Seat seat);
  // Whether this is the answer to the turn that waits for it.
  [[nodiscard]] bool is_awaited(Seat seat, const protocol::Request& request) const;
  // Loses it, after what is in flight.
  void leave(Seat loser);
  // Ends it as void, after what is in flight.
  void call_off();
  // Before begin().
  void join_pair(PairPlace place) { pair_ = std::move(place); }
  // No new turns; what is in flight finishes.
  void halt();
  // While the database takes nothing no clock runs and no flag falls.
  void suspend();
  void go_on_after_suspension();

  [[nodiscard]] const storage::GameRecord& record() const { return game_.record(); }
  [[nodiscard]] const match::Game& game() const { return game_; }
  [[nodiscard]] const GameCard& card() const { return card_; }
  [[nodiscard]] bool in_flight() const;
  [[nodiscard]] std::optional<Seat> seat_of(storage::AgentId agent) const;
  [[nodiscard]] protocol::GameListing listing_for(Seat seat) const;

 private:
  [[nodiscard]] match::Arrival arrival_of(const GameRequest& request) const;
  [[nodiscard]] match::Answer ask(const GameRequest& request);
  void act(match::Answer answer, const GameRequest& request);
  void play(match::ShotJob job, const Asker& asker);
  void play_in_pair(match::ShotJob job);
  void run(match::ShotJob job);
  void settle(match::PlayOutcome outcome);
  void write(match::Store what, const Asker& asker);
  void post_write();
  void written(const storage::Expected<void>& stored);
  void not_written(const storage::StorageError& error);
  void tell(const match::Store& what);
  // Of a shot or a decision, `message_of(row, side)`.
  template <class TurnReply, class MessageOf>
  void tell_played(const storage::TurnRecord& row, MessageOf message_of);
  void tell_lost_turn(const storage::TurnRecord& row);
  void tell_over();
  void answer_from(const storage::TurnRecord& row, const GameRequest& request) const;
  void look_up(std::uint32_t turn, const GameRequest& request) const;
  void go_on();
  void end_as_void();
  void forfeit(Seat loser);
  void take_waiting();
  void await_agents();
  void start_waited_enough();
  [[nodiscard]] bool has_never_registered(rules::Seat seat) const;
  [[nodiscard]] bool may_be_revealed() const;
  [[nodiscard]] bool awaits_reveals();
  void revealed(const Asker& asker, Seat seat, const storage::Expected<void>& stored);
  [[nodiscard]] bool all_needed_are_in() const;
  void begin_turn();
  void watch_flag();
  void flag_due();
  [[nodiscard]] std::shared_ptr<Session> session_of(Seat seat) const;
  [[nodiscard]] storage::Micros lag_of(Seat seat) const;
  void push(Seat seat, const Notification& notification) const;
  [[nodiscard]] protocol::GameSnapshot<Outgoing> snapshot_for(Seat seat) const;

  match::Game game_;
  GameCard card_;
  GameServices& services_;
  Start start_;
  bool awaiting_agents_ = true;  // before the first turn of this run of the server
  bool halted_ = false;
  bool called_off_ = false;
  std::optional<Seat> left_{};  // who has left the tournament, the first of the two
  bool suspended_ = false;
  bool reveals_over_ = false;  // who has not revealed by now contributes nothing
  std::uint32_t reveals_being_stored_ = 0;
  std::optional<PairPlace> pair_{};
  Deadline arrival_deadline_;
  Deadline reveal_deadline_;
  Deadline flag_;
  Deadline write_retry_;
  Asker asker_;                       // of what is in flight
  std::vector<Asker> joined_;         // who asked the same meanwhile
  std::vector<GameRequest> waiting_;  // what cannot be answered while something is in flight
  std::shared_ptr<const match::Store> store_;  // being stored
  std::uint32_t failures_ = 0;                 // of storing, in a row
};

[[nodiscard]] Side side_of(Seat seat, const std::shared_ptr<Session>& session);

// What a stored turn answers to a request that came again; also for games long over.
void answer_from_row(const storage::TurnRecord& row, const Asker& asker, Seat seat,
                     const std::variant<protocol::Shot, protocol::Decide>& what);

}  // namespace poolhall::net
