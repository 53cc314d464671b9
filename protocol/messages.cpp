#include "protocol/messages.hpp"

#include <algorithm>
#include <array>

namespace poolhall::protocol {
namespace {

template <std::size_t N>
using Names = std::array<std::string_view, N>;

// Names stand in the order of their enumerators or alternatives.
constexpr Names<std::variant_size_v<Request>> method_names{"hello",
                                                           "register",
                                                           "login",
                                                           "tournament.list",
                                                           "tournament.join",
                                                           "tournament.leave",
                                                           "challenge",
                                                           "challenge.accept",
                                                           "challenge.decline",
                                                           "shot",
                                                           "decide",
                                                           "concede",
                                                           "sync",
                                                           "ack",
                                                           "ping",
                                                           "lag",
                                                           "game.ready",
                                                           "game.reveal"};
static_assert(method_names.size() == static_cast<std::size_t>(Method::game_reveal) + 1);

constexpr Names<notification_count> notification_names{"challenge.offer",
                                                       "challenge.over",
                                                       "game.start",
                                                       "game.state",
                                                       "game.turn",
                                                       "game.shot",
                                                       "game.decision",
                                                       "game.turn_lost",
                                                       "game.over",
                                                       "match.over",
                                                       "tournament.over",
                                                       "superseded",
                                                       "lag",
                                                       "shutting_down"};
static_assert(std::variant_size_v<Notification<Outgoing>> == notification_count);

constexpr Names<2> game_status_names{"running", "over"};
constexpr Names<3> challenge_outcome_names{"accepted", "declined", "expired"};
constexpr Names<5> tournament_status_names{"open", "running", "paused", "over", "aborted"};
constexpr Names<2> membership_names{"joined", "left"};
constexpr Names<3> challenge_status_names{"offered", "accepted", "declined"};
constexpr Names<5> noise_names{"none", "low", "olympiad", "high", "variable"};

template <std::size_t N>
std::optional<std::size_t> find(const Names<N>& names, std::string_view name) {
  const auto* found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt
                              : std::optional(static_cast<std::size_t>(found - names.begin()));
}

template <class Enum, std::size_t N>
std::optional<Enum> enumerator(const Names<N>& names, std::string_view name) {
  const auto index = find(names, name);
  return index ? std::optional(static_cast<Enum>(*index)) : std::nullopt;
}

bool is_name_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

}  // namespace

bool is_agent_name(std::string_view text, const Limits& limits) {
  return !text.empty() && text.size() <= limits.name_length &&
         std::all_of(text.begin(), text.end(), is_name_character) && text != "." && text != "..";
}

bool is_noise_name(std::string_view text) {
  return find(noise_names, text).has_value();
}

std::string_view name(Method method) {
  return method_names[static_cast<std::size_t>(method)];
}
std::optional<Method> method(std::string_view name) {
  return enumerator<Method>(method_names, name);
}

std::string_view notification_name(std::size_t index) {
  return notification_names[index];
}
std::optional<std::size_t> notification_index(std::string_view name) {
  return find(notification_names, name);
}

std::string_view name(GameStatus status) {
  return game_status_names[static_cast<std::size_t>(status)];
}
std::optional<GameStatus> game_status(std::string_view name) {
  return enumerator<GameStatus>(game_status_names, name);
}

std::string_view name(ChallengeOutcome outcome) {
  return challenge_outcome_names[static_cast<std::size_t>(outcome)];
}
std::optional<ChallengeOutcome> challenge_outcome(std::string_view name) {
  return enumerator<ChallengeOutcome>(challenge_outcome_names, name);
}

std::string_view name(TournamentStatus status) {
  return tournament_status_names[static_cast<std::size_t>(status)];
}
std::optional<TournamentStatus> tournament_status(std::string_view name) {
  return enumerator<TournamentStatus>(tournament_status_names, name);
}

std::string_view name(Membership membership) {
  return membership_names[static_cast<std::size_t>(membership)];
}
std::optional<Membership> membership(std::string_view name) {
  return enumerator<Membership>(membership_names, name);
}

std::string_view name(ChallengeStatus status) {
  return challenge_status_names[static_cast<std::size_t>(status)];
}
std::optional<ChallengeStatus> challenge_status(std::string_view name) {
  return enumerator<ChallengeStatus>(challenge_status_names, name);
}

}  // namespace poolhall::protocol
