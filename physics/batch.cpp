#include "physics/batch.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

#include "physics/event_loop.hpp"
#include "physics/samples.hpp"

namespace poolhall::physics {

namespace {

// Large enough that handing out a block costs nothing, small enough to share out.
constexpr std::uint64_t block_size = 32;

// The first ball that the cue ball touches, without ending the shot.
struct FirstTouch {
  static constexpr bool records = false;
  std::optional<BallId> touched{};

  [[nodiscard]] Go see(const Sighting& s) {
    if (!touched && s.type == EventType::ball_collision &&
        (s.first == cue_ball || s.second == cue_ball)) {
      touched = s.first == cue_ball ? s.second : s.first;
    }
    return Go::on;
  }
};

void count_ball(Outcomes& outcomes, const Ball<double>& before, const Ball<double>& after) {
  const std::size_t n = number(after.id);
  if (before.state == MotionState::pocketed) {
    return;
  }
  if (after.pocket) {
    ++outcomes.pocketed[n].in[static_cast<std::size_t>(*after.pocket)];
    return;
  }
  RestingPlace& place = outcomes.resting[n];
  const Vec2<double> off = after.position - before.position;
  ++place.count;
  place.sum = place.sum + after.position;
  place.squares = place.squares + Vec2<double>{off.x * off.x, off.y * off.y};
}

void play_sample(EventLoop<double>& loop, const Scene<double>& scene, const NoiseLevel& noise,
                 const EvaluationOptions& options, std::uint64_t sample, Outcomes& outcomes) {
  const CueShot<double> wanted =
      with_noise(*scene.shot, noise, sample_deviates(options.seed, sample));
  const NearestShot played =
      nearest_possible_shot(wanted, scene.balls, scene.table, scene.materials);
  FirstTouch touch;
  const Ending ending = loop.run(scene.balls, played.shot, options.simulation, touch);
  ++outcomes.samples;
  outcomes.moved += played.moved ? 1U : 0U;
  outcomes.unfinished += ending == Ending::at_rest ? 0U : 1U;
  if (touch.touched) {
    ++outcomes.first_contact[number(*touch.touched)];
  } else {
    ++outcomes.no_contact;
  }
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    count_ball(outcomes, scene.balls[i], loop.balls()[i]);
  }
}

void add(Outcomes& sum, const Outcomes& more) {
  sum.samples += more.samples;
  sum.moved += more.moved;
  sum.unfinished += more.unfinished;
  sum.no_contact += more.no_contact;
  for (std::size_t n = 0; n < max_balls; ++n) {
    sum.first_contact[n] += more.first_contact[n];
    for (std::size_t p = 0; p < pocket_count; ++p) {
      sum.pocketed[n].in[p] += more.pocketed[n].in[p];
    }
    sum.resting[n].count += more.resting[n].count;
    sum.resting[n].sum = sum.resting[n].sum + more.resting[n].sum;
    sum.resting[n].squares = sum.resting[n].squares + more.resting[n].squares;
  }
}

}  // namespace

std::uint64_t PocketCounts::total() const {
  return std::accumulate(in.begin(), in.end(), std::uint64_t{0});
}

Vec2<double> RestingPlace::mean() const {
  return count == 0 ? Vec2<double>{} : (1 / static_cast<double>(count)) * sum;
}

Expected<Outcomes> evaluate(const Scene<double>& scene, const NoiseLevel& noise,
                            const EvaluationOptions& options) {
  if (auto fine = check_scene(scene); !fine) {
    return tl::unexpected(fine.error());
  }
  if (!scene.shot) {
    return tl::unexpected(
        Error{Fault::no_cue_ball, "/shot", "expected a shot to evaluate, there is none"});
  }
  const std::uint64_t blocks = (options.samples + block_size - 1) / block_size;
  std::vector<Outcomes> parts(blocks);
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    EventLoop<double> loop(scene.table, scene.materials);
    for (std::uint64_t b = next++; b < blocks && !(options.stop && options.stop()); b = next++) {
      const std::uint64_t end = std::min(options.samples, (b + 1) * block_size);
      for (std::uint64_t i = b * block_size; i < end; ++i) {
        play_sample(loop, scene, noise, options, i, parts[b]);
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned i = 1; i < std::max(1U, options.threads) && i < blocks; ++i) {
    helpers.emplace_back(work);
  }
  work();
  helpers.clear();
  Outcomes sum;
  for (const Outcomes& part : parts) {
    add(sum, part);
  }
  return sum;
}

}  // namespace poolhall::physics
