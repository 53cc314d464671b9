// The part of Tournaments that knows who plays: entries of files, of agents that join and leave by
// themselves, and of the host's calls.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/net/tournaments.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;
using settings::name_key;

namespace {

bool goes_on(TournamentStatus status) {
  return status == TournamentStatus::running || status == TournamentStatus::paused;
}

Error closed(std::string reason) {
  return {ErrorCode::tournament_closed, "/params/tournament", std::move(reason)};
}

}  // namespace

void Tournaments::enter(const TournamentEntry& entry) {
  const auto found = tournaments_.find(entry.tournament);
  if (found == tournaments_.end()) {
    spdlog::error("entry {}: there is no tournament {}", entry.name, entry.tournament);
    return;
  }
  if (entry.house_bot || entry.command) {
    Agent& agent = house_(entry.name, {.bot = entry.house_bot.value_or("command"),
                                       .options = entry.house_options,
                                       .command = entry.command});
    house_entries_[agent.id()] = entry;
    add_entry(found->second, agent.id());
  } else if (const Agent* agent = services_.book.named(entry.name)) {
    add_entry(found->second, agent->id());
  } else if (awaited(entry.tournament, entry.name) == awaited_entries_.end()) {
    awaited_entries_.push_back(entry);
  }
}

Tournaments::Awaited::iterator Tournaments::awaited(const std::string& tournament,
                                                    const std::string& name) {
  return std::find_if(
      awaited_entries_.begin(), awaited_entries_.end(), [&](const TournamentEntry& entry) {
        return entry.tournament == tournament && name_key(entry.name) == name_key(name);
      });
}

void Tournaments::agent_enrolled() {
  const auto entries = std::exchange(awaited_entries_, {});
  for (const TournamentEntry& entry : entries) {
    enter(entry);  // who is not known yet, waits again
  }
  const auto orders = std::exchange(awaited_orders_, {});
  for (const auto& [key, order] : orders) {
    start_match(order);
  }
}

storage::EntryRecord* Tournaments::entry_in(Tournament& tournament, storage::AgentId agent) {
  const auto found =
      std::find_if(tournament.entered.begin(), tournament.entered.end(),
                   [agent](const storage::EntryRecord& entry) { return entry.agent == agent; });
  return found == tournament.entered.end() ? nullptr : &*found;
}

storage::EntryRecord Tournaments::new_entry(const Tournament& tournament,
                                            storage::AgentId agent) const {
  storage::EntryRecord record;
  record.tournament = tournament.record.id;
  record.agent = agent;
  record.place = tournament.entered.empty() ? 0 : tournament.entered.back().place + 1;
  if (goes_on(tournament.record.status)) {
    record.from_round = tournament.intake.late_round.value_or(0);
  }
  return record;
}

// Of the tournament's file; its rounds are all of them.
void Tournaments::add_entry(Tournament& tournament, storage::AgentId agent) {
  if (entry_in(tournament, agent) != nullptr) {
    return;
  }
  storage::EntryRecord record = new_entry(tournament, agent);
  record.from_round = 0;
  tournament.entered.push_back(record);
  store([record](storage::Database& database) { return database.add_entry(record); },
        "an entry of tournament " + record.tournament);
}

TournamentEntry Tournaments::entry_of(const storage::EntryRecord& record) const {
  TournamentEntry entry;
  const auto house = house_entries_.find(record.agent);
  if (house != house_entries_.end()) {
    entry = house->second;
  } else {
    entry.name = services_.book.name_of(record.agent);
    if (const Agent* known = services_.book.find(record.agent)) {
      entry.house_bot = known->record.house_bot;
    }
  }
  entry.tournament = record.tournament;
  entry.from_round = record.from_round;
  entry.until_round = record.until_round;
  return entry;
}

std::vector<TournamentEntry> Tournaments::entries(const std::string& tournament) const {
  std::vector<TournamentEntry> list;
  const auto found = tournaments_.find(tournament);
  if (found == tournaments_.end()) {
    return list;
  }
  for (const storage::EntryRecord& entry : found->second.entered) {
    list.push_back(entry_of(entry));
  }
  std::copy_if(awaited_entries_.begin(), awaited_entries_.end(), std::back_inserter(list),
               [&](const TournamentEntry& entry) { return entry.tournament == tournament; });
  return list;
}

void Tournaments::set_intake(const std::string& tournament, const Intake& intake) {
  if (const auto found = tournaments_.find(tournament); found != tournaments_.end()) {
    found->second.intake = intake;
  }
}

void Tournaments::on_entries_changed(std::function<void(const std::string&)> callback) {
  on_entries_changed_ = std::move(callback);
}

bool Tournaments::has_left(const std::string& tournament, storage::AgentId agent) const {
  const auto found = tournaments_.find(tournament);
  return found != tournaments_.end() &&
         std::any_of(found->second.entered.begin(), found->second.entered.end(),
                     [agent](const storage::EntryRecord& entry) {
                       return entry.agent == agent && entry.withdrawn();
                     });
}

std::optional<Error> Tournaments::why_not_enter(const Tournament& tournament) const {
  const TournamentStatus status = tournament.record.status;
  if (status != TournamentStatus::open && !goes_on(status)) {
    return closed(fmt::format("the tournament is {}", storage::name(status)));
  }
  if (tournament.listing.format == "sprt") {
    return closed("an SPRT is between the two of its file");
  }
  if (goes_on(status) && !tournament.intake.late_round) {
    return closed(fmt::format("the tournament has begun, and a {} takes no entries any more",
                              tournament.listing.format));
  }
  if (entries(tournament.record.id).size() >= settings::max_entries) {
    return closed(fmt::format("the tournament is full: {} entries", settings::max_entries));
  }
  return std::nullopt;
}

std::optional<Error> Tournaments::why_not_join(const Tournament& tournament) const {
  if (tournament.joining == settings::Joining::never) {
    return closed("the tournament is for the entries of its file (join = \"never\")");
  }
  if (tournament.joining == settings::Joining::start && goes_on(tournament.record.status)) {
    return closed("the tournament has begun (join = \"start\")");
  }
  return why_not_enter(tournament);
}

void Tournaments::join(const Asker& asker, storage::AgentId agent, protocol::TournamentId id) {
  Tournament* tournament = find(asker, id);
  if (tournament == nullptr) {
    return;
  }
  const storage::EntryRecord* known = entry_in(*tournament, agent);
  const bool is_in = known != nullptr && !known->withdrawn();
  if (const auto refusal = is_in ? std::nullopt : why_not_join(*tournament)) {
    asker.refuse(*refusal);
    return;
  }
  admit(*tournament, agent, [asker, id](const protocol::Expected<void>& done) {
    if (done) {
      asker.reply(protocol::TournamentReply{id, protocol::Membership::joined});
    } else {
      asker.refuse(done.error());
    }
  });
}

void Tournaments::leave(const Asker& asker, storage::AgentId agent, protocol::TournamentId id) {
  Tournament* tournament = find(asker, id);
  if (tournament == nullptr) {
    return;
  }
  withdraw(*tournament, agent, [asker, id](const protocol::Expected<void>& done) {
    if (done) {
      asker.reply(protocol::TournamentReply{id, protocol::Membership::left});
    } else {
      asker.refuse(done.error());
    }
  });
}

void Tournaments::admit(Tournament& tournament, storage::AgentId agent, const Done& then) {
  storage::EntryRecord* known = entry_in(tournament, agent);
  if (known != nullptr && !known->withdrawn()) {
    store_change([](storage::Database&) { return storage::Expected<void>{}; }, [] {}, then);
    return;
  }
  if (known != nullptr && goes_on(tournament.record.status)) {
    then(tl::unexpected(closed("who has left a tournament that goes on does not come back")));
    return;
  }
  const storage::EntryRecord record = known == nullptr ? new_entry(tournament, agent) : *known;
  const auto undo = [this, id = tournament.record.id, agent, record] {
    Tournament& here = tournaments_.at(id);
    storage::EntryRecord* entry = entry_in(here, agent);
    if (record.withdrawn()) {
      *entry = record;
    } else {
      here.entered.erase(here.entered.begin() + (entry - here.entered.data()));
    }
    tell_entries_changed(here);
  };
  if (known == nullptr) {
    tournament.entered.push_back(record);
    store_change([record](storage::Database& database) { return database.add_entry(record); }, undo,
                 then);
  } else {
    known->until_round.reset();
    store_change(
        [back = *known](storage::Database& database) { return database.update_entry(back); }, undo,
        then);
  }
  tell_entries_changed(tournament);
}

void Tournaments::withdraw(Tournament& tournament, storage::AgentId agent, const Done& then) {
  storage::EntryRecord* known = entry_in(tournament, agent);
  const TournamentStatus status = tournament.record.status;
  if (known == nullptr || known->withdrawn()) {
    store_change([](storage::Database&) { return storage::Expected<void>{}; }, [] {}, then);
    return;
  }
  if (status != TournamentStatus::open && !goes_on(status)) {
    then(tl::unexpected(closed(fmt::format("the tournament is {}", storage::name(status)))));
    return;
  }
  known->until_round = goes_on(status) ? tournament.intake.next_round : 0;
  spdlog::info("tournament {}: {} leaves", tournament.record.id, services_.book.name_of(agent));
  store_change([gone = *known](storage::Database& database) { return database.update_entry(gone); },
               [this, id = tournament.record.id, agent] {
                 Tournament& here = tournaments_.at(id);
                 entry_in(here, agent)->until_round.reset();
                 tell_entries_changed(here);
               },
               then);
  if (goes_on(status)) {
    forfeit_games_(tournament.record.id, agent);
  }
  tell_entries_changed(tournament);
}

void Tournaments::tell_entries_changed(const Tournament& tournament) {
  if (goes_on(tournament.record.status) && on_entries_changed_) {
    on_entries_changed_(tournament.record.id);
  }
}

// What is done in memory counts from now on, for what is decided next is stored after it. `undo`
// is for a database that does not take it.
void Tournaments::store_change(storage::Writer::Work work, const std::function<void()>& undo,
                               const Done& then) {
  const auto posted =
      services_.writer.post(std::move(work), [undo, then](const storage::Expected<void>& stored) {
        if (stored) {
          then({});
        } else {
          undo();
          then(tl::unexpected(Error{ErrorCode::internal, "", stored.error().reason}));
        }
      });
  if (posted != storage::Posted::accepted) {
    boost::asio::post(services_.io, [undo, then] {
      undo();
      then(
          tl::unexpected(Error{ErrorCode::paused, "", "the database takes nothing at the moment"}));
    });
  }
}

void Tournaments::host_enters(const std::string& tournament, const std::string& name,
                              const Done& then) {
  Tournament& here = tournaments_.at(tournament);
  const Agent* agent = services_.book.named(name);
  if (agent == nullptr) {
    then(tl::unexpected(
        Error{ErrorCode::unknown_agent, "/agent", fmt::format("there is no agent \"{}\"", name)}));
    return;
  }
  const storage::EntryRecord* known = entry_in(here, agent->id());
  const bool is_in = known != nullptr && !known->withdrawn();
  if (const auto refusal = is_in ? std::nullopt : why_not_enter(here)) {
    then(tl::unexpected(*refusal));
    return;
  }
  admit(here, agent->id(), then);
}

void Tournaments::host_withdraws(const std::string& tournament, const std::string& name,
                                 const Done& then) {
  Tournament& here = tournaments_.at(tournament);
  const Agent* agent = services_.book.named(name);
  const auto waits = awaited(tournament, name);
  if (agent == nullptr && waits != awaited_entries_.end()) {
    agent = &stand_in_(std::string{waits->name});
    agent_enrolled();
  }
  if (agent == nullptr || entry_in(here, agent->id()) == nullptr) {
    then(tl::unexpected(
        Error{ErrorCode::unknown_agent, "/agent",
              fmt::format("\"{}\" is no entry of tournament \"{}\"", name, tournament)}));
    return;
  }
  withdraw(here, agent->id(), then);
}

}  // namespace poolhall::net
