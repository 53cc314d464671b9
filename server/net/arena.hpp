// The hub: who is here, which games go on, and where each request goes. All of it lives on the
// network thread.
//
//   Arena arena{io, workers, writer, archive, settings};
//   if (auto restored = arena.restore(*reader, taken_up); !restored) die(restored.error());
//   arena.accept(std::move(socket), on_gone);
//   arena.begin();              // games that were going on, go on
//   arena.stop([&] { io.stop(); });
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/net/challenges.hpp"
#include "server/net/finished_games.hpp"
#include "server/net/house_bots.hpp"
#include "server/net/live_game.hpp"
#include "server/net/matches.hpp"
#include "server/net/session.hpp"
#include "server/net/tournaments.hpp"
#include "server/net/untold.hpp"
#include "server/net/visitors.hpp"

namespace poolhall::net {

enum class Registration : std::uint8_t { open, closed };

struct ArenaSettings {
  protocol::Limits limits;
  std::string name = "poolhall";
  Registration registration = Registration::open;
  std::vector<std::string> house_bots;  // that agents may challenge as "house:NAME"
};

// For people and their graphs.
struct ArenaFigures {
  std::size_t connections = 0;
  std::size_t agents_here = 0;
  std::size_t agents_known = 0;
  std::size_t games = 0;
  std::size_t matches = 0;
  std::size_t house_bots = 0;
  std::uint64_t games_over = 0;  // since the start
  bool storage_in_trouble = false;
};

class Arena final : public Lobby {
 public:
  Arena(boost::asio::io_context& io, boost::asio::thread_pool& workers, storage::Writer& writer,
        Archive& archive, ArenaSettings settings);
  ~Arena() override;

  // Takes up what the database has, before anything else.
  [[nodiscard]] storage::Expected<void> restore(storage::Reader& reader,
                                                StoredTournaments tournaments);
  // Restored games go on; house bots may start.
  void begin(const HouseBots::Settings& bots);
  // A new connection; `gone` is called when its socket is closed.
  void accept(Channel channel, std::function<void()> gone);
  // One that there is no room for; it hears why once its handshake is done.
  void turn_away(Channel channel, const protocol::Error& error);
  // No new turns; when nothing is in flight and everyone is told, `then`.
  void stop(std::function<void()> then);
  void storage_health(const storage::WriterHealth& health);

  // The host's calls. `then` gets the new agent's token, or why there is none.
  void add_agent(const std::string& name,
                 std::function<void(const protocol::Expected<std::string>&)> then);
  enum class CalledOff : std::uint8_t { ends, no_game_that_goes_on };
  // Ends it as void; its match plays it again.
  CalledOff call_off(protocol::GameId game);
  void call_off_games_of(const std::string& tournament);
  // Calls `then` when all that was decided before is stored.
  void when_stored(std::function<void()> then);
  [[nodiscard]] Matches& matches() { return matches_; }

  [[nodiscard]] Visitors& visitors() { return visitors_; }
  [[nodiscard]] MatchHost& host() { return tournaments_; }
  [[nodiscard]] Tournaments& tournaments() { return tournaments_; }
  [[nodiscard]] ArenaFigures figures() const;
  void for_each_game(const std::function<void(const LiveGame&)>& visit) const;
  [[nodiscard]] const LiveGame* find_game(protocol::GameId game) const { return live_game(game); }
  [[nodiscard]] const WireTime& time() const { return time_; }
  // Each replaces the callback before it: a turn is stored; a game has begun or ended.
  void on_turn(std::function<void(const LiveGame&, const storage::TurnRecord&)> callback) {
    services_.on_turn = std::move(callback);
  }
  void on_games_changed(std::function<void()> callback) { on_games_changed_ = std::move(callback); }

  // Lobby.
  [[nodiscard]] const protocol::Limits& limits() const override { return settings_.limits; }
  [[nodiscard]] DeadlineQueue& deadlines() override { return deadlines_; }
  [[nodiscard]] protocol::HelloReply greeting(const Session& session) const override;
  [[nodiscard]] std::int64_t time_ms(SteadyTime t) const override { return time_.ms(t); }
  void enroll(const std::shared_ptr<Session>& session, const protocol::Register& request) override;
  void admit(const std::shared_ptr<Session>& session, const protocol::Login& request) override;
  [[nodiscard]] bool is_awaited(storage::AgentId agent,
                                const protocol::Request& request) const override;
  void handle(const Asker& asker, storage::AgentId agent, protocol::Request request,
              SteadyTime read_at) override;
  void leaves(const Session& session) override;
  void ended(const Session& session) override;

 private:
  enum class Stage : std::uint8_t { running, stopping, told };

  // Joining: registration, login, takeover (arena_joining.cpp).
  [[nodiscard]] std::optional<protocol::Error> why_not(const protocol::Register& request) const;
  using Enrolled = std::function<void(const protocol::Expected<storage::AgentId>&)>;
  void enroll_agent(const std::string& name, const TokenHash& token, Enrolled then);
  void store_enrolment(storage::Writer::Work work, storage::AgentId agent,
                       storage::Writer::Done done);
  [[nodiscard]] storage::AgentRecord new_record(const std::string& name);
  Agent& make_agent(const storage::AgentRecord& record);
  void claim(Agent& agent, const TokenHash& token, Enrolled then);
  Agent& stand_in(const std::string& name);
  void let_in(const std::shared_ptr<Session>& session, storage::AgentId agent,
              std::optional<protocol::Hex256> token);
  void bind(const std::shared_ptr<Session>& session, Agent& agent,
            std::optional<protocol::Hex256> token);
  void catch_up(const std::shared_ptr<Session>& session, const Agent& agent);
  [[nodiscard]] protocol::LoginReply login_reply(const Agent& agent) const;
  Agent& house_agent(const std::string& name, const HousePlayer& player);
  [[nodiscard]] tl::expected<storage::AgentId, std::string> house_opponent(storage::AgentId from,
                                                                           const std::string& bot);
  [[nodiscard]] std::optional<std::string> why_no_house_opponent(storage::AgentId from,
                                                                 const std::string& bot) const;

  // Requests.
  void handle_game(const Asker& asker, storage::AgentId agent, protocol::Request& request,
                   SteadyTime read_at);
  void ready(const Asker& asker, storage::AgentId agent, const protocol::GameReady& request);
  void acknowledge(const Asker& asker, storage::AgentId agent, const protocol::Ended& what);
  [[nodiscard]] LiveGame* live_game(protocol::GameId game) const;

  // Games.
  void launch(std::shared_ptr<LiveGame> game);
  void game_over(LiveGame& game);
  void forfeit_games_of(const std::string& tournament, storage::AgentId loser);
  void look_whether_quiet();
  void tell_everyone();

  boost::asio::io_context& io_;
  ArenaSettings settings_;
  WireTime time_;
  DeadlineQueue deadlines_;
  Visitors visitors_;  // outlives connections
  ConnectionContext connections_;
  AgentBook book_;
  Untold untold_;
  storage::Counters ids_;
  GameServices services_;
  HouseBots bots_;
  Matches matches_;
  Tournaments tournaments_;
  Challenges challenges_;
  FinishedGames finished_;
  std::unordered_map<std::int64_t, std::shared_ptr<LiveGame>> games_;
  std::map<storage::AgentId, std::vector<protocol::GameId>> games_of_;
  std::unordered_map<std::uint64_t, std::shared_ptr<Session>> sessions_;
  std::vector<storage::UnfinishedGame> unfinished_;          // until begin()
  std::map<storage::AgentId, std::uint64_t> house_choices_;  // when each was chosen last
  std::uint64_t house_choice_ = 0;
  std::uint64_t next_connection_ = 1;
  std::size_t turned_away_ = 0;  // that are still being told
  std::uint64_t games_over_ = 0;
  std::function<void()> on_games_changed_;
  bool storage_in_trouble_ = false;
  Stage stage_ = Stage::running;
  std::function<void()> after_stop_;
  Deadline stop_deadline_;
};

}  // namespace poolhall::net
