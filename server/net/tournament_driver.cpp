#include "server/net/tournament_driver.hpp"

#include <algorithm>
#include <iterator>
#include <variant>

#include <fmt/format.h>

#include "server/tournament/round_robin.hpp"
#include "server/tournament/seeds.hpp"

namespace poolhall::net {
namespace {

using tournament::EntryId;
using tournament::Pairing;
using tournament::PlayedGame;

GameTerms terms_of(const settings::TournamentSettings& settings) {
  GameTerms terms;
  terms.rules = settings.rules;
  terms.table = settings.table;
  terms.materials = settings.physics;
  terms.noise = settings.noise;
  terms.rack_gap = settings.rack_gap;
  terms.clock = settings.clock.game;
  terms.increment = settings.clock.increment;
  terms.shot_cap = settings.clock.shot_cap;
  return terms;
}

TournamentEntry entry_of(const std::string& tournament, const settings::EntrySettings& settings) {
  TournamentEntry entry;
  entry.tournament = tournament;
  entry.name = settings.name;
  if (const auto* house = std::get_if<settings::HouseEntry>(&settings.player)) {
    entry.house_bot = house->bot;
    entry.house_options = house->options;
  } else if (const auto* command = std::get_if<settings::CommandEntry>(&settings.player)) {
    entry.command = command->command;
  }
  return entry;
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

// The file as it is stored: with the seed that was drawn for it, if it has none.
std::string with_seed(const settings::TournamentFile& file, std::uint64_t seed) {
  return file.settings.seed ? file.text : fmt::format("seed = {}\n{}", seed, file.text);
}

}  // namespace

tournament::Standings standings_of(const TournamentView& view) {
  return tournament::standings(view.names.size(), view.games, view.tie_breaks);
}

tournament::Progress progress_of(const TournamentView& view, SteadyTime now) {
  tournament::ProgressInput input;
  input.finished = view.timed;
  for (const TournamentView::Running& game : view.running) {
    input.running.push_back({game.first, game.second, now - game.since});
  }
  input.waiting = view.waiting;
  input.finished_before = view.games.size() - view.timed.size();
  input.elapsed = now - view.began;
  return tournament::progress(input);
}

TournamentDriver::TournamentDriver(settings::TournamentFile file, MatchHost& host,
                                   std::function<SteadyTime()> now)
    : file_(std::move(file)),
      host_(host),
      now_(std::move(now)),
      director_(tournament::round_robin(file_.settings.entries.size()),
                {.games = file_.settings.max_concurrent_games,
                 .games_per_entry = file_.settings.max_concurrent_games_per_entry}) {}

void TournamentDriver::on_change(std::function<void(const TournamentView&)> callback) {
  on_change_ = std::move(callback);
}

tl::expected<void, std::string> TournamentDriver::begin(std::uint64_t seed) {
  if (auto opened = open(seed); !opened) {
    return opened;
  }
  began_ = now_();
  host_.on_game_over([this](const MatchOrder& order, const GameOutcome& outcome) {
    if (order.tournament == file_.settings.name) {
      game_over(order, outcome);
    }
  });
  host_.on_match_over([this](const MatchOutcome& outcome) {
    if (outcome.tournament == file_.settings.name) {
      match_over(outcome);
    }
  });
  enter_all();
  take_up_earlier_results();
  start_due();
  tell();
  return {};
}

tl::expected<void, std::string> TournamentDriver::open(std::uint64_t seed) {
  const std::string& name = file_.settings.name;
  const TournamentCard card =
      host_.open_tournament({name, name, with_seed(file_, seed), TournamentStatus::open});
  const auto stored = settings::parse_tournament(card.settings, name);
  if (!stored || card.settings != with_seed(file_, stored->seed.value_or(0))) {
    return tl::unexpected(
        fmt::format("the database has a tournament \"{}\" with other settings; expected the same "
                    "file, another name or another database",
                    name));
  }
  seed_ = stored->seed.value_or(0);
  if (card.status != TournamentStatus::finished) {
    host_.set_status(name, TournamentStatus::running);
  }
  return {};
}

void TournamentDriver::enter_all() {
  for (const settings::EntrySettings& entry : file_.settings.entries) {
    host_.enter(entry_of(file_.settings.name, entry));
  }
}

void TournamentDriver::take_up_earlier_results() {
  const auto known = [&](const MatchOutcome& outcome) {
    return outcome.pairing < director_.schedule().size();
  };
  for (const MatchOutcome& outcome : host_.finished_matches(file_.settings.name)) {
    if (known(outcome)) {
      for (const GameOutcome& game : outcome.games) {
        record(outcome.pairing, game);
      }
      director_.end(outcome.pairing);
    }
  }
  for (const MatchOutcome& outcome : host_.unfinished_matches(file_.settings.name)) {
    if (known(outcome)) {
      for (const GameOutcome& game : outcome.games) {
        record(outcome.pairing, game);
      }
      director_.resume(outcome.pairing);
      start(director_.schedule()[outcome.pairing]);
    }
  }
}

void TournamentDriver::match_over(const MatchOutcome& outcome) {
  if (outcome.pairing >= director_.schedule().size() || director_.is_over(outcome.pairing)) {
    return;
  }
  for (const GameOutcome& game : outcome.games) {
    record(outcome.pairing, game);
  }
  game_began_.erase(outcome.pairing);
  director_.end(outcome.pairing);
  start_due();
  tell();
}

void TournamentDriver::game_over(const MatchOrder& order, const GameOutcome& outcome) {
  if (order.pairing >= director_.schedule().size() ||
      games_.contains({order.pairing, outcome.number})) {
    return;
  }
  record(order.pairing, outcome);
  const auto began = game_began_.find(order.pairing);
  if (began != game_began_.end()) {
    const Pairing& pairing = director_.schedule()[order.pairing];
    timed_.push_back({pairing.first, pairing.second, now_() - began->second});
    began->second = now_();
  }
  if (games_played(order.pairing) == file_.settings.games_per_match) {
    game_began_.erase(order.pairing);
  }
  tell();
}

void TournamentDriver::record(std::uint32_t pairing, const GameOutcome& outcome) {
  const Pairing& who = director_.schedule()[pairing];
  const std::array<EntryId, 2> players{who.first, who.second};
  PlayedGame game;
  game.pairing = pairing;
  game.number = outcome.number;
  game.breaker = players.at(outcome.breaker);
  game.other = players.at(1 - outcome.breaker);
  if (outcome.winner) {
    game.winner = players.at(*outcome.winner);
  }
  game.reason = outcome.reason;
  games_[{pairing, outcome.number}] = game;
}

void TournamentDriver::start_due() {
  for (const Pairing& pairing : director_.begin_due()) {
    start(pairing);
  }
  if (director_.all_over() && !over_) {
    finish();
  }
}

void TournamentDriver::start(const Pairing& pairing) {
  game_began_[pairing.number] = now_();
  host_.start_match(order_of(pairing));
}

void TournamentDriver::finish() {
  over_ = true;
  host_.announce_end(file_.settings.name, final_table());
  host_.set_status(file_.settings.name, TournamentStatus::finished);
}

void TournamentDriver::tell() const {
  if (on_change_) {
    on_change_(view());
  }
}

MatchOrder TournamentDriver::order_of(const Pairing& pairing) const {
  MatchOrder order;
  order.tournament = file_.settings.name;
  order.pairing = pairing.number;
  order.agents = {file_.settings.entries[index(pairing.first)].name,
                  file_.settings.entries[index(pairing.second)].name};
  order.games = file_.settings.games_per_match;
  order.terms = terms_of(file_.settings);
  order.seed = tournament::pairing_seed(seed_, pairing.number);
  order.mirrored = file_.settings.mirrored == settings::MirroredGames::rack;
  return order;
}

std::uint32_t TournamentDriver::games_played(std::uint32_t pairing) const {
  return static_cast<std::uint32_t>(std::count_if(
      games_.begin(), games_.end(), [&](const auto& game) { return game.first.first == pairing; }));
}

std::vector<protocol::StandingRow> TournamentDriver::final_table() const {
  const TournamentView now = view();
  std::vector<protocol::StandingRow> table;
  for (const tournament::StandingsRow& row : standings_of(now).rows) {
    table.push_back({row.rank, now.names[index(row.entry)], row.points, row.games(), row.wins,
                     row.losses, row.draws});
  }
  return table;
}

TournamentView TournamentDriver::view() const {
  TournamentView view;
  for (const settings::EntrySettings& entry : file_.settings.entries) {
    view.names.push_back(entry.name);
  }
  view.tie_breaks = tie_breaks_of(file_.settings);
  std::transform(games_.begin(), games_.end(), std::back_inserter(view.games),
                 [](const auto& game) { return game.second; });
  view.timed = timed_;
  for (const Pairing& pairing : director_.schedule()) {
    std::uint32_t to_play = file_.settings.games_per_match - games_played(pairing.number);
    const auto began = game_began_.find(pairing.number);
    if (began != game_began_.end() && to_play > 0) {
      view.running.push_back({pairing.first, pairing.second, began->second});
      --to_play;
    }
    view.waiting.insert(view.waiting.end(), to_play, {pairing.first, pairing.second, {}});
  }
  view.began = began_;
  view.over = over_;
  return view;
}

}  // namespace poolhall::net
