// Tournaments as the server keeps them: rows, entries, results. Who plays whom is the driver's
// business (match_host.hpp); what agents ask over the wire is answered here too.
//
//   Tournaments tournaments{services, matches, ids, house};
//   tournaments.start_match(order);
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/net/house_bots.hpp"
#include "server/net/match_host.hpp"
#include "server/net/matches.hpp"
#include "server/net/untold.hpp"

namespace poolhall::net {

class Tournaments final : public MatchHost {
 public:
  // Makes an agent of the house known, or finds it.
  using House = std::function<Agent&(const std::string& name, const HousePlayer& player)>;
  // Makes an agent of that name known, who may come later.
  using StandIn = std::function<Agent&(const std::string& name)>;

  Tournaments(GameServices& services, Matches& matches, Untold& untold, storage::Counters& ids,
              House house, StandIn stand_in);

  // At the start, before anything else.
  [[nodiscard]] storage::Expected<void> restore(storage::Reader& reader);

  // MatchHost.
  TournamentCard open_tournament(const TournamentCard& card) override;
  void set_status(const std::string& tournament, TournamentStatus status) override;
  [[nodiscard]] std::vector<TournamentCard> tournaments() const override;
  void enter(const TournamentEntry& entry) override;
  [[nodiscard]] std::vector<TournamentEntry> entries(const std::string& tournament) const override;
  void start_match(const MatchOrder& order) override;
  [[nodiscard]] std::vector<MatchOutcome> finished_matches(
      const std::string& tournament) const override;
  [[nodiscard]] std::vector<MatchOutcome> unfinished_matches(
      const std::string& tournament) const override;
  void on_match_over(std::function<void(const MatchOutcome&)> callback) override;
  void on_game_over(std::function<void(const MatchOrder&, const GameOutcome&)> callback) override;
  void announce_end(const std::string& tournament,
                    const std::vector<protocol::StandingRow>& standings) override;

  // What Matches tells.
  void game_over(const storage::MatchRecord& match, const GameOutcome& outcome);
  void match_over(const storage::MatchRecord& match, const std::vector<GameOutcome>& games);
  [[nodiscard]] std::optional<protocol::TournamentId> wire_id(const std::string& id) const;

  // What agents ask.
  void list(const Asker& asker) const;
  void join(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  void leave(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  // That the end of a tournament is known.
  void acknowledge(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  // An agent is new: entries and matches that wait for it go on.
  void agent_enrolled();

 private:
  struct Entered {
    storage::AgentId agent{};
    bool withdrawn = false;
  };
  struct Tournament {
    storage::TournamentRecord record;
    protocol::TournamentListing listing;  // without agents
    std::vector<Entered> entered;
    std::map<std::uint32_t, MatchOutcome> finished;  // by pairing
  };
  using OrderKey = std::pair<std::string, std::uint32_t>;

  [[nodiscard]] storage::Expected<void> restore_one(storage::Reader& reader,
                                                    const storage::TournamentRecord& record);
  Tournament& keep(const storage::TournamentRecord& record);
  [[nodiscard]] Tournament* find(const Asker& asker, protocol::TournamentId id);
  void add_entry(Tournament& tournament, storage::AgentId agent);
  void store(storage::Writer::Work work, std::string what);
  void await_agents(const OrderKey& key, const MatchOrder& order);
  void waited_enough(const OrderKey& key);
  void begin(const MatchOrder& order, const std::array<storage::AgentId, 2>& agents);
  [[nodiscard]] TournamentEntry entry_of(const std::string& tournament,
                                         storage::AgentId agent) const;

  GameServices& services_;
  Matches& matches_;
  Untold& untold_;
  storage::Counters& ids_;
  House house_;
  StandIn stand_in_;
  std::map<std::string, Tournament> tournaments_;
  std::map<OrderKey, MatchOrder> orders_;
  std::vector<TournamentEntry> awaited_entries_;  // of agents that have not registered yet
  std::map<OrderKey, MatchOrder> awaited_orders_;
  std::map<OrderKey, Deadline> awaited_until_;
  std::map<storage::AgentId, TournamentEntry> house_entries_;
  std::function<void(const MatchOutcome&)> on_match_over_;
  std::function<void(const MatchOrder&, const GameOutcome&)> on_game_over_;
};

}  // namespace poolhall::net
