// A million deviates as the server draws and reveals them, of keys from the system's generator:
// whether they are standard normal and independent, within games and between them.
#include <filesystem>
#include <ostream>
#include <string>

#include "server/match/fair_noise.hpp"
#include "server/match/goodness.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"

namespace poolhall::bench {

namespace {

using match::NoiseTest;
using physics::ShotDeviates;

constexpr std::size_t all_games = 2'000;
constexpr std::uint32_t shots_of_a_seat = 50;  // five deviates each: a million in all

// Half of the games with parts of both agents, as of a tournament's.
std::vector<ShotDeviates> draw(std::size_t games) {
  std::vector<ShotDeviates> shots;
  shots.reserve(2 * games * shots_of_a_seat);
  for (std::size_t game = 1; game <= games; ++game) {
    match::AgentSecrets secrets{};
    if (game % 2 == 0) {
      secrets = {match::draw_key(), match::draw_key()};
    }
    const match::GameKey key = match::mixed_key(match::draw_key(), secrets);
    for (std::uint32_t shot = 1; shot <= shots_of_a_seat; ++shot) {
      for (const rules::Seat seat : {rules::Seat::first, rules::Seat::second}) {
        shots.push_back(match::shot_deviates(
            key, {protocol::GameId{static_cast<std::int64_t>(game)}, seat, shot}));
      }
    }
  }
  return shots;
}

// The same shots, but neighbours are of neighbouring games.
std::vector<ShotDeviates> across_games(const std::vector<ShotDeviates>& shots) {
  constexpr std::size_t of_a_game = std::size_t{2} * shots_of_a_seat;
  std::vector<ShotDeviates> other;
  other.reserve(shots.size());
  for (std::size_t shot = 0; shot < of_a_game; ++shot) {
    for (std::size_t at = shot; at < shots.size(); at += of_a_game) {
      other.push_back(shots[at]);
    }
  }
  return other;
}

void add(ReportTable& table, const char* order, const std::vector<NoiseTest>& tests) {
  for (const NoiseTest& test : tests) {
    table.add(
        {order, test.name, std::to_string(test.count), cell(test.statistic, 6), cell(test.p, 4)});
  }
}

}  // namespace

bool bench_noise(const BenchOptions& options, std::ostream& out) {
  const auto shots = draw(scaled_count(all_games, options));
  const auto within = match::test_deviates(shots);
  const auto between = match::test_deviates(across_games(shots));
  ReportTable table("deviates of fresh keys", {"neighbours", "test", "values", "statistic", "p"});
  add(table, "shots of a game", within);
  add(table, "games", between);
  table.print(out);
  std::filesystem::create_directories(options.directory);
  table.write_csv(options.directory / "noise.csv");
  return match::fit_together(within) && match::fit_together(between);
}

}  // namespace poolhall::bench
