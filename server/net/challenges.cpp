#include "server/net/challenges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace poolhall::net {

using protocol::ChallengeId;
using protocol::Error;
using protocol::ErrorCode;
using std::chrono::steady_clock;

namespace {

constexpr std::string_view house_prefix = "house:";
// How long the answer to a challenge is remembered for who asks again.
constexpr std::chrono::minutes memory{10};
constexpr std::chrono::hours longest_clock{24};
constexpr std::size_t games_bound = 256;   // of one agent at a time
constexpr std::size_t offers_bound = 64;   // of one agent that wait for an answer
constexpr std::size_t memory_bound = 256;  // challenges of one agent

Error other_content() {
  return {ErrorCode::conflicting_request, "/params/challenge_id",
          "the same challenge_id was sent with another content"};
}

// What a challenge can ask for; the rest of the terms is the server's.
bool same_wish(const storage::TermsRecord& one, const storage::TermsRecord& other) {
  return one.rules == other.rules && one.noise == other.noise && one.clock == other.clock &&
         one.increment == other.increment && one.shot_cap == other.shot_cap;
}

std::string request_key(storage::AgentId from, const protocol::ShotId& id) {
  return fmt::format("{}:{}", storage::number(from), id.json);
}

}  // namespace

Challenges::Challenges(GameServices& services, Matches& matches, Outside outside)
    : services_(services),
      matches_(matches),
      outside_(std::move(outside)),
      next_id_(storage::number(storage::unix_now()) / 1'000) {}

void Challenges::challenge(const Asker& asker, storage::AgentId from,
                           const protocol::Challenge& request) {
  if (!request.challenge_id) {
    make(asker, from, request);
    return;
  }
  if (repeats(asker, from, request)) {
    return;
  }
  using Result = storage::Expected<std::optional<storage::MatchRecord>>;
  services_.archive.read(
      [key = request_key(from, *request.challenge_id)](storage::Reader& reader) {
        return reader.match_requested(key);
      },
      [this, asker, from, request](const Result& found) {
        if (!found) {
          asker.refuse(
              {ErrorCode::paused, "", "the database cannot be read: " + found.error().reason});
        } else if (*found) {
          repeats_match(asker, from, request, **found);
        } else if (!repeats(asker, from, request)) {  // it may have come again meanwhile
          make(asker, from, request);
        }
      });
}

void Challenges::make(const Asker& asker, storage::AgentId from,
                      const protocol::Challenge& request) {
  const auto terms = terms_of_request(request);
  if (!terms) {
    asker.refuse(terms.error());
    return;
  }
  if (outside_.games_of(from) >= games_bound) {
    asker.refuse(
        {ErrorCode::rate_limited, "", fmt::format("{} of your games go on already", games_bound)});
    return;
  }
  const auto opponent = opponent_of(from, request.opponent);
  if (!opponent) {
    asker.refuse(opponent.error());
    return;
  }
  if (!has_room(from)) {
    asker.refuse({ErrorCode::rate_limited, "",
                  fmt::format("{} of your challenges are under way", memory_bound)});
    return;
  }
  const ChallengeId id{next_id_++};
  Entry& entry = entries_[id];
  made_by_[from].insert(id);
  entry.request = request;
  entry.from = from;
  entry.to = *opponent;
  entry.terms = *terms;
  if (request.challenge_id) {
    by_key_[{from, request.challenge_id->json}] = id;
  }
  if (request.opponent.starts_with(house_prefix)) {
    begin(id, asker);
  } else {
    offer(id, entry, asker);
  }
}

// The same challenge_id again: the same answer, or a conflict.
bool Challenges::repeats(const Asker& asker, storage::AgentId from,
                         const protocol::Challenge& request) {
  const auto found = by_key_.find({from, request.challenge_id->json});
  if (found == by_key_.end()) {
    return false;
  }
  Entry& entry = entries_.at(found->second);
  if (!(entry.request == request)) {
    asker.refuse(other_content());
  } else if (entry.state == State::starting) {
    entry.askers.push_back(asker);
  } else {
    reply(asker, found->second, entry);
  }
  return true;
}

void Challenges::repeats_match(const Asker& asker, storage::AgentId from,
                               const protocol::Challenge& request,
                               const storage::MatchRecord& match) const {
  const Agent* opponent = services_.book.find(match.agents[1]);
  bool same_opponent = false;
  if (request.opponent.starts_with(house_prefix)) {
    same_opponent = opponent != nullptr &&
                    opponent->record.house_bot == request.opponent.substr(house_prefix.size());
  } else {
    same_opponent = opponent != nullptr && opponent == services_.book.named(request.opponent);
  }
  const auto terms = terms_of_request(request);
  if (match.agents[0] == from && same_opponent && terms && same_wish(*terms, match.terms)) {
    asker.reply(
        protocol::ChallengeReply{match.challenge.value_or(ChallengeId{protocol::number(match.id)}),
                                 protocol::ChallengeStatus::accepted, match.id});
  } else {
    asker.refuse(other_content());
  }
}

protocol::Expected<storage::TermsRecord> Challenges::terms_of_request(
    const protocol::Challenge& request) const {
  storage::TermsRecord terms;
  terms.rules = request.rules.value_or(terms.rules);
  terms.noise = request.noise.value_or(terms.noise);
  terms.max_refusals = services_.limits.max_refusals;
  terms.lag_per_turn = services_.limits.lag_credit_per_turn;
  terms.lag_per_game = services_.limits.lag_credit_per_game;
  const auto clock = request.clock.value_or(clock_settings_of(terms));
  const auto longest = std::chrono::milliseconds{longest_clock}.count();
  const auto refused = [longest](std::string_view field, std::int64_t came, std::int64_t least) {
    return tl::unexpected(Error{ErrorCode::invalid_params, fmt::format("/params/clock/{}", field),
                                fmt::format("got {}, expected {} to {} ms", came, least, longest)});
  };
  if (clock.game_ms < 1 || clock.game_ms > longest) {
    return refused("game_ms", clock.game_ms, 1);
  }
  if (clock.increment_ms < 0 || clock.increment_ms > longest) {
    return refused("increment_ms", clock.increment_ms, 0);
  }
  if (clock.shot_ms && (*clock.shot_ms < 1 || *clock.shot_ms > longest)) {
    return refused("shot_ms", *clock.shot_ms, 1);
  }
  terms.clock = std::chrono::milliseconds{clock.game_ms};
  terms.increment = std::chrono::milliseconds{clock.increment_ms};
  if (clock.shot_ms) {
    terms.shot_cap = std::chrono::milliseconds{*clock.shot_ms};
  }
  return terms;
}

protocol::Expected<storage::AgentId> Challenges::opponent_of(storage::AgentId from,
                                                             const std::string& name) const {
  const auto unknown = [&](std::string_view expected) {
    return tl::unexpected(Error{ErrorCode::unknown_agent, "/params/opponent",
                                fmt::format("got \"{}\", expected {}", name, expected)});
  };
  if (name.starts_with(house_prefix)) {
    const auto agent = outside_.house_agent(from, name.substr(house_prefix.size()));
    if (!agent) {
      return unknown(agent.error());
    }
    return *agent;
  }
  const Agent* agent = services_.book.named(name);
  if (agent == nullptr || !agent->session.lock()) {
    return unknown("the name of an agent that is here");
  }
  if (agent->id() == from) {
    return unknown("another agent than yourself");
  }
  const auto own = made_by_.find(from);
  const auto waiting =
      own == made_by_.end()
          ? 0
          : std::count_if(own->second.begin(), own->second.end(), [&](const ChallengeId id) {
              return entries_.at(id).state == State::offered;
            });
  if (static_cast<std::size_t>(waiting) >= offers_bound) {
    return tl::unexpected(Error{ErrorCode::rate_limited, "",
                                fmt::format("{} of your offers wait already", offers_bound)});
  }
  return agent->id();
}

void Challenges::offer(ChallengeId id, Entry& entry, const Asker& asker) {
  offered_to_[entry.to].insert(id);
  entry.expires = steady_clock::now() + services_.limits.challenge_expiry;
  entry.expiry = services_.deadlines.at(entry.expires, [this, id] { expire(id); });
  reply(asker, id, entry);
  push(entry.to, offer_of(id, entry));
}

protocol::ChallengeOffer Challenges::offer_of(ChallengeId id, const Entry& entry) const {
  protocol::ChallengeOffer offer;
  offer.challenge = id;
  offer.from = services_.book.name_of(entry.from);
  offer.rules = entry.terms.rules;
  offer.noise = entry.terms.noise;
  offer.clock = clock_settings_of(entry.terms);
  offer.expires_ms = services_.time.ms(entry.expires);
  return offer;
}

Challenges::Entry* Challenges::addressed_to(const Asker& asker, storage::AgentId by,
                                            ChallengeId id) {
  const auto found = entries_.find(id);
  if (found == entries_.end() || found->second.to != by) {
    asker.refuse({ErrorCode::unknown_challenge, "/params/challenge",
                  fmt::format("got {}, which is no offer to you", number(id))});
    return nullptr;
  }
  return &found->second;
}

void Challenges::accept(const Asker& asker, storage::AgentId by, ChallengeId id) {
  Entry* entry = addressed_to(asker, by, id);
  if (entry == nullptr) {
    return;
  }
  if (entry->state == State::offered) {
    begin(id, asker);
  } else if (entry->state == State::starting) {
    entry->askers.push_back(asker);
  } else if (entry->state == State::accepted) {
    reply(asker, id, *entry);
  } else {
    asker.refuse({ErrorCode::conflicting_request, "/params/challenge",
                  "the offer was declined or has expired"});
  }
}

void Challenges::decline(const Asker& asker, storage::AgentId by, ChallengeId id) {
  Entry* entry = addressed_to(asker, by, id);
  if (entry == nullptr) {
    return;
  }
  if (entry->state != State::offered && entry->state != State::declined) {
    asker.refuse({ErrorCode::conflicting_request, "/params/challenge",
                  "the offer was accepted or has expired"});
    return;
  }
  const bool first_time = entry->state == State::offered;
  set_state(id, *entry, State::declined);
  reply(asker, id, *entry);
  if (first_time) {
    push(entry->from, protocol::ChallengeOver{id, protocol::ChallengeOutcome::declined});
    forget_later(id);
  }
}

void Challenges::begin(ChallengeId id, const Asker& asker) {
  Entry& entry = entries_.at(id);
  set_state(id, entry, State::starting);
  entry.askers.push_back(asker);
  entry.expiry.cancel();
  MatchPlan plan;
  plan.agents = {entry.from, entry.to};
  plan.terms = entry.terms;
  plan.seed = random_seed();
  plan.challenge = id;
  if (entry.request.challenge_id) {
    plan.request = request_key(entry.from, *entry.request.challenge_id);
  }
  matches_.start(plan,
                 [this, id](const protocol::Expected<MatchId>& match) { started(id, match); });
}

void Challenges::started(ChallengeId id, const protocol::Expected<MatchId>& match) {
  Entry& entry = entries_.at(id);
  const auto askers = std::exchange(entry.askers, {});
  if (!match) {
    for (const Asker& asker : askers) {
      asker.refuse(match.error());
    }
    forget(id);
    return;
  }
  set_state(id, entry, State::accepted);
  entry.match = *match;
  for (const Asker& asker : askers) {
    reply(asker, id, entry);
  }
  if (!entry.request.opponent.starts_with(house_prefix)) {
    push(entry.from, protocol::ChallengeOver{id, protocol::ChallengeOutcome::accepted});
  }
  forget_later(id);
}

void Challenges::expire(ChallengeId id) {
  Entry& entry = entries_.at(id);
  set_state(id, entry, State::expired);
  for (const storage::AgentId agent : {entry.from, entry.to}) {
    push(agent, protocol::ChallengeOver{id, protocol::ChallengeOutcome::expired});
  }
  forget_later(id);
}

void Challenges::set_state(ChallengeId id, Entry& entry, State state) {
  entry.state = state;
  const auto offered = offered_to_.find(entry.to);
  if (offered != offered_to_.end() && offered->second.erase(id) > 0 && offered->second.empty()) {
    offered_to_.erase(offered);
  }
}

void Challenges::forget_later(ChallengeId id) {
  entries_.at(id).expiry =
      services_.deadlines.at(steady_clock::now() + memory, [this, id] { forget(id); });
}

void Challenges::forget(ChallengeId id) {
  const Entry& entry = entries_.at(id);
  if (entry.request.challenge_id) {
    by_key_.erase({entry.from, entry.request.challenge_id->json});
  }
  const auto own = made_by_.find(entry.from);
  own->second.erase(id);
  if (own->second.empty()) {
    made_by_.erase(own);
  }
  entries_.erase(id);
}

bool Challenges::has_room(storage::AgentId from) {
  const auto own = made_by_.find(from);
  if (own == made_by_.end() || own->second.size() < memory_bound) {
    return true;
  }
  const auto done = std::find_if(own->second.begin(), own->second.end(), [&](ChallengeId id) {
    const State state = entries_.at(id).state;
    return state != State::offered && state != State::starting;
  });
  if (done == own->second.end()) {
    return false;
  }
  forget(*done);
  return true;
}

void Challenges::agent_came(storage::AgentId agent) {
  const auto offered = offered_to_.find(agent);
  if (offered == offered_to_.end()) {
    return;
  }
  for (const ChallengeId id : offered->second) {
    push(agent, offer_of(id, entries_.at(id)));
  }
}

void Challenges::reply(const Asker& asker, ChallengeId id, const Entry& entry) const {
  using Status = protocol::ChallengeStatus;
  const Status status = entry.state == State::accepted  ? Status::accepted
                        : entry.state == State::offered ? Status::offered
                                                        : Status::declined;
  asker.reply(protocol::ChallengeReply{id, status, entry.match});
}

void Challenges::push(storage::AgentId agent, const Notification& notification) const {
  const Agent* known = services_.book.find(agent);
  if (const auto session = known != nullptr ? known->session.lock() : nullptr) {
    session->push(notification);
  }
}

}  // namespace poolhall::net
