// The part of Arena at the door: registration, login, takeover, and what a new session must know.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <tuple>
#include <utility>

#include "server/net/arena.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;
using std::chrono::steady_clock;

namespace {

// A token that nobody has: its owner gets another from employ().
TokenHash nobody() {
  return hash_of(new_token());
}

Error bad_name(const protocol::Limits& limits) {
  return {ErrorCode::bad_name, "/params/name",
          fmt::format("expected 1 to {} characters of [A-Za-z0-9._-], not . or .. alone",
                      limits.name_length)};
}

Error not_enrolled(const storage::StorageError& error) {
  const bool passes = storage::may_pass(error.fault);
  return {passes ? ErrorCode::paused : ErrorCode::internal, "", error.reason};
}

}  // namespace

std::optional<Error> Arena::why_not(const protocol::Register& request) const {
  if (stage_ != Stage::running) {
    return Error{ErrorCode::shutting_down, "", "the server stops; come back later"};
  }
  if (settings_.registration == Registration::closed) {
    return Error{ErrorCode::registration_closed, "",
                 "agents are added by the host; ask for a token"};
  }
  if (!protocol::is_agent_name(request.name, settings_.limits)) {
    return bad_name(settings_.limits);
  }
  return std::nullopt;
}

void Arena::enroll(const std::shared_ptr<Session>& session, const protocol::Register& request) {
  if (const auto error = why_not(request)) {
    session->not_admitted(*error);
    return;
  }
  Agent* known = book_.named(request.name);
  const std::string token = request.token ? request.token->text : new_token();
  if (known != nullptr && same(known->record.token_hash, hash_of(token))) {
    let_in(session, known->id(), request.token);  // whose first reply was lost
    return;
  }
  if (const auto error =
          visitors_.registers(session->connection().address(), steady_clock::now())) {
    session->not_admitted(*error);
    return;
  }
  enroll_agent(request.name, hash_of(token),
               [this, session, token](const protocol::Expected<storage::AgentId>& agent) {
                 if (agent) {
                   let_in(session, *agent, protocol::Hex256{token});
                 } else {
                   session->not_admitted(agent.error());
                   session->resume();
                 }
               });
}

void Arena::add_agent(const std::string& name,
                      std::function<void(const protocol::Expected<std::string>&)> then) {
  if (!protocol::is_agent_name(name, settings_.limits)) {
    then(tl::unexpected(bad_name(settings_.limits)));
    return;
  }
  const std::string token = new_token();
  enroll_agent(name, hash_of(token),
               [token, then = std::move(then)](const protocol::Expected<storage::AgentId>& agent) {
                 if (agent) {
                   then(token);
                 } else {
                   then(tl::unexpected(agent.error()));
                 }
               });
}

// A new agent, or the owner of a name that a tournament has waited for.
void Arena::enroll_agent(const std::string& name, const TokenHash& token, Enrolled then) {
  Agent* known = book_.named(name);
  if (known != nullptr && known->stored && is_unclaimed(known->record.token_hash)) {
    claim(*known, token, std::move(then));
    return;
  }
  if (known != nullptr) {
    then(tl::unexpected(Error{ErrorCode::name_taken, "/params/name",
                              fmt::format("\"{}\" is another agent's name", name)}));
    return;
  }
  if (book_.with_token(token) != nullptr) {
    then(tl::unexpected(Error{ErrorCode::conflicting_request, "/params/token",
                              "this token belongs to an agent of another name"}));
    return;
  }
  storage::AgentRecord record = new_record(name);
  record.token_hash = token;
  book_.add(record).stored = false;
  store_enrolment([record](storage::Database& database) { return database.add_agent(record); },
                  record.id,
                  [this, id = record.id, then](const storage::Expected<void>& stored) {
                    if (!stored) {
                      book_.remove(id);
                      then(tl::unexpected(not_enrolled(stored.error())));
                      return;
                    }
                    book_.find(id)->stored = true;
                    untold_.is_new(id);
                    then(id);
                    tournaments_.agent_enrolled();
                  });
}

void Arena::claim(Agent& agent, const TokenHash& token, Enrolled then) {
  agent.stored = false;
  const storage::AgentId id = agent.id();
  store_enrolment(
      [id, token](storage::Database& database) { return database.set_agent_token(id, token); }, id,
      [this, id, token, then](const storage::Expected<void>& stored) {
        Agent& claimed = *book_.find(id);
        claimed.stored = true;
        if (!stored) {
          then(tl::unexpected(not_enrolled(stored.error())));
          return;
        }
        book_.set_token(claimed, token);
        then(id);
      });
}

void Arena::store_enrolment(storage::Writer::Work work, storage::AgentId agent,
                            storage::Writer::Done done) {
  if (services_.writer.post(std::move(work), done) != storage::Posted::accepted) {
    spdlog::warn("agent {} cannot be stored now", storage::number(agent));
    done(tl::unexpected(storage::StorageError{storage::StorageFault::busy,
                                              "the database takes nothing at the moment"}));
  }
}

storage::AgentRecord Arena::new_record(const std::string& name) {
  storage::AgentRecord record;
  record.id = ids_.agent;
  ids_.agent = storage::AgentId{storage::number(ids_.agent) + 1};
  record.name = name;
  record.created = storage::unix_now();
  return record;
}

// An agent of the server's own making: known at once, stored as soon as may be.
Agent& Arena::make_agent(const storage::AgentRecord& record) {
  Agent& agent = book_.add(record);
  const auto posted = services_.writer.post(
      [record](storage::Database& database) { return database.add_agent(record); },
      [name = record.name](const storage::Expected<void>& stored) {
        if (!stored) {
          spdlog::error("agent {} cannot be stored: {}", name, stored.error().reason);
        }
      });
  if (posted != storage::Posted::accepted) {
    spdlog::error("agent {} cannot be stored: the database takes nothing", record.name);
  }
  return agent;
}

Agent& Arena::stand_in(const std::string& name) {
  storage::AgentRecord record = new_record(name);
  record.token_hash = unclaimed(record.id);
  return make_agent(record);
}

void Arena::admit(const std::shared_ptr<Session>& session, const protocol::Login& request) {
  const Agent* agent = book_.with_token(hash_of(request.token.text));
  if (agent == nullptr) {
    session->not_admitted({ErrorCode::unauthorized, "/params/token", "no agent has this token"});
    return;
  }
  let_in(session, agent->id(), std::nullopt);
}

// Reads first what this agent has not acknowledged since before the server started.
void Arena::let_in(const std::shared_ptr<Session>& session, storage::AgentId agent,
                   std::optional<protocol::Hex256> token) {
  Agent* known = book_.find(agent);
  if (!known->stored) {
    session->not_admitted({ErrorCode::rate_limited, "", "this agent is being stored; ask again"});
    session->resume();
    return;
  }
  untold_.prepare(
      agent, [this, session, agent, token = std::move(token)](const storage::Expected<void>& read) {
        if (read) {
          bind(session, *book_.find(agent), token);
        } else {
          session->not_admitted(
              {ErrorCode::paused, "", "the database cannot be read: " + read.error().reason});
        }
        session->resume();
      });
}

void Arena::bind(const std::shared_ptr<Session>& session, Agent& agent,
                 std::optional<protocol::Hex256> token) {
  if (!session->connection().open()) {
    return;
  }
  const SteadyTime now = steady_clock::now();
  const auto old = agent.session.lock();
  if (old && old->connection().open()) {
    const auto pause = settings_.limits.takeover_interval;
    if (agent.last_login && now - *agent.last_login < pause) {
      session->not_admitted(
          {ErrorCode::rate_limited, "",
           fmt::format("this agent has logged in within the last {} ms", pause.count())});
      return;
    }
    old->close_with(protocol::Superseded{}, "superseded");
  }
  agent.session = session;
  agent.last_login = now;
  protocol::LoginReply reply = login_reply(agent);
  reply.token = std::move(token);
  session->admitted(agent, reply);
  catch_up(session, agent);
}

protocol::LoginReply Arena::login_reply(const Agent& agent) const {
  protocol::LoginReply reply;
  reply.agent = agent.record.name;
  reply.games = untold_.listings(agent.id());
  if (const auto own = games_of_.find(agent.id()); own != games_of_.end()) {
    for (const protocol::GameId id : own->second) {
      const LiveGame* game = live_game(id);
      reply.games.push_back(game->listing_for(*game->seat_of(agent.id())));
    }
  }
  return reply;
}

void Arena::catch_up(const std::shared_ptr<Session>& session, const Agent& agent) {
  untold_.tell(*session, agent.id());
  const auto own = games_of_.find(agent.id());
  if (own != games_of_.end()) {
    const auto games = own->second;
    for (const protocol::GameId id : games) {
      if (LiveGame* game = live_game(id)) {
        game->agent_came(*game->seat_of(agent.id()));
      }
    }
  }
  challenges_.agent_came(agent.id());
}

Agent& Arena::house_agent(const std::string& name, const HousePlayer& player) {
  Agent* agent = book_.named(name);
  if (agent == nullptr) {
    storage::AgentRecord record = new_record(name);
    record.token_hash = nobody();
    record.house_bot = player.bot;
    agent = &make_agent(record);
  } else if (!agent->record.house_bot) {
    spdlog::warn(
        "agent {} is played by the house from now on; its own token is good again "
        "after the next start",
        name);
  }
  bots_.employ(book_, *agent, player);
  // A game that went on when the server stopped may have waited for its player to be known.
  const auto own = games_of_.find(agent->id());
  if (own != games_of_.end()) {
    for (const protocol::GameId id : own->second) {
      bots_.need(id, live_game(id)->record().agents);
    }
  }
  return *agent;
}

std::optional<std::string> Arena::why_no_house_opponent(storage::AgentId from,
                                                        const std::string& bot) const {
  const auto& known = settings_.house_bots;
  if (bots_.bound() == 0) {
    return "the name of an agent: this server employs no house bots (max_house_bots = 0)";
  }
  if (std::find(known.begin(), known.end(), bot) == known.end()) {
    return fmt::format("one of house:{}", fmt::join(known, ", house:"));
  }
  if (bots_.bound() == 1 && bots_.employs(from)) {
    return "the name of another agent: this server plays one house bot at a time "
           "(max_house_bots = 1), and the challenger is one";
  }
  return std::nullopt;
}

// One process a game as long as the bound allows, then the least busy one that has a place; of two
// as busy the one that was chosen longer ago, for a game shows only once it is stored.
tl::expected<storage::AgentId, std::string> Arena::house_opponent(storage::AgentId from,
                                                                  const std::string& bot) {
  if (auto reason = why_no_house_opponent(from, bot)) {
    return tl::unexpected(std::move(*reason));
  }
  std::optional<storage::AgentId> best;
  std::tuple<bool, std::size_t, std::uint64_t> least{};
  for (std::uint32_t number = 1; number <= bots_.bound(); ++number) {
    const std::string name = number == 1 ? "house:" + bot : fmt::format("house:{}.{}", bot, number);
    const Agent* agent = book_.named(name);
    if (agent == nullptr && best && bots_.full()) {
      break;  // one more would wait
    }
    if (agent == nullptr) {
      agent = &house_agent(name, {.bot = bot});
    }
    const auto own = games_of_.find(agent->id());
    const std::tuple busy{bots_.would_wait(agent->id()),
                          own == games_of_.end() ? std::size_t{0} : own->second.size(),
                          house_choices_[agent->id()]};
    if (!best || busy < least) {
      best = agent->id();
      least = busy;
    }
    if (least == std::tuple{false, std::size_t{0}, std::uint64_t{0}}) {
      break;
    }
  }
  house_choices_[*best] = ++house_choice_;
  return *best;
}

}  // namespace poolhall::net
