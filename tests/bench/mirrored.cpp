// What mirroring is worth: the variance of the score difference of two house bots over pairs of
// games, each breaking once, with independent racks, with the same rack, and with the same rack and
// shared noise, by the rule (and the code) of the server.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/bots/exhibition.hpp"
#include "clients/bots/house_bots.hpp"
#include "server/match/fair_noise.hpp"
#include "server/net/shared_noise.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/bench/report.hpp"

namespace poolhall::bench {

namespace {

using net::PairSide;
using net::SharedNoise;
using storage::Mirror;

constexpr std::size_t all_pairs = 400;
constexpr std::uint64_t stronger_effort = 1'000;
constexpr std::uint64_t weaker_effort = 150;

// The two games of a pair with shared noise, each in a thread of its own.
class SharedDeviates {
 public:
  explicit SharedDeviates(const match::GameKey& key) : key_(key) {}

  physics::ShotDeviates ask(PairSide side, rules::Seat seat, std::uint32_t shot) {
    // Shared: the one that fulfils it may still be at it when the other goes on.
    const auto promise = std::make_shared<std::promise<SharedNoise::Run>>();
    {
      const std::lock_guard lock(mutex_);
      pair_.submit(side, {seat, shot},
                   [promise](SharedNoise::Run how) { promise->set_value(how); });
    }
    const bool is_shared = promise->get_future().get() == SharedNoise::Run::shared;
    const std::int64_t game = side == PairSide::first || is_shared ? 1 : 2;
    ++(is_shared ? shared_ : alone_);
    return match::shot_deviates(key_, {protocol::GameId{game}, seat, shot,
                                       is_shared ? match::Stream::shared : match::Stream::own});
  }
  void leave(PairSide side) {
    const std::lock_guard lock(mutex_);
    pair_.leave(side);
  }

  [[nodiscard]] std::uint64_t shared() const { return shared_; }
  [[nodiscard]] std::uint64_t alone() const { return alone_; }

 private:
  match::GameKey key_;
  boost::asio::io_context io_;  // is never run: nobody's patience ends
  net::DeadlineQueue deadlines_{io_};
  SharedNoise pair_{{}, deadlines_};
  std::mutex mutex_;
  std::atomic<std::uint64_t> shared_ = 0;
  std::atomic<std::uint64_t> alone_ = 0;
};

struct Pair {
  std::uint64_t number = 0;
  Mirror mirror = Mirror::none;
};

struct Sums {
  std::vector<double> differences;  // of each pair: the stronger bot's points less the weaker's
  std::uint64_t shared = 0;
  std::uint64_t shots = 0;
};

client::PlayerFactory player(std::uint64_t effort, std::uint64_t seed) {
  return bots::house_bot("greedy", {.seed = seed, .effort = effort}).value();
}

// The stronger bot's points less the weaker's in game 0 or 1 of the pair.
double play_game(const Pair& pair, PairSide side, SharedDeviates& noise) {
  const std::uint32_t number = side == PairSide::first ? 0 : 1;
  const std::uint64_t game = 2 * pair.number + number;
  bots::ExhibitionSettings settings;
  settings.seed = game + 1;
  settings.game.rack_seed =
      match::rack_seed(pair.number, match::rack_number(number, 0, pair.mirror));
  settings.deviates = [&noise, side](rules::Seat seat, std::uint32_t shot) {
    return noise.ask(side, seat, shot);
  };
  std::array<client::PlayerFactory, 2> players{player(stronger_effort, game),
                                               player(weaker_effort, game)};
  if (number == 1) {
    std::swap(players[0], players[1]);
  }
  const bots::ExhibitionGame played = bots::play_exhibition(settings, players);
  noise.leave(side);
  if (!played.fault.empty()) {
    throw std::runtime_error("pair " + std::to_string(pair.number) + ": " + played.fault);
  }
  if (!played.result.winner) {
    return 0;
  }
  return rules::index(*played.result.winner) == number ? 1 : -1;
}

void play_pair(const Pair& pair, Sums& sums) {
  match::GameKey key{};
  key[0] = static_cast<std::uint8_t>(pair.mirror);
  for (std::size_t i = 0; i < 8; ++i) {
    key[8 + i] = static_cast<std::uint8_t>(pair.number >> (8 * i));
  }
  SharedDeviates noise(key);
  double first = 0;
  double second = 0;
  if (pair.mirror == Mirror::noise) {
    auto other =
        std::async(std::launch::async, [&] { return play_game(pair, PairSide::second, noise); });
    first = play_game(pair, PairSide::first, noise);
    second = other.get();
  } else {
    noise.leave(PairSide::first);  // every shot alone
    first = play_game(pair, PairSide::first, noise);
    second = play_game(pair, PairSide::second, noise);
  }
  sums.differences.push_back(first + second);
  sums.shared += noise.shared();
  sums.shots += noise.shared() + noise.alone();
}

double mean_score(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double centre = mean_score(values);
  double sum = 0;
  for (const double value : values) {
    sum += (value - centre) * (value - centre);
  }
  return sum / static_cast<double>(values.size() - 1);
}

struct Interval {
  double low = 0;
  double high = 0;
};

// 95 %, by 4,000 bootstrap samples: of the variance, over that of `base` if there is one.
Interval bootstrap(const std::vector<double>& values, const std::vector<double>& base) {
  constexpr std::size_t samples = 4'000;
  std::mt19937_64 random(20261122);
  const auto resampled = [&random](const std::vector<double>& from) {
    std::vector<double> sample(from.size());
    for (double& value : sample) {
      value = from[random() % from.size()];
    }
    return variance(sample);
  };
  std::vector<double> found(samples);
  for (double& value : found) {
    value = base.empty() ? resampled(values) : resampled(values) / resampled(base);
  }
  return {quantile(found, 0.025), quantile(found, 0.975)};
}

std::string shown(const Interval& interval) {
  return cell(interval.low) + " to " + cell(interval.high);
}

}  // namespace

bool bench_mirrored(const BenchOptions& options, std::ostream& out) {
  const std::size_t pairs = std::max<std::size_t>(8, scaled_count(all_pairs, options));
  ReportTable table("score difference of greedy " + std::to_string(stronger_effort) +
                        " and greedy " + std::to_string(weaker_effort) + " over a pair of games",
                    {"pairs", "count", "mean", "variance", "95 %", "to independent", "95 % ",
                     "shots with shared noise"});
  std::vector<double> independent;
  for (const auto& [mirror, name] :
       {std::pair{Mirror::none, "independent"}, std::pair{Mirror::rack, "same rack"},
        std::pair{Mirror::noise, "same rack, shared noise"}}) {
    Sums sums;
    for (std::size_t i = 0; i < pairs; ++i) {
      play_pair({options.seed * 1'000'000 + i, mirror}, sums);
    }
    if (mirror == Mirror::none) {
      independent = sums.differences;
    }
    const double here = variance(sums.differences);
    table.add({name, std::to_string(pairs), cell(mean_score(sums.differences)), cell(here),
               shown(bootstrap(sums.differences, {})), cell(here / variance(independent)),
               mirror == Mirror::none ? "" : shown(bootstrap(sums.differences, independent)),
               cell(static_cast<double>(sums.shared) / static_cast<double>(sums.shots))});
  }
  table.print(out);
  std::filesystem::create_directories(options.directory);
  table.write_csv(options.directory / "mirrored.csv");
  return true;
}

}  // namespace poolhall::bench
