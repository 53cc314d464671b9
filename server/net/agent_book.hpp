// Who is known to the server, and who of them is here.
//
//   Agent* agent = book.with_token(hash);
//   if (agent && agent->session.lock()) push(...);
//
// The network thread's own. Agents are never forgotten, so that pointers to them stay good.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "server/net/deadline_queue.hpp"
#include "server/net/tokens.hpp"
#include "server/storage/records.hpp"

namespace poolhall::net {

class Session;

// What an agent has committed itself to for its next games (game.ready): one for each, the oldest
// first. They are of one connection: who connects again need not remember the bytes behind them.
class Commitments {
 public:
  static constexpr std::size_t most = 16;

  // The oldest makes room. One that is there already is not added again.
  void add(const storage::Digest& commitment, const std::shared_ptr<Session>& session);
  // For a game that begins.
  [[nodiscard]] std::optional<storage::Digest> take();

 private:
  std::weak_ptr<Session> session_;
  std::deque<storage::Digest> waiting_;
};

struct Agent {
  storage::AgentRecord record;
  std::weak_ptr<Session> session;
  std::optional<SteadyTime> last_login{};
  bool stored = true;  // false while the database has not said so
  Commitments commitments{};

  [[nodiscard]] storage::AgentId id() const { return record.id; }
};

// The hash that a name is kept with for whoever registers under it; no token has it.
[[nodiscard]] TokenHash unclaimed(storage::AgentId agent);
[[nodiscard]] bool is_unclaimed(const TokenHash& hash);

class AgentBook {
 public:
  // Adds one whose id and name are new.
  Agent& add(storage::AgentRecord record);
  void remove(storage::AgentId id);
  // Another token, for this run of the server only: house bots' tokens are nowhere else.
  void set_token(Agent& agent, const TokenHash& hash);

  [[nodiscard]] Agent* find(storage::AgentId id);
  [[nodiscard]] Agent* named(std::string_view name);  // whatever the case of its letters
  [[nodiscard]] Agent* with_token(const TokenHash& hash);
  [[nodiscard]] const std::string& name_of(storage::AgentId id) const;
  [[nodiscard]] std::size_t size() const { return by_id_.size(); }
  void for_each(const std::function<void(Agent&)>& visit);

 private:
  std::unordered_map<std::int64_t, std::unique_ptr<Agent>> by_id_;
  std::unordered_map<std::string, Agent*> by_name_;  // in lower case
  // By the first 8 bytes of the hash: they tell an attacker nothing of the token. The rest is
  // compared in constant time.
  std::unordered_multimap<std::uint64_t, Agent*> by_token_;
};

}  // namespace poolhall::net
