#include "server/storage/records.hpp"

#include <array>
#include <utility>

namespace poolhall::storage {
namespace {

constexpr std::array<std::pair<TournamentStatus, std::string_view>, 5> tournament_statuses{{
    {TournamentStatus::open, "open"},
    {TournamentStatus::running, "running"},
    {TournamentStatus::paused, "paused"},
    {TournamentStatus::finished, "finished"},
    {TournamentStatus::aborted, "aborted"},
}};

constexpr std::array<std::pair<TurnAction, std::string_view>, 7> turn_actions{{
    {TurnAction::shot, "shot"},
    {TurnAction::decision, "decision"},
    {TurnAction::lost_turn, "lost_turn"},
    {TurnAction::concession, "concession"},
    {TurnAction::timeout, "timeout"},
    {TurnAction::forfeit, "forfeit"},
    {TurnAction::void_game, "void_game"},
}};

constexpr std::array<std::pair<Mirror, std::string_view>, 3> mirrors{{
    {Mirror::none, "none"},
    {Mirror::rack, "rack"},
    {Mirror::noise, "noise"},
}};

template <class Names, class Value>
std::string_view name_in(const Names& names, Value value) {
  for (const auto& [candidate, text] : names) {
    if (candidate == value)
      return text;
  }
  return "";
}

template <class Value, class Names>
std::optional<Value> value_in(const Names& names, std::string_view name) {
  for (const auto& [candidate, text] : names) {
    if (text == name)
      return candidate;
  }
  return std::nullopt;
}

}  // namespace

UnixMicros unix_now() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return UnixMicros{std::chrono::duration_cast<Micros>(since).count()};
}

std::string_view name(TournamentStatus status) {
  return name_in(tournament_statuses, status);
}
std::optional<TournamentStatus> tournament_status(std::string_view name) {
  return value_in<TournamentStatus>(tournament_statuses, name);
}

std::string_view name(Mirror mirror) {
  return name_in(mirrors, mirror);
}
std::optional<Mirror> mirror(std::string_view name) {
  return value_in<Mirror>(mirrors, name);
}

std::string_view name(TurnAction action) {
  return name_in(turn_actions, action);
}
std::optional<TurnAction> turn_action(std::string_view name) {
  return value_in<TurnAction>(turn_actions, name);
}

rules::GameSettings GameRecord::settings() const {
  return {.rules = terms.rules,
          .breaker = breaker,
          .rack_seed = rack_seed,
          .rack_gap = terms.rack_gap,
          .rack_jitter = terms.rack_jitter};
}

}  // namespace poolhall::storage
