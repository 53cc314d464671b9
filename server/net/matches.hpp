// Matches that go on: one game after the other, void ones again, until all are scored. Each game is
// stored before anybody hears of it.
//
//   matches.start(plan, [](const tl::expected<MatchId, protocol::Error>& started) { ... });
//   matches.game_over(live_game);
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/net/live_game.hpp"
#include "server/net/match_host.hpp"

namespace poolhall::net {

struct MatchPlan {
  std::array<storage::AgentId, 2> agents{};
  std::uint32_t games = 1;
  storage::TermsRecord terms;
  std::uint64_t seed = 0;
  std::optional<std::string> tournament{};
  std::optional<std::uint32_t> pairing{};
  std::optional<std::string> request{};  // what a challenge was asked with
  std::optional<protocol::ChallengeId> challenge{};
  storage::Mirror mirrored = storage::Mirror::none;
};

class Matches {
 public:
  // How a tournament's matches go: on, not to another game for now, or to their end at once.
  enum class Pace : std::uint8_t { steady, held, ended };

  struct Outside {
    std::function<void(std::shared_ptr<LiveGame>)> launch;
    std::function<std::optional<protocol::TournamentId>(const std::string&)> wire_id;
    std::function<bool(const std::string& tournament, storage::AgentId)> has_left;
    std::function<void(const storage::MatchRecord&, const GameOutcome&)> on_game_over;
    std::function<void(const storage::MatchRecord&, const std::vector<GameOutcome>&)> on_match_over;
    // Its end is stored: its agents are to be told, with all its games, void ones too.
    std::function<void(const storage::MatchRecord&, const std::vector<storage::GameRecord>&)>
        tell_over;
  };
  using Started = std::function<void(const protocol::Expected<MatchId>&)>;

  Matches(GameServices& services, storage::Counters& ids, Outside outside);

  // `started` hears when match and first game are stored; then the game is launched.
  void start(const MatchPlan& plan, Started started);
  // A match that was going on when the server stopped. Its next game begins with go_on.
  void restore(const storage::MatchRecord& record, const std::vector<storage::GameRecord>& games);
  // Launches the game that was going on.
  [[nodiscard]] tl::expected<void, std::string> resume(const storage::UnfinishedGame& unfinished);
  // Starts the next game of a restored match, unless one goes on.
  void go_on(MatchId match);
  void game_over(const LiveGame& game);
  void set_pace(const std::string& tournament, Pace pace);

  [[nodiscard]] std::optional<MatchId> find(const std::string& tournament,
                                            std::uint32_t pairing) const;
  // Of a tournament, those that go on, with the games scored so far.
  [[nodiscard]] std::vector<MatchOutcome> unfinished(const std::string& tournament) const;
  [[nodiscard]] std::size_t size() const { return matches_.size(); }
  // Of a match that goes on.
  [[nodiscard]] std::optional<std::string> tournament_of(MatchId match) const;
  // Restored matches without a tournament: nobody else would start their next game.
  [[nodiscard]] std::vector<MatchId> challenges() const;

 private:
  struct LiveMatch {
    storage::MatchRecord record;
    std::uint32_t going_on = 0;  // games; two with mirrored noise
    bool finishing = false;
    std::vector<storage::GameRecord> games;  // that are over, void ones too
    std::weak_ptr<LiveGame> partner;         // of mirrored noise: the one launched last
  };
  using Drawn = std::vector<storage::GameRecord>;

  [[nodiscard]] std::vector<GameOutcome> outcomes(const LiveMatch& match) const;
  [[nodiscard]] std::optional<std::uint32_t> next_number(const LiveMatch& match) const;
  [[nodiscard]] tl::expected<storage::GameRecord, std::string> draw_game(
      const LiveMatch& match, std::uint32_t number, std::optional<protocol::GameId> shared_from);
  // The game with this number; with mirrored noise the pair, if none of it was played yet.
  [[nodiscard]] tl::expected<Drawn, std::string> draw_next(const LiveMatch& match,
                                                           std::uint32_t number);
  void begin_next(LiveMatch& match);
  [[nodiscard]] Pace pace_of(const LiveMatch& match) const;
  void finish(LiveMatch& match);
  void launch_all(MatchId match, const Drawn& games);
  void launch(const storage::UnfinishedGame& game, LiveMatch& match, Start start);
  // Both games of a pair with mirrored noise, once both go on.
  void join_pair(LiveMatch& match, const std::shared_ptr<LiveGame>& game);
  void post(storage::Writer::Work work, std::function<void()> then, std::string what);

  GameServices& services_;
  storage::Counters& ids_;
  Outside outside_;
  std::map<MatchId, LiveMatch> matches_;
  std::map<std::string, Pace> paces_;  // of tournaments; steady if not here
};

}  // namespace poolhall::net
