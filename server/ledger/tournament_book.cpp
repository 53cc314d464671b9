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
  format.seed = settings.seed.value_or(0);
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

}  // namespace

TournamentBook::TournamentBook(const settings::TournamentSettings& settings)
    : settings_(settings), format_(format_of(settings)) {
  set_field({});
  plan();
}

void TournamentBook::set_field(const std::vector<Entered>& entered) {
  std::map<std::string, tournament::EntrySpan> spans;
  for (const Entered& entry : entered) {
    spans[settings::name_key(entry.name)] = entry.span;
  }
  tournament::Names names;
  std::vector<tournament::EntrySpan> field;
  const auto add = [&](const std::string& name) {
    const auto found = spans.extract(settings::name_key(name));
    const tournament::EntrySpan span = found ? found.mapped() : tournament::EntrySpan{};
    if (span.until != 0U) {
      names.push_back(name);
      field.push_back(span);
    }
  };
  for (const settings::EntrySettings& entry : settings_.entries) {
    add(entry.name);
  }
  for (const Entered& entry : entered) {
    if (spans.contains(settings::name_key(entry.name))) {
      add(entry.name);
    }
  }
  const bool only_grows = names.size() >= names_.size() &&
                          std::equal(names_.begin(), names_.end(), names.begin()) &&
                          std::all_of(field.begin() + static_cast<std::ptrdiff_t>(names_.size()),
                                      field.end(), [](const auto& span) { return span.from > 0; });
  if (!only_grows) {
    schedule_ = {};  // rounds that were drawn for others
  }
  names_ = std::move(names);
  field_ = std::move(field);
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
  for (const auto& [number, game] : games_[pairing]) {
    result.games.push_back({number,
                            !game.winner        ? 0.5
                            : *game.winner == 0 ? 1.0
                                                : 0.0,
                            tournament::was_played(game.reason, game.turns)});
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

namespace {

std::string sprt_line(const ratings::SprtSettings& test, const ratings::SprtState& state) {
  const std::string_view verdict = state.verdict == ratings::SprtVerdict::h1   ? "H1 accepted"
                                   : state.verdict == ratings::SprtVerdict::h0 ? "H0 accepted"
                                                                               : "undecided";
  return fmt::format(
      "SPRT of {:+g} against {:+g} Elo: {} after {} pairs, LLR {:.2f} in [{:.2f}, {:.2f}].\n",
      test.elo0, test.elo1, verdict, state.pairs, state.log_likelihood_ratio, state.lower,
      state.upper);
}

}  // namespace

std::string remarks(const TournamentBook& book) {
  std::string text;
  if (const auto& state = book.schedule().sprt) {
    text += sprt_line(book.format().sprt, *state);
  }
  for (const tournament::Lot& lot : book.schedule().lots) {
    text += fmt::format(
        "Round {}: level after the matches that were to be played, a lot sent {} on "
        "and put {} out.\n",
        lot.round + 1, book.names()[index(lot.winner)], book.names()[index(lot.loser)]);
  }
  return text;
}

}  // namespace poolhall::ledger
