// Challenges: of the house at once, of another agent by offer and answer. Offers live in memory
// only: they expire in a minute anyway. What became a match is known for as long as the database.
//
//   challenges.challenge(asker, agent, request);
//   challenges.accept(asker, agent, request.challenge);
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/net/house_bots.hpp"
#include "server/net/matches.hpp"

namespace poolhall::net {

class Challenges {
 public:
  struct Outside {
    // The house's agent to play a bot of that name, made known if need be; else what was expected.
    std::function<tl::expected<storage::AgentId, std::string>(storage::AgentId from,
                                                              const std::string& bot)>
        house_agent;
    // How many games of this agent go on.
    std::function<std::size_t(storage::AgentId agent)> games_of;
  };

  Challenges(GameServices& services, Matches& matches, Outside outside);

  void challenge(const Asker& asker, storage::AgentId from, const protocol::Challenge& request);
  void accept(const Asker& asker, storage::AgentId by, protocol::ChallengeId challenge);
  void decline(const Asker& asker, storage::AgentId by, protocol::ChallengeId challenge);
  // This agent has a new session: offers that wait for its answer.
  void agent_came(storage::AgentId agent);

 private:
  enum class State : std::uint8_t { offered, starting, accepted, declined, expired };
  struct Entry {
    protocol::Challenge request;
    storage::AgentId from{};
    storage::AgentId to{};
    storage::TermsRecord terms;
    State state = State::offered;
    std::optional<MatchId> match{};
    std::vector<Asker> askers;  // who wait for the match to be stored
    SteadyTime expires{};       // the offer
    Deadline expiry;            // of the offer, later of the entry
  };
  using Key = std::pair<storage::AgentId, std::string>;  // agent and challenge_id

  [[nodiscard]] bool repeats(const Asker& asker, storage::AgentId from,
                             const protocol::Challenge& request);
  // Asked before, perhaps of an earlier run of the server; its match may be over.
  void repeats_match(const Asker& asker, storage::AgentId from, const protocol::Challenge& request,
                     const storage::MatchRecord& match) const;
  void make(const Asker& asker, storage::AgentId from, const protocol::Challenge& request);
  [[nodiscard]] protocol::Expected<storage::TermsRecord> terms_of_request(
      const protocol::Challenge& request) const;
  [[nodiscard]] protocol::Expected<storage::AgentId> opponent_of(storage::AgentId from,
                                                                 const std::string& name) const;
  [[nodiscard]] Entry* addressed_to(const Asker& asker, storage::AgentId by,
                                    protocol::ChallengeId id);
  void offer(protocol::ChallengeId id, Entry& entry, const Asker& asker);
  void begin(protocol::ChallengeId id, const Asker& asker);
  void started(protocol::ChallengeId id, const protocol::Expected<MatchId>& match);
  void expire(protocol::ChallengeId id);
  void forget_later(protocol::ChallengeId id);
  void forget(protocol::ChallengeId id);
  // Makes room for one more of this agent's; false when all that it has made are under way.
  [[nodiscard]] bool has_room(storage::AgentId from);
  void set_state(protocol::ChallengeId id, Entry& entry, State state);
  void reply(const Asker& asker, protocol::ChallengeId id, const Entry& entry) const;
  void push(storage::AgentId agent, const Notification& notification) const;
  [[nodiscard]] protocol::ChallengeOffer offer_of(protocol::ChallengeId id,
                                                  const Entry& entry) const;

  GameServices& services_;
  Matches& matches_;
  Outside outside_;
  // Ids of an earlier run of the server are not given again.
  std::int64_t next_id_;
  std::map<protocol::ChallengeId, Entry> entries_;
  std::map<Key, protocol::ChallengeId> by_key_;
  // By agent, the oldest first.
  std::map<storage::AgentId, std::set<protocol::ChallengeId>> made_by_;
  std::map<storage::AgentId, std::set<protocol::ChallengeId>> offered_to_;  // that wait
};

}  // namespace poolhall::net
