// One agent's conversation with the server, without sockets, threads and clocks: lines in, lines
// and thoughts out. It outlives connections: games, unconfirmed answers and the token stay, so that
// after a new login everything that was pending is sent again as it was.
//
//   Agent agent(settings, factory, outside);
//   agent.begin_session();                            // sends hello, then logs in
//   if (std::optional<End> end = agent.line_came(line)) ...   // do not reconnect
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cpp/game_desk.hpp"
#include "clients/cpp/noise_parts.hpp"
#include "clients/cpp/player.hpp"
#include "protocol/codec.hpp"

namespace poolhall::client {

enum class OfferPolicy : std::uint8_t { accept, decline };
// Whether the agent adds bytes of its own to the noise (noise_parts.hpp).
enum class NoisePart : std::uint8_t { added, none };

struct AgentSettings {
  std::string name{};                       // registered under it if the token is not known yet
  std::optional<protocol::Hex256> token{};  // unset: one is made
  protocol::ClientInfo software{"poolhall-cpp", "1"};
  protocol::EventDetail detail = protocol::EventDetail::summary;
  OfferPolicy offers = OfferPolicy::accept;  // of other agents' challenges
  NoisePart noise = NoisePart::added;
  std::vector<protocol::Challenge> challenges{};      // made once logged in
  std::vector<protocol::TournamentId> tournaments{};  // joined once logged in
  std::optional<std::size_t> games{};                 // done after so many; unset: never
  std::function<void(const GameInfo&, const protocol::GameOver&)> on_game_over{};
  std::function<void(std::string_view)> log{};  // one line an event
};

// Why an agent is done for good.
enum class Ending : std::uint8_t {
  superseded,  // another login with the same token
  finished,    // all games wanted are played
  refused,     // the server does not want this agent; the reason says why
  stopped,     // the host program asked for it
};
struct End {
  Ending ending = Ending::stopped;
  std::string reason;
};

// What the agent needs from the world.
class Outside {
 public:
  Outside() = default;
  Outside(const Outside&) = delete;
  Outside& operator=(const Outside&) = delete;
  virtual ~Outside() = default;

  virtual void send(std::string line) = 0;
  // Let `player` choose, then call Agent::move_chosen.
  virtual void think(const GameInfo& info, std::shared_ptr<Player> player,
                     const TurnTask& task) = 0;
  // Call Agent::send_answer_again after `delay`.
  virtual void wake(protocol::GameId game, std::chrono::milliseconds delay) = 0;
};

class Agent {
 public:
  Agent(AgentSettings settings, PlayerFactory factory, Outside& outside);

  // On a fresh connection.
  void begin_session();
  // The connection is gone: nothing is sent until the next session.
  void session_ended();
  [[nodiscard]] std::optional<End> line_came(std::string_view line);
  void move_chosen(protocol::GameId game, TurnKey key, const Move& move);
  void send_answer_again(protocol::GameId game);
  void send_ping();

  [[nodiscard]] bool is_logged_in() const { return stage_ == Stage::logged_in; }
  // The server does not let it in at the moment: hang up, and come back later.
  [[nodiscard]] bool is_put_off() const { return stage_ == Stage::put_off; }
  [[nodiscard]] const protocol::Hex256& token() const { return token_; }

 private:
  enum class Stage : std::uint8_t { greeting, logging_in, registering, logged_in, put_off };
  struct InFlight {
    protocol::Method method{};
    std::optional<protocol::GameId> game{};
    TurnKey key{};          // of an answer to a turn
    std::size_t index = 0;  // of a challenge or tournament in the settings
  };
  using Result = std::optional<End>;

  void send(const protocol::Request& request, InFlight in_flight);
  void act(GameDesk& desk, GameDesk::Step step);
  void send_answer(const GameDesk& desk);
  [[nodiscard]] std::optional<InFlight> take(const protocol::RequestId& id);
  void log(std::string_view line) const;

  [[nodiscard]] Result reply_came(const protocol::ReplyMessage& message);
  [[nodiscard]] Result logged_in(const protocol::LoginReply& reply);
  [[nodiscard]] Result acknowledged();
  [[nodiscard]] Result synchronised(const protocol::SyncReply<protocol::Received>& reply);
  void send_wishes();

  [[nodiscard]] Result error_came(const protocol::ErrorMessage& message);
  [[nodiscard]] Result login_failed(const protocol::ErrorMessage& message, Stage stage);
  void answer_failed(const protocol::ErrorMessage& message, const InFlight& in_flight);

  // Notifications that an agent has to react to; the rest is ignored.
  [[nodiscard]] Result notified(const protocol::GameStart<protocol::Received>& start);
  [[nodiscard]] Result notified(const protocol::GameSnapshot<protocol::Received>& snapshot);
  [[nodiscard]] Result notified(const protocol::GameTurn<protocol::Received>& turn);
  [[nodiscard]] Result notified(const protocol::GameShot<protocol::Received>& shot);
  [[nodiscard]] Result notified(const protocol::GameTurnLost<protocol::Received>& lost);
  [[nodiscard]] Result notified(const protocol::GameOver& over);
  [[nodiscard]] Result notified(const protocol::MatchOver& over);
  [[nodiscard]] Result notified(const protocol::TournamentOver& over);
  [[nodiscard]] Result notified(const protocol::ChallengeOffer& offer);
  [[nodiscard]] Result notified(const protocol::ChallengeOver& over);
  [[nodiscard]] Result notified(const protocol::LagProbe& probe);
  [[nodiscard]] Result notified(const protocol::Superseded&);
  template <class Other>
  [[nodiscard]] Result notified(const Other&) {
    return std::nullopt;
  }
  void seen(const protocol::GameShot<protocol::Received>& shot);
  void add_to_next_noise();
  void reveal(const protocol::GameTerms<protocol::Received>& terms);
  void open_desk(const protocol::GameTerms<protocol::Received>& terms);

  AgentSettings settings_;
  PlayerFactory factory_;
  Outside& outside_;
  protocol::Hex256 token_;
  bool may_be_registered_ = false;
  Stage stage_ = Stage::greeting;
  std::int64_t next_id_ = 1;
  std::map<std::int64_t, InFlight> in_flight_;
  std::map<protocol::GameId, GameDesk> desks_;
  NoiseParts noise_parts_;
  std::set<protocol::GameId> finished_;
  std::set<std::size_t> challenges_made_;
  std::set<std::size_t> tournaments_joined_;
};

}  // namespace poolhall::client
