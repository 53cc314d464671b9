#include "server/net/tournament_driver.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <variant>

#include <fmt/format.h>

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
  terms.noise_hidden = settings.noise_hidden;
  terms.rack_gap = settings.rack_gap;
  terms.clock = settings.clock.game;
  terms.increment = settings.clock.increment;
  terms.shot_cap = settings.clock.shot_cap;
  return terms;
}

storage::Mirror mirror_of(settings::MirroredGames mirrored) {
  switch (mirrored) {
    case settings::MirroredGames::rack:
      return storage::Mirror::rack;
    case settings::MirroredGames::noise:
      return storage::Mirror::noise;
    case settings::MirroredGames::none:
      break;
  }
  return storage::Mirror::none;
}

}  // namespace

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

namespace {

tournament::Pace pace_of(const settings::TournamentSettings& settings) {
  return settings.pace == settings::MatchPace::rounds ? tournament::Pace::by_rounds
                                                      : tournament::Pace::free_running;
}

// The file as it is stored: with the seed that was drawn for it, if it has none.
std::string with_seed(const settings::TournamentFile& file, std::uint64_t seed) {
  return file.settings.seed ? file.text : fmt::format("seed = {}\n{}", seed, file.text);
}

}  // namespace

tournament::Standings standings_of(const TournamentView& view) {
  return tournament::standings(view.names.size(), view.games, view.rules);
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
      book_(file_.settings),
      director_(book_.schedule().pairings,
                {.games = file_.settings.max_concurrent_games,
                 .games_per_entry = file_.settings.max_concurrent_games_per_entry},
                pace_of(file_.settings)) {}

void TournamentDriver::on_change(std::function<void()> callback) {
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
  host_.on_entries_changed([this](const std::string& tournament) {
    if (tournament == file_.settings.name) {
      entries_changed();
    }
  });
  enter_all();
  take_field();
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
  file_.settings.seed = seed_;
  book_ = ledger::TournamentBook(file_.settings);
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

void TournamentDriver::take_field() {
  std::vector<ledger::Entered> entered;
  for (const TournamentEntry& entry : host_.entries(file_.settings.name)) {
    entered.push_back({entry.name, {entry.from_round, entry.until_round}});
  }
  book_.set_field(entered);
}

// Matches of who has left that have not begun are taken back where the format goes on without.
void TournamentDriver::entries_changed() {
  if (over_) {
    return;
  }
  take_field();
  std::set<std::uint32_t> begun;
  for (const MatchOutcome& outcome : host_.unfinished_matches(file_.settings.name)) {
    begun.insert(outcome.pairing);
    book_.begin(outcome.pairing);
  }
  plan();
  for (const std::uint32_t number : director_.running()) {
    if (book_.pairing(number) == nullptr && !begun.contains(number)) {
      host_.cancel_match(file_.settings.name, number);
      game_began_.erase(number);
      director_.drop(number);
    }
  }
  start_due();
  tell();
}

void TournamentDriver::take_up_earlier_results() {
  const auto finished = host_.finished_matches(file_.settings.name);
  const auto unfinished = host_.unfinished_matches(file_.settings.name);
  for (const MatchOutcome& outcome : finished) {
    book_.take(outcome.pairing, outcome.games, ledger::MatchStage::over);
  }
  for (const MatchOutcome& outcome : unfinished) {
    book_.take(outcome.pairing, outcome.games, ledger::MatchStage::going_on);
  }
  plan();
  for (const MatchOutcome& outcome : finished) {
    if (director_.is_known(outcome.pairing)) {
      director_.end(outcome.pairing);
    }
  }
  for (const MatchOutcome& outcome : unfinished) {
    if (const Pairing* pairing = book_.pairing(outcome.pairing)) {
      director_.resume(outcome.pairing);
      start(*pairing);
    }
  }
}

void TournamentDriver::match_over(const MatchOutcome& outcome) {
  if (!director_.is_known(outcome.pairing) || director_.is_over(outcome.pairing)) {
    return;
  }
  book_.take(outcome.pairing, outcome.games, ledger::MatchStage::over);
  game_began_.erase(outcome.pairing);
  director_.end(outcome.pairing);
  plan();
  start_due();
  tell();
}

void TournamentDriver::game_over(const MatchOrder& order, const GameOutcome& outcome) {
  const Pairing* pairing = book_.pairing(order.pairing);
  if (pairing == nullptr || !book_.add_game(order.pairing, outcome)) {
    return;
  }
  const auto began = game_began_.find(order.pairing);
  if (began != game_began_.end()) {
    timed_.push_back({pairing->first, pairing->second, now_() - began->second});
    began->second = now_();
  }
  if (book_.games_played(order.pairing) == file_.settings.games_per_match) {
    game_began_.erase(order.pairing);
  }
  tell();
}

void TournamentDriver::plan() {
  book_.plan();
  director_.plan(book_.schedule().pairings);
  const tournament::Schedule& now = book_.schedule();
  host_.set_intake(file_.settings.name, {tournament::late_round(book_.format().kind, now),
                                         std::max(now.rounds_drawn, 1U)});
}

void TournamentDriver::start_due() {
  for (const Pairing& pairing : director_.begin_due()) {
    start(pairing);
  }
  if (book_.schedule().is_complete && director_.all_over() && !over_) {
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
    on_change_();
  }
}

MatchOrder TournamentDriver::order_of(const Pairing& pairing) const {
  MatchOrder order;
  order.tournament = file_.settings.name;
  order.pairing = pairing.number;
  order.agents = {book_.names()[index(pairing.first)], book_.names()[index(pairing.second)]};
  order.games = file_.settings.games_per_match;
  order.terms = terms_of(file_.settings);
  order.seed = tournament::pairing_seed(seed_, pairing.number);
  order.mirrored = mirror_of(file_.settings.mirrored);
  return order;
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
  view.names = book_.names();
  view.rules = book_.table_rules();
  view.games = book_.games();
  view.remarks = ledger::remarks(book_);
  view.timed = timed_;
  for (const Pairing& pairing : book_.schedule().pairings) {
    const std::uint32_t played = book_.games_played(pairing.number);
    std::uint32_t to_play = file_.settings.games_per_match - played;
    if (book_.is_over(pairing.number)) {
      continue;  // games that could not be played are not played later
    }
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
