#include "server/tournament/format.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

#include "physics/words.hpp"
#include "server/tournament/formats.hpp"

namespace poolhall::tournament {
namespace {

constexpr physics::Words<FormatKind, 7> kinds{{
    {FormatKind::round_robin, "round_robin"},
    {FormatKind::swiss, "swiss"},
    {FormatKind::single_elimination, "single_elimination"},
    {FormatKind::double_elimination, "double_elimination"},
    {FormatKind::gauntlet, "gauntlet"},
    {FormatKind::ladder, "ladder"},
    {FormatKind::sprt, "sprt"},
}};

}  // namespace

std::string_view name(FormatKind kind) {
  return physics::word_of(kinds, kind);
}

std::optional<FormatKind> format_kind(std::string_view name) {
  return physics::value_of(kinds, name);
}

std::string_view name(BracketSide side) {
  return side == BracketSide::winners  ? "winners"
         : side == BracketSide::losers ? "losers"
                                       : "final";
}

double MatchResult::first_points() const {
  return std::accumulate(games.begin(), games.end(), 0.0,
                         [](double sum, const GameScore& game) { return sum + game.first; });
}

double MatchResult::second_points() const {
  return static_cast<double>(games.size()) - first_points();
}

bool MatchResult::was_played() const {
  return std::any_of(games.begin(), games.end(),
                     [](const GameScore& game) { return game.was_played; });
}

bool MatchResult::has_drawn_game() const {
  return std::any_of(games.begin(), games.end(),
                     [](const GameScore& game) { return game.first == 0.5; });
}

Schedule schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                  const Happened& happened, const Schedule& drawn) {
  switch (format.kind) {
    case FormatKind::round_robin:
      return fixed_schedule(round_robin(field.size()), field, happened);
    case FormatKind::gauntlet:
      return fixed_schedule(gauntlet(field.size(), format.runners), field, happened);
    case FormatKind::swiss:
      return swiss_schedule(format, field, happened, drawn);
    case FormatKind::single_elimination:
    case FormatKind::double_elimination:
      return elimination_schedule(format, field, happened);
    case FormatKind::ladder:
      return ladder_schedule(format, field, happened);
    case FormatKind::sprt:
      break;
  }
  return sprt_schedule(format, field, happened, drawn);
}

std::uint32_t swiss_rounds_of(std::size_t entries) {
  return entries < 2 ? 0 : static_cast<std::uint32_t>(std::bit_width(entries - 1));
}

std::optional<std::uint32_t> late_round(FormatKind kind, const Schedule& schedule) {
  const bool takes_any = kind == FormatKind::swiss || kind == FormatKind::ladder;
  return takes_any && !schedule.is_complete && schedule.rounds_drawn < schedule.rounds
             ? std::optional(schedule.rounds_drawn)
             : std::nullopt;
}

TableRules table_rules(const FormatSettings& format, const Schedule& schedule,
                       const Happened& happened, std::vector<TieBreak> tie_breaks) {
  TableRules rules{
      .tie_breaks = std::move(tie_breaks), .places = schedule.places, .ladder = schedule.ladder};
  if (format.kind != FormatKind::swiss) {
    return rules;
  }
  rules.points.assign(schedule.swiss.size(), 0);
  rules.unplayed.assign(schedule.swiss.size(), 0);
  for (const RoundOff& off : schedule.off) {
    rules.points[index(off.entry)] += off.kind == RoundKind::bye ? 1 : 0;
    ++rules.unplayed[index(off.entry)];
  }
  for (const Pairing& pairing : schedule.pairings) {
    const auto found = happened.results.find(pairing.number);
    if (found != happened.results.end()) {
      const double lead = found->second.first_points() - found->second.second_points();
      const double of_first = lead > 0 ? 1 : lead < 0 ? 0 : 0.5;
      rules.points[index(pairing.first)] += of_first;
      rules.points[index(pairing.second)] += 1 - of_first;
    }
  }
  return rules;
}

namespace {

bool have_results(const std::vector<Pairing>& pairings, const Happened& happened) {
  return std::all_of(pairings.begin(), pairings.end(), [&](const Pairing& pairing) {
    return happened.results.contains(pairing.number);
  });
}

}  // namespace

Schedule fixed_schedule(std::vector<Pairing> pairings, const std::vector<EntrySpan>& field,
                        const Happened& happened) {
  std::erase_if(pairings, [&](const Pairing& pairing) {
    const bool withdrawn = field[index(pairing.first)].until || field[index(pairing.second)].until;
    return withdrawn && !happened.begun.contains(pairing.number);
  });
  Schedule now;
  now.is_complete = happened.results.size() >= pairings.size() && have_results(pairings, happened);
  for (const Pairing& pairing : pairings) {
    now.rounds_drawn = std::max(now.rounds_drawn, pairing.round + 1);
  }
  now.pairings = std::move(pairings);
  return now;
}

std::vector<Pairing> gauntlet(std::size_t entries, std::size_t runners) {
  std::vector<Pairing> pairings;
  if (runners >= entries) {
    return pairings;
  }
  const std::size_t others = entries - runners;
  for (std::size_t round = 0; round < others; ++round) {
    for (std::size_t runner = 0; runner < runners; ++runner) {
      const EntryId one = entry_id(runner);
      const std::size_t other = (runner + round) % others;
      const EntryId two = entry_id(runners + other);
      const bool runner_first = (runner + other) % 2 == 0;  // everybody in turns, of both sides
      pairings.push_back({static_cast<std::uint32_t>(pairings.size()),
                          static_cast<std::uint32_t>(round), runner_first ? one : two,
                          runner_first ? two : one});
    }
  }
  return pairings;
}

namespace {

// The first entry's scores in pairs of games with one rack that were both played.
std::vector<double> whole_pairs(std::uint32_t match, const MatchResult& result) {
  const auto of_first_entry = [&](double score) { return match % 2 == 1 ? 1 - score : score; };
  std::vector<double> scores;
  for (std::size_t i = 0; i + 1 < result.games.size(); ++i) {
    const GameScore& one = result.games[i];
    const GameScore& two = result.games[i + 1];
    if (one.number % 2 == 0 && two.number == one.number + 1 && one.was_played && two.was_played) {
      scores.insert(scores.end(), {of_first_entry(one.first), of_first_entry(two.first)});
    }
  }
  return scores;
}

}  // namespace

Schedule sprt_schedule(const FormatSettings& format, const std::vector<EntrySpan>& field,
                       const Happened& happened, const Schedule& drawn) {
  const EntryId one = entry_id(0);
  const EntryId two = entry_id(1);
  Schedule now;
  ratings::SprtState state = drawn.sprt ? *drawn.sprt : ratings::sprt({}, format.sprt);
  std::uint32_t& counted = now.sprt_matches = drawn.sprt_matches;
  const auto is_decided = [&] { return state.verdict != ratings::SprtVerdict::undecided; };
  for (auto result = happened.results.find(counted);
       result != happened.results.end() && result->first == counted && counted < format.rounds &&
       !is_decided();
       ++result, ++counted) {
    state = ratings::sprt(whole_pairs(counted, result->second), format.sprt, state);
  }
  now.sprt = state;
  const std::uint32_t matches = is_decided() ? counted : format.rounds;
  now.pairings.reserve(matches);
  for (std::uint32_t number = 0; number < matches; ++number) {
    now.pairings.push_back(
        {number, number, number % 2 == 0 ? one : two, number % 2 == 0 ? two : one});
  }
  if (std::any_of(field.begin(), field.end(), [](const auto& span) { return span.until; })) {
    std::erase_if(now.pairings,
                  [&](const Pairing& pairing) { return !happened.begun.contains(pairing.number); });
  }
  now.rounds_drawn = format.rounds;
  now.is_complete =
      std::all_of(now.pairings.begin(), now.pairings.end(), [&](const Pairing& pairing) {
        return pairing.number < counted || happened.results.contains(pairing.number);
      });
  return now;
}

}  // namespace poolhall::tournament
