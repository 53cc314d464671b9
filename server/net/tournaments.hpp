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
#include "server/settings/tournament_settings.hpp"

namespace poolhall::net {

[[nodiscard]] constexpr bool has_ended(TournamentStatus status) {
  return status == TournamentStatus::finished || status == TournamentStatus::aborted;
}

class Tournaments final : public MatchHost {
 public:
  struct Outside {
    // Makes an agent of the house known, or finds it.
    std::function<Agent&(const std::string& name, const HousePlayer& player)> house;
    // Makes an agent of that name known, who may come later.
    std::function<Agent&(const std::string& name)> stand_in;
    // Games that go on are lost.
    std::function<void(const std::string& tournament, storage::AgentId loser)> forfeit_games;
  };
  using Done = std::function<void(const protocol::Expected<void>&)>;

  Tournaments(GameServices& services, Matches& matches, Untold& untold, storage::Counters& ids,
              Outside outside);

  // At the start, before anything else.
  [[nodiscard]] storage::Expected<void> restore(storage::Reader& reader, StoredTournaments which);

  // MatchHost.
  TournamentCard open_tournament(const TournamentCard& card) override;
  void set_status(const std::string& tournament, TournamentStatus status) override;
  [[nodiscard]] std::vector<TournamentCard> tournaments() const override;
  void enter(const TournamentEntry& entry) override;
  [[nodiscard]] std::vector<TournamentEntry> entries(const std::string& tournament) const override;
  void set_intake(const std::string& tournament, const Intake& intake) override;
  void start_match(const MatchOrder& order) override;
  void cancel_match(const std::string& tournament, std::uint32_t pairing) override;
  [[nodiscard]] std::vector<MatchOutcome> finished_matches(
      const std::string& tournament) const override;
  [[nodiscard]] std::vector<MatchOutcome> unfinished_matches(
      const std::string& tournament) const override;
  void on_match_over(std::function<void(const MatchOutcome&)> callback) override;
  void on_game_over(std::function<void(const MatchOrder&, const GameOutcome&)> callback) override;
  void on_entries_changed(std::function<void(const std::string&)> callback) override;
  void announce_end(const std::string& tournament,
                    const std::vector<protocol::StandingRow>& standings) override;
  // Ends that no agent has been told of yet, for they are not stored.
  [[nodiscard]] std::size_t ends_under_way() const { return ends_under_way_; }

  // What Matches tells.
  void game_over(const storage::MatchRecord& match, const GameOutcome& outcome);
  void match_over(const storage::MatchRecord& match, const std::vector<GameOutcome>& games);
  [[nodiscard]] std::optional<protocol::TournamentId> wire_id(const std::string& id) const;
  // Its games that begin now are forfeited.
  [[nodiscard]] bool has_left(const std::string& tournament, storage::AgentId agent) const;

  // What agents ask.
  void list(const Asker& asker) const;
  void join(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  void leave(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  // That the end of a tournament is known.
  void acknowledge(const Asker& asker, storage::AgentId agent, protocol::TournamentId tournament);
  // What the host asks, of a tournament that there is. `then` hears when it is stored.
  void host_enters(const std::string& tournament, const std::string& name, const Done& then);
  void host_withdraws(const std::string& tournament, const std::string& name, const Done& then);
  // An agent is new: entries and matches that wait for it go on.
  void agent_enrolled();

 private:
  struct Tournament {
    storage::TournamentRecord record;
    protocol::TournamentListing listing;  // without agents
    settings::Joining joining = settings::Joining::late;
    Intake intake{};                                 // while it goes on
    std::vector<storage::EntryRecord> entered;       // without how house bots are started
    std::map<std::uint32_t, MatchOutcome> finished;  // by pairing
  };
  using Awaited = std::vector<TournamentEntry>;
  using OrderKey = std::pair<std::string, std::uint32_t>;

  [[nodiscard]] static storage::Expected<void> restore_entries(storage::Reader& reader,
                                                               Tournament& tournament);
  [[nodiscard]] static storage::Expected<void> restore_results(storage::Reader& reader,
                                                               Tournament& tournament);
  Tournament& keep(const storage::TournamentRecord& record);
  [[nodiscard]] Tournament* find(const Asker& asker, protocol::TournamentId id);
  // Entries (tournament_entries.cpp).
  [[nodiscard]] Awaited::iterator awaited(const std::string& tournament, const std::string& name);
  [[nodiscard]] static storage::EntryRecord* entry_in(Tournament& tournament,
                                                      storage::AgentId agent);
  [[nodiscard]] storage::EntryRecord new_entry(const Tournament& tournament,
                                               storage::AgentId agent) const;
  void add_entry(Tournament& tournament, storage::AgentId agent);
  [[nodiscard]] TournamentEntry entry_of(const storage::EntryRecord& record) const;
  [[nodiscard]] std::optional<protocol::Error> why_not_enter(const Tournament& tournament) const;
  [[nodiscard]] std::optional<protocol::Error> why_not_join(const Tournament& tournament) const;
  void admit(Tournament& tournament, storage::AgentId agent, const Done& then);
  void withdraw(Tournament& tournament, storage::AgentId agent, const Done& then);
  void tell_entries_changed(const Tournament& tournament);
  void store_change(storage::Writer::Work work, const std::function<void()>& undo,
                    const Done& then);

  void store(storage::Writer::Work work, std::string what);
  void await_agents(const OrderKey& key, const MatchOrder& order);
  void waited_enough(const OrderKey& key);
  void begin(const MatchOrder& order, const std::array<storage::AgentId, 2>& agents);

  GameServices& services_;
  Matches& matches_;
  Untold& untold_;
  storage::Counters& ids_;
  std::function<Agent&(const std::string&, const HousePlayer&)> house_;
  std::function<Agent&(const std::string&)> stand_in_;
  std::function<void(const std::string&, storage::AgentId)> forfeit_games_;
  std::map<std::string, Tournament> tournaments_;
  std::size_t ends_under_way_ = 0;
  std::map<OrderKey, MatchOrder> orders_;
  Awaited awaited_entries_;  // of agents that have not registered yet
  std::map<OrderKey, MatchOrder> awaited_orders_;
  std::map<OrderKey, Deadline> awaited_until_;
  std::map<storage::AgentId, TournamentEntry> house_entries_;
  std::function<void(const MatchOutcome&)> on_match_over_;
  std::function<void(const MatchOrder&, const GameOutcome&)> on_game_over_;
  std::function<void(const std::string&)> on_entries_changed_;
};

}  // namespace poolhall::net
