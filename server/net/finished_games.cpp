#include "server/net/finished_games.hpp"

#include <fmt/format.h>

#include <utility>

#include "server/match/chain.hpp"

namespace poolhall::net {

using protocol::Error;
using protocol::ErrorCode;

namespace {

std::optional<Seat> seat_of(const storage::GameRecord& game, storage::AgentId agent) {
  for (const Seat seat : {Seat::first, Seat::second}) {
    if (game.agents[rules::index(seat)] == agent) {
      return seat;
    }
  }
  return std::nullopt;
}

Error is_over(protocol::GameId game) {
  return {ErrorCode::game_over, "/params/game",
          fmt::format("got {}, a game that is over", number(game)), game};
}

Error unreadable(const storage::StorageError& error, protocol::GameId game) {
  return {ErrorCode::internal, "", "the database cannot be read: " + error.reason, game};
}

}  // namespace

Error unknown_game(protocol::GameId game) {
  return {ErrorCode::unknown_game, "/params/game",
          fmt::format("got {}, which is none of your games", number(game)), game};
}

void FinishedGames::find(const Asker& asker, storage::AgentId agent, protocol::GameId game,
                         std::optional<std::uint32_t> turn,
                         std::function<void(const Found&, Seat seat)> then) {
  using Result = storage::Expected<std::optional<Found>>;
  const auto work = [game, turn](storage::Reader& reader) -> Result {
    const auto record = reader.game(game);
    if (!record || !*record) {
      return record ? Result{std::nullopt} : tl::unexpected(record.error());
    }
    Found found{**record, {}, {}};
    const auto match = reader.match(found.game.match);
    const auto row = reader.turn(game, turn.value_or(found.game.turns));
    if (!match || !row) {
      return tl::unexpected(match ? row.error() : match.error());
    }
    found.match = match->value_or(storage::MatchRecord{});
    found.turn = *row;
    return found;
  };
  services_.archive.read(work, [asker, agent, game, then = std::move(then)](const Result& found) {
    if (!found) {
      asker.refuse(unreadable(found.error(), game));
      return;
    }
    const auto seat = *found ? seat_of((*found)->game, agent) : std::nullopt;
    if (!seat) {
      asker.refuse(unknown_game(game));
      return;
    }
    then(**found, *seat);
  });
}

void FinishedGames::repeat(const Asker& asker, storage::AgentId agent,
                           const std::variant<protocol::Shot, protocol::Decide>& what) {
  const auto* shot = std::get_if<protocol::Shot>(&what);
  const protocol::GameId game = shot != nullptr ? shot->game : std::get<1>(what).game;
  const std::uint32_t turn = shot != nullptr ? shot->turn : std::get<1>(what).turn;
  find(asker, agent, game, turn, [asker, what](const Found& found, Seat seat) {
    if (found.turn) {
      answer_from_row(*found.turn, asker, seat, what);
    } else {
      asker.refuse(is_over(found.game.id));
    }
  });
}

void FinishedGames::concede(const Asker& asker, storage::AgentId agent, protocol::GameId game) {
  find(asker, agent, game, std::nullopt, [asker](const Found& found, Seat seat) {
    if (found.turn && found.turn->action == storage::TurnAction::concession &&
        found.turn->seat == seat) {
      asker.reply(protocol::GameReply{found.game.id});
    } else {
      asker.refuse(is_over(found.game.id));
    }
  });
}

void FinishedGames::too_late(const Asker& asker, storage::AgentId agent, protocol::GameId game) {
  find(asker, agent, game, std::nullopt,
       [asker](const Found& found, Seat) { asker.refuse(is_over(found.game.id)); });
}

void FinishedGames::sync(const Asker& asker, storage::AgentId agent, protocol::GameId game) {
  find(asker, agent, game, std::nullopt,
       [this, asker](const Found& found, Seat seat) { reply_sync(asker, found, seat); });
}

void FinishedGames::reply_sync(const Asker& asker, const Found& found, Seat seat) const {
  const auto board = match::preset_board(found.game.terms.table, found.game.terms.materials);
  if (!board) {
    asker.refuse(
        {ErrorCode::internal, "", "the game's table is not known any more", found.game.id});
    return;
  }
  const std::array<std::string, 2> names{services_.book.name_of(found.game.agents[0]),
                                         services_.book.name_of(found.game.agents[1])};
  protocol::SyncReply<Outgoing> reply;
  reply.snapshot.terms =
      terms_of(found.game, card_of(*board, names, tournament_of_(found.match)), seat);
  reply.snapshot.state = {found.turn ? found.turn->state_after : found.game.initial_state};
  if (found.turn) {
    reply.snapshot.clocks = clocks_after(*found.turn, seat);
  }
  reply.over = over_of(found.game);
  asker.reply(reply);
}

void FinishedGames::acknowledge(const Asker& asker, storage::AgentId agent, protocol::GameId game) {
  find(asker, agent, game, std::nullopt, [this, asker, agent](const Found& found, Seat) {
    const protocol::GameId id = found.game.id;
    if (!found.game.over) {
      asker.refuse({ErrorCode::invalid_params, "/params/game", "the game is not over", id});
      return;
    }
    // Read again where nobody else writes: the other player may have acknowledged meanwhile.
    const auto work = [id, agent](storage::Database& database) -> storage::Expected<void> {
      auto record = database.game(id);
      if (!record || !*record) {
        return record ? storage::Expected<void>{} : tl::unexpected(record.error());
      }
      storage::GameRecord& row = **record;
      row.acknowledged[rules::index(*seat_of(row, agent))] = true;
      row.seal = match::seal(row);
      return database.update_game(row);
    };
    store_acknowledgement(services_.writer, asker, id, work);
  });
}

void FinishedGames::acknowledge(const Asker& asker, storage::AgentId agent, protocol::MatchId id) {
  using Result = storage::Expected<std::optional<storage::MatchRecord>>;
  services_.archive.read(
      [id](storage::Reader& reader) { return reader.match(id); },
      [this, asker, agent, id](const Result& found) {
        if (!found) {
          asker.refuse({ErrorCode::paused, "", "the database cannot be read"});
          return;
        }
        const auto& match = *found;
        if (!match || (match->agents[0] != agent && match->agents[1] != agent)) {
          asker.refuse({ErrorCode::invalid_params, "/params/match",
                        fmt::format("got {}, which is none of your matches", number(id))});
        } else if (!match->over) {
          asker.refuse({ErrorCode::invalid_params, "/params/match",
                        fmt::format("got {}, a match that goes on", number(id))});
        } else {
          store_acknowledgement(services_.writer, asker, id,
                                [id, agent](storage::Database& database) {
                                  return database.acknowledge_match(id, agent);
                                });
        }
      });
}

void store_acknowledgement(storage::Writer& writer, const Asker& asker, const protocol::Ended& what,
                           storage::Writer::Work work) {
  const auto posted =
      writer.post(std::move(work), [asker, what](const storage::Expected<void>& stored) {
        if (stored) {
          asker.reply(protocol::AckReply{what});
        } else {
          asker.refuse({ErrorCode::internal, "", stored.error().reason});
        }
      });
  if (posted != storage::Posted::accepted) {
    asker.refuse({ErrorCode::paused, "", "the database takes nothing at the moment"});
  }
}

}  // namespace poolhall::net
