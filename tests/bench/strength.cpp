#include "tests/bench/strength.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "clients/bots/house_bots.hpp"

namespace poolhall::bench {

namespace {

double seconds(std::chrono::nanoseconds t) {
  return std::chrono::duration<double>(t).count();
}

client::PlayerFactory player(const std::string& name, const bots::HouseBotSettings& settings) {
  auto maker = bots::house_bot(name, settings);
  if (!maker) {
    throw std::runtime_error("there is no house bot \"" + name + "\"");
  }
  return *std::move(maker);
}

// Game `number`: in even ones `one` breaks, in odd ones the other, with the same rack.
bots::ExhibitionGame play_game(const StrengthOptions& options, std::uint32_t number) {
  bots::ExhibitionSettings settings;
  settings.seed = options.seed * 1'000'003 + number;
  settings.game.rules = options.rules;
  settings.game.rack_seed = options.seed * 1'000'003 + number / 2;
  settings.table = options.table;
  settings.materials = options.materials;
  settings.noise = options.noise;
  settings.hides_noise = options.hides_noise;
  if (options.clock > 0) {
    settings.game_time = std::chrono::microseconds(std::llround(options.clock * 1e6));
  }
  std::array<client::PlayerFactory, 2> players{
      player(options.one, {.seed = number, .effort = options.effort, .cores = options.cores}),
      player(options.other, {.seed = number})};
  if (number % 2 == 1) {
    std::swap(players[0], players[1]);
  }
  bots::ExhibitionGame game = bots::play_exhibition(settings, players);
  if (!game.fault.empty()) {
    throw std::runtime_error(fmt::format("game {}: {}", number, game.fault));
  }
  return game;
}

void add_player(StrengthSums& sums, const bots::ExhibitionGame& game, rules::Seat seat) {
  const bots::SeatRecord& record = game.seats[rules::index(seat)];
  const bool breaks = seat == rules::Seat::first;
  const bool won = game.result.winner == seat;
  const bool timeout = game.result.reason == rules::EndReason::timeout;
  sums.wins += won ? 1U : 0U;
  sums.breaks += breaks ? 1U : 0U;
  sums.won_breaking += won && breaks ? 1U : 0U;
  sums.broken_and_run += won && breaks && game.break_and_run ? 1U : 0U;
  sums.shots += record.shots;
  sums.pots += record.pots;
  sums.fouls += record.fouls;
  sums.refused += record.refused;
  sums.visits += record.visits;
  sums.timeouts += timeout && !won ? 1U : 0U;
  sums.seconds += seconds(record.thinking);
  sums.longest_game = std::max(sums.longest_game, seconds(record.thinking));
  sums.longest_move = std::max(sums.longest_move, seconds(record.longest));
  if (won) {
    ++sums.won_by[std::string(rules::name(game.result.reason))];
  }
}

double points_of_one(const bots::ExhibitionGame& game, std::uint32_t number) {
  if (!game.result.winner) {
    return 0.5;
  }
  return rules::index(*game.result.winner) == number % 2 ? 1 : 0;
}

// Mean over pairs with its 95 % interval by the normal approximation.
void set_score(StrengthReport& report, const std::vector<double>& pairs) {
  const auto n = static_cast<double>(pairs.size());
  double sum = 0;
  double squares = 0;
  for (const double pair : pairs) {
    sum += pair;
    squares += pair * pair;
  }
  report.score = sum / n;
  const double variance = pairs.size() < 2 ? 0 : (squares - sum * sum / n) / (n - 1);
  const double half = 1.96 * std::sqrt(std::max(variance, 0.0) / n);
  report.low = report.score - half;
  report.high = report.score + half;
}

double share(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

void print_player(const StrengthSums& sums, const std::string& name, std::uint32_t games,
                  std::ostream& out) {
  out << fmt::format(
      "{}: won {} of {} ({} of its {} breaks); break-and-run {:.1f} %; balls a visit {:.2f}; "
      "{:.1f} shots a game, {:.1f} % pots, {:.1f} % fouls, {} refused; {:.2f} s a game, longest "
      "{:.2f} s, longest move {:.2f} s; lost on time {}\n",
      name, sums.wins, games, sums.won_breaking, sums.breaks,
      100 * share(sums.broken_and_run, sums.breaks), share(sums.pots, sums.visits),
      share(sums.shots, games), 100 * share(sums.pots, sums.shots),
      100 * share(sums.fouls, sums.shots), sums.refused, share(sums.seconds, games),
      sums.longest_game, sums.longest_move, sums.timeouts);
  out << "  won by:";
  for (const auto& [reason, count] : sums.won_by) {
    out << ' ' << reason << ' ' << count;
  }
  out << '\n';
}

}  // namespace

StrengthReport play_strength(const StrengthOptions& options, std::ostream* progress) {
  if (options.games < 2 || options.games % 2 != 0) {
    throw std::runtime_error("--games: expected an even number, for games come in pairs");
  }
  StrengthReport report{.games = options.games};
  std::vector<double> pairs(options.games / 2);
  std::atomic<std::uint32_t> next{0};
  std::uint32_t done = 0;
  std::mutex mutex;
  std::string fault;
  const auto play = [&] {
    for (std::uint32_t i = next++; i < options.games; i = next++) {
      try {
        const bots::ExhibitionGame game = play_game(options, i);
        const std::lock_guard lock(mutex);
        const rules::Seat seat = i % 2 == 0 ? rules::Seat::first : rules::Seat::second;
        add_player(report.players[0], game, seat);
        add_player(report.players[1], game, rules::other(seat));
        report.draws += game.result.winner ? 0U : 1U;
        pairs[i / 2] += points_of_one(game, i) / 2;
        ++done;
        if (progress != nullptr && done % 10 == 0) {
          *progress << fmt::format("{} games, {} won\n", done, report.players[0].wins)
                    << std::flush;
        }
      } catch (const std::exception& error) {
        const std::lock_guard lock(mutex);
        fault = error.what();
        next = options.games;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned k = 1; k < std::max(1U, options.at_once); ++k) {
      helpers.emplace_back(play);
    }
    play();
  }
  if (!fault.empty()) {
    throw std::runtime_error(fault);
  }
  set_score(report, pairs);
  return report;
}

bool bench_strength(const StrengthOptions& options, std::ostream& out) {
  const StrengthReport report = play_strength(options, &out);
  out << fmt::format(
      "\n{} against {}, {}, noise {}, table {}, materials {}: {} games in {} pairs, "
      "seed {}, clock {}\n",
      options.one, options.other, rules::name(options.rules), options.noise, options.table,
      options.materials, report.games, report.games / 2, options.seed,
      options.clock > 0 ? fmt::format("{} s", options.clock) : "none");
  out << fmt::format("score of {}: {:.1f} %, 95 % {:.1f} to {:.1f} (over pairs); draws {}\n",
                     options.one, 100 * report.score, 100 * report.low, 100 * report.high,
                     report.draws);
  print_player(report.players[0], options.one, report.games, out);
  print_player(report.players[1], options.other, report.games, out);
  return true;
}

}  // namespace poolhall::bench
