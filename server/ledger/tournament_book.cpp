#include "server/ledger/tournament_book.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace poolhall::ledger {
namespace {

tournament::FormatSettings format_of(const settings::TournamentSettings& settings) {
  tournament::FormatSettings format;
  format.kind = tournament::format_kind(settings.format).value_or(format.kind);
  format.rounds = settings.rounds;
  format.runners = settings.gauntlet_runners;
  format.sprt = {settings.sprt.elo0, settings.sprt.elo1, settings.sprt.alpha, settings.sprt.beta};
  return format;
}

std::vector<tournament::TieBreak> tie_breaks_of(const settings::TournamentSettings& settings) {
  std::vector<tournament::TieBreak> tie_breaks;
  for (const std::string& name : settings.tie_breaks) {
    if (const auto tie_break = tournament::tie_break(name)) {
      tie_breaks.push_back(*tie_break);
    }
  }
  return tie_breaks;
}

// A forfeit before anything was played is one stored turn, its own.
bool was_played(const ScoredGame& game) {
  return game.reason != rules::EndReason::forfeit || game.turns > 1;
}

}  // namespace

TournamentBook::TournamentBook(const settings::TournamentSettings& settings)
    : settings_(settings), format_(format_of(settings)), field_(settings.entries.size()) {
  plan();
}

void TournamentBook::take(std::uint32_t pairing, const std::vector<ScoredGame>& games,
                          MatchStage stage) {
  begin(pairing);
  for (const ScoredGame& game : games) {
    add_game(pairing, game);
  }
  if (stage == MatchStage::over) {
    end(pairing);
  }
}

bool TournamentBook::add_game(std::uint32_t pairing, const ScoredGame& game) {
  return games_[pairing].emplace(game.number, game).second;
}

void TournamentBook::end(std::uint32_t pairing) {
  tournament::MatchResult result;
  result.was_played = false;
  for (const auto& [number, game] : games_[pairing]) {
    result.first_scores.push_back(!game.winner ? 0.5 : *game.winner == 0 ? 1 : 0);
    result.was_played = result.was_played || was_played(game);
  }
  happened_.begun.insert(pairing);
  happened_.results[pairing] = std::move(result);
}

void TournamentBook::plan() {
  schedule_ = tournament::schedule(format_, field_, happened_, schedule_);
}

const tournament::Pairing* TournamentBook::pairing(std::uint32_t number) const {
  const auto found = std::lower_bound(schedule_.pairings.begin(), schedule_.pairings.end(), number,
                                      [](const tournament::Pairing& pairing, std::uint32_t wanted) {
                                        return pairing.number < wanted;
                                      });
  return found == schedule_.pairings.end() || found->number != number ? nullptr : &*found;
}

std::uint32_t TournamentBook::games_played(std::uint32_t pairing) const {
  const auto found = games_.find(pairing);
  return found == games_.end() ? 0 : static_cast<std::uint32_t>(found->second.size());
}

std::vector<tournament::PlayedGame> TournamentBook::games() const {
  std::vector<tournament::PlayedGame> played;
  for (const auto& [number, games] : games_) {
    const tournament::Pairing* who = pairing(number);
    if (who == nullptr) {
      continue;
    }
    const std::array<tournament::EntryId, 2> players{who->first, who->second};
    for (const auto& [game_number, game] : games) {
      tournament::PlayedGame one;
      one.pairing = number;
      one.number = game_number;
      one.breaker = players.at(game.breaker);
      one.other = players.at(1 - game.breaker);
      if (game.winner) {
        one.winner = players.at(*game.winner);
      }
      one.reason = game.reason;
      one.turns = game.turns;
      played.push_back(one);
    }
  }
  return played;
}

tournament::TableRules TournamentBook::table_rules() const {
  return tournament::table_rules(format_, schedule_, happened_, tie_breaks_of(settings_));
}

tournament::Names TournamentBook::names() const {
  tournament::Names names;
  for (const settings::EntrySettings& entry : settings_.entries) {
    names.push_back(entry.name);
  }
  return names;
}

std::optional<std::string> sprt_line(const TournamentBook& book) {
  const auto& state = book.schedule().sprt;
  if (!state) {
    return std::nullopt;
  }
  const auto& test = book.format().sprt;
  const std::string_view verdict = state->verdict == ratings::SprtVerdict::h1   ? "H1 accepted"
                                   : state->verdict == ratings::SprtVerdict::h0 ? "H0 accepted"
                                                                                : "undecided";
  return fmt::format(
      "SPRT of {:+g} against {:+g} Elo: {} after {} pairs, LLR {:.2f} in [{:.2f}, {:.2f}]",
      test.elo0, test.elo1, verdict, state->pairs, state->log_likelihood_ratio, state->lower,
      state->upper);
}

}  // namespace poolhall::ledger
