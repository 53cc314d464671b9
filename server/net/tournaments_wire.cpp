// The part of Tournaments that agents talk to.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/net/finished_games.hpp"
#include "server/net/tournaments.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

constexpr std::size_t listing_bytes = 160;  // without names

protocol::TournamentStatus wire_status(TournamentStatus status) {
  switch (status) {
    case TournamentStatus::open:
      return protocol::TournamentStatus::open;
    case TournamentStatus::running:
      return protocol::TournamentStatus::running;
    case TournamentStatus::paused:
      return protocol::TournamentStatus::paused;
    case TournamentStatus::finished:
      return protocol::TournamentStatus::over;
    case TournamentStatus::aborted:
      break;
  }
  return protocol::TournamentStatus::aborted;
}

}  // namespace

void Tournaments::list(const Asker& asker) const {
  protocol::TournamentListReply reply;
  // Those that are over come last, the latest first, as many as a line holds.
  std::vector<std::pair<const std::string*, const Tournament*>> order;
  for (const auto& [id, tournament] : tournaments_) {
    order.emplace_back(&id, &tournament);
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    const auto rank = [](const Tournament& t) {
      return std::pair{has_ended(t.record.status), -number(t.record.wire_id)};
    };
    return rank(*a.second) < rank(*b.second);
  });
  std::size_t room = services_.limits.server_line_bytes / 2;
  for (const auto& [id, listed] : order) {
    const Tournament& tournament = *listed;
    protocol::TournamentListing listing = tournament.listing;
    listing.status = wire_status(tournament.record.status);
    std::size_t bytes = id->size() + listing_bytes;
    for (const TournamentEntry& entry : entries(*id)) {
      if (entry.until_round) {
        continue;
      }
      bytes += entry.name.size() + 3;
      listing.agents.push_back(entry.name);
    }
    if (bytes > room) {
      break;
    }
    room -= bytes;
    reply.tournaments.push_back(std::move(listing));
  }
  asker.reply(reply);
}

Tournaments::Tournament* Tournaments::find(const Asker& asker, protocol::TournamentId id) {
  for (auto& [name, tournament] : tournaments_) {
    if (tournament.record.wire_id == id) {
      return &tournament;
    }
  }
  asker.refuse({ErrorCode::unknown_tournament, "/params/tournament",
                fmt::format("got {}, which is no tournament", number(id))});
  return nullptr;
}

void Tournaments::announce_end(const std::string& tournament,
                               const std::vector<protocol::StandingRow>& standings) {
  const auto found = tournaments_.find(tournament);
  if (found == tournaments_.end()) {
    return;
  }
  std::vector<storage::AgentId> agents;
  for (const storage::EntryRecord& entry : found->second.entered) {
    agents.push_back(entry.agent);
  }
  std::vector<storage::FinalStanding> rows;
  for (const protocol::StandingRow& row : standings) {
    rows.push_back({row.rank, row.agent, row.points, row.games, row.wins, row.losses, row.draws});
  }
  const protocol::TournamentOver over{found->second.record.wire_id, tournament, standings};
  ++ends_under_way_;
  const auto posted = services_.writer.post(
      [tournament, rows](storage::Database& database) {
        return database.finish_tournament(tournament, rows);
      },
      [this, agents, over](const storage::Expected<void>& stored) {
        if (stored) {
          untold_.tournament_over(agents, over);
        } else {
          spdlog::error("the end of tournament {} cannot be stored: {}", over.name,
                        stored.error().reason);
        }
        --ends_under_way_;
        services_.on_quiet();
      });
  if (posted != storage::Posted::accepted) {
    --ends_under_way_;
    spdlog::error("the end of tournament {} cannot be stored: the database takes nothing",
                  tournament);
  }
}

void Tournaments::acknowledge(const Asker& asker, storage::AgentId agent,
                              protocol::TournamentId id) {
  const Tournament* tournament = find(asker, id);
  if (tournament == nullptr) {
    return;
  }
  if (tournament->record.status != TournamentStatus::finished) {
    asker.refuse({ErrorCode::invalid_params, "/params/tournament",
                  fmt::format("got {}, a tournament that is not over", number(id))});
    return;
  }
  store_acknowledgement(services_.writer, asker, id,
                        [name = tournament->record.id, agent](storage::Database& database) {
                          return database.acknowledge_tournament(name, agent);
                        });
}

}  // namespace poolhall::net
