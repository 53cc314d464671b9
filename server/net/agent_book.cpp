#include "server/net/agent_book.hpp"

#include <algorithm>
#include <cstring>

#include "server/settings/tournament_settings.hpp"

namespace poolhall::net {

namespace {

std::uint64_t prefix(const TokenHash& hash) {
  std::uint64_t value = 0;
  std::memcpy(&value, hash.data(), sizeof value);
  return value;
}

}  // namespace

void Commitments::add(const storage::Digest& commitment, const std::shared_ptr<Session>& session) {
  if (session_.lock() != session) {
    waiting_.clear();
    session_ = session;
  }
  if (std::find(waiting_.begin(), waiting_.end(), commitment) != waiting_.end()) {
    return;
  }
  if (waiting_.size() == most) {
    waiting_.pop_front();
  }
  waiting_.push_back(commitment);
}

std::optional<storage::Digest> Commitments::take() {
  if (waiting_.empty()) {
    return std::nullopt;
  }
  const storage::Digest first = waiting_.front();
  waiting_.pop_front();
  return first;
}

Agent& AgentBook::add(storage::AgentRecord record) {
  auto agent = std::make_unique<Agent>();
  agent->record = std::move(record);
  Agent& added = *agent;
  by_id_.emplace(storage::number(added.id()), std::move(agent));
  by_name_.emplace(settings::name_key(added.record.name), &added);
  by_token_.emplace(prefix(added.record.token_hash), &added);
  return added;
}

void AgentBook::remove(storage::AgentId id) {
  const auto found = by_id_.find(storage::number(id));
  if (found == by_id_.end()) {
    return;
  }
  Agent* const agent = found->second.get();
  by_name_.erase(settings::name_key(agent->record.name));
  std::erase_if(by_token_, [agent](const auto& entry) { return entry.second == agent; });
  by_id_.erase(found);
}

void AgentBook::set_token(Agent& agent, const TokenHash& hash) {
  const auto [first, last] = by_token_.equal_range(prefix(agent.record.token_hash));
  for (auto entry = first; entry != last; ++entry) {
    if (entry->second == &agent) {
      by_token_.erase(entry);
      break;
    }
  }
  agent.record.token_hash = hash;
  by_token_.emplace(prefix(hash), &agent);
}

Agent* AgentBook::find(storage::AgentId id) {
  const auto found = by_id_.find(storage::number(id));
  return found == by_id_.end() ? nullptr : found->second.get();
}

Agent* AgentBook::named(std::string_view name) {
  const auto found = by_name_.find(settings::name_key(name));
  return found == by_name_.end() ? nullptr : found->second;
}

Agent* AgentBook::with_token(const TokenHash& hash) {
  Agent* found = nullptr;
  const auto [first, last] = by_token_.equal_range(prefix(hash));
  for (auto entry = first; entry != last; ++entry) {
    if (same(entry->second->record.token_hash, hash)) {
      found = entry->second;
    }
  }
  return found;
}

const std::string& AgentBook::name_of(storage::AgentId id) const {
  static const std::string unknown = "?";
  const auto found = by_id_.find(storage::number(id));
  return found == by_id_.end() ? unknown : found->second->record.name;
}

void AgentBook::for_each(const std::function<void(Agent&)>& visit) {
  for (auto& [id, agent] : by_id_) {
    visit(*agent);
  }
}

TokenHash unclaimed(storage::AgentId agent) {
  TokenHash hash{};
  const std::int64_t id = storage::number(agent);
  std::memcpy(hash.data() + hash.size() - sizeof id, &id, sizeof id);
  return hash;
}

bool is_unclaimed(const TokenHash& hash) {
  return std::all_of(hash.begin(), hash.end() - sizeof(std::int64_t),
                     [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace poolhall::net
