#include "server/storage/records.hpp"

#include "physics/words.hpp"

namespace poolhall::storage {
namespace {

using physics::value_of;
using physics::word_of;
using physics::Words;

constexpr Words<TournamentStatus, 5> tournament_statuses{{
    {TournamentStatus::open, "open"},
    {TournamentStatus::running, "running"},
    {TournamentStatus::paused, "paused"},
    {TournamentStatus::finished, "finished"},
    {TournamentStatus::aborted, "aborted"},
}};

constexpr Words<TurnAction, 7> turn_actions{{
    {TurnAction::shot, "shot"},
    {TurnAction::decision, "decision"},
    {TurnAction::lost_turn, "lost_turn"},
    {TurnAction::concession, "concession"},
    {TurnAction::timeout, "timeout"},
    {TurnAction::forfeit, "forfeit"},
    {TurnAction::void_game, "void_game"},
}};

constexpr Words<Mirror, 3> mirrors{{
    {Mirror::none, "none"},
    {Mirror::rack, "rack"},
    {Mirror::noise, "noise"},
}};

}  // namespace

UnixMicros unix_now() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return UnixMicros{std::chrono::duration_cast<Micros>(since).count()};
}

std::string_view name(TournamentStatus status) {
  return word_of(tournament_statuses, status);
}
std::optional<TournamentStatus> tournament_status(std::string_view name) {
  return value_of(tournament_statuses, name);
}

std::string_view name(Mirror mirror) {
  return word_of(mirrors, mirror);
}
std::optional<Mirror> mirror(std::string_view name) {
  return value_of(mirrors, name);
}

std::string_view name(TurnAction action) {
  return word_of(turn_actions, action);
}
std::optional<TurnAction> turn_action(std::string_view name) {
  return value_of(turn_actions, name);
}

rules::GameSettings GameRecord::settings() const {
  return {.rules = terms.rules,
          .breaker = breaker,
          .rack_seed = rack_seed,
          .rack_gap = terms.rack_gap,
          .rack_jitter = terms.rack_jitter};
}

}  // namespace poolhall::storage
