// poolhall.evaluate, noisy_shots and nearest_shot: what noise makes of shots.
#include <pybind11/stl.h>

#include <cmath>

#include "clients/python/core/docs.hpp"
#include "clients/python/core/simulation.hpp"
#include "clients/python/core/workers.hpp"
#include "physics/batch.hpp"
#include "physics/samples.hpp"

namespace poolhall::python {
namespace {

using physics::Outcomes;
using physics::ShotParameters;

constexpr std::uint64_t most_samples = 10'000'000;  // of one shot; its blocks take 50 MB

// NumPy's random generators make such seeds too.
std::uint64_t read_samples(std::uint64_t samples) {
  if (samples == 0 || samples > most_samples) {
    refuse("/samples", "expected 1 to 10000000, got " + std::to_string(samples));
  }
  return samples;
}

// An array of one number for each (shot, ball, ...), written in this order.
template <class T>
class Column {
 public:
  explicit Column(std::vector<py::ssize_t> shape)
      : array_(std::move(shape)), next_(array_.mutable_data()) {}
  void add(T value) { *next_++ = value; }
  [[nodiscard]] py::array array() const { return array_; }

 private:
  py::array_t<T> array_;
  T* next_;
};

double spread(const physics::RestingPlace& place, double mean, double squares, double start) {
  const double offset = mean - start;
  const double variance = squares / static_cast<double>(place.count) - offset * offset;
  return std::sqrt(std::max(0.0, variance));
}

py::dict counts_of(const std::vector<Outcomes>& all, const std::vector<py::ssize_t>& shape) {
  const auto count_of = [&](std::uint64_t Outcomes::*member) {
    Column<std::uint64_t> column(shape);
    for (const Outcomes& outcomes : all) {
      column.add(outcomes.*member);
    }
    return column.array();
  };
  py::dict out;
  out["samples"] = count_of(&Outcomes::samples);
  out["moved"] = count_of(&Outcomes::moved);
  out["unfinished"] = count_of(&Outcomes::unfinished);
  out["no_contact"] = count_of(&Outcomes::no_contact);
  return out;
}

// With one more dimension in front for many shots; balls by number.
py::dict arrays_of(const std::vector<Outcomes>& all, const std::vector<Balls>& scenes,
                   bool is_single) {
  std::vector<py::ssize_t> shape;
  if (!is_single) {
    shape.push_back(static_cast<py::ssize_t>(all.size()));
  }
  const auto with = [&](std::initializer_list<py::ssize_t> more) {
    std::vector<py::ssize_t> whole = shape;
    whole.insert(whole.end(), more);
    return whole;
  };
  Column<std::uint64_t> first(with({16})), in(with({16, 6})), resting(with({16}));
  Column<double> mean(with({16, 2})), deviation(with({16, 2}));
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t s = 0; s < all.size(); ++s) {
    std::array<physics::Vec2<double>, physics::max_balls> start{};
    for (const auto& ball : scenes[s].set) {
      start[physics::number(ball.id)] = ball.position;
    }
    for (std::size_t n = 0; n < physics::max_balls; ++n) {
      const physics::RestingPlace& place = all[s].resting[n];
      const physics::Vec2<double> middle = place.mean();
      const bool is_there = place.count > 0;
      first.add(all[s].first_contact[n]);
      for (const std::uint64_t times : all[s].pocketed[n].in) {
        in.add(times);
      }
      resting.add(place.count);
      mean.add(is_there ? middle.x : nothing);
      mean.add(is_there ? middle.y : nothing);
      deviation.add(is_there ? spread(place, middle.x, place.squares.x, start[n].x) : nothing);
      deviation.add(is_there ? spread(place, middle.y, place.squares.y, start[n].y) : nothing);
    }
  }
  py::dict out = counts_of(all, shape);
  out["first_contact"] = first.array();
  out["pocketed"] = in.array();
  out["resting"] = resting.array();
  out["resting_mean"] = mean.array();
  out["resting_deviation"] = deviation.array();
  return out;
}

[[noreturn]] void raise_in_batch(const physics::Error& error, const Balls& balls,
                                 std::optional<std::size_t> index) {
  protocol::Error wrong = scene_error(error, balls);
  if (index && wrong.field.starts_with("/shot")) {
    wrong.field = "/shots/" + std::to_string(*index) + wrong.field.substr(5);
  }
  raise(wrong, name(error.fault));
}

py::dict evaluate(const py::object& balls, const py::object& shots, const py::object& table,
                  const py::object& noise, std::uint64_t samples, std::uint64_t seed,
                  unsigned threads, py::object t_max, std::uint32_t event_limit,
                  std::string_view contact) {
  const PlayTable& play = table_or_default(table);
  const Shots given = read_shots(shots);
  const auto scenes = read_many_balls(balls, play.materials.ball_radius, given.list.size());
  const bool is_named = py::isinstance<py::str>(noise);
  const protocol::NoiseParams deviations = read_noise(noise);
  const physics::NoiseLevel level =
      is_named ? *physics::preset_noise(py::cast<std::string>(noise)) : in_si(deviations);
  physics::EvaluationOptions options{.samples = read_samples(samples), .seed = seed};
  options.simulation = read_options({std::move(t_max), event_limit, contact, "bracketed"});

  // Many shots are shared out whole; the samples of a few by physics::evaluate itself.
  const unsigned workers = thread_count(threads);
  const bool is_shared_out = given.list.size() >= workers;
  options.threads = is_shared_out ? 1 : workers;
  std::vector<std::optional<physics::Expected<Outcomes>>> results(given.list.size());
  const auto job = [&](std::size_t i, const Stop& stop) {
    physics::EvaluationOptions mine = options;
    mine.stop = stop;
    results[i] = physics::evaluate(physics::Scene<double>{play.table, play.materials, scenes[i].set,
                                                          physics::cue_shot(given.list[i])},
                                   level, mine);
  };
  for_each_index(results.size(), is_shared_out ? workers : 1, job);
  std::vector<Outcomes> all;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!*results[i]) {
      raise_in_batch(results[i]->error(), scenes[i],
                     given.is_single ? std::nullopt : std::optional(i));
    }
    all.push_back(**results[i]);
  }
  return arrays_of(all, scenes, given.is_single);
}

std::array<double, 5> numbers_of(const ShotParameters<double>& shot) {
  return {shot.a, shot.b, shot.theta, shot.phi, shot.v};
}

// What is played of `shot` in samples first, first + 1, ...: (samples, 5), and which were moved.
py::tuple noisy_shots(const py::object& balls, const py::object& shot, const py::object& table,
                      const py::object& noise, std::uint64_t samples, std::uint64_t seed,
                      std::uint64_t first) {
  const PlayTable& play = table_or_default(table);
  const Balls given = read_balls(balls, play.materials.ball_radius, "/balls");
  const ShotParameters<double> intended = read_shot(shot, "/shot");
  const protocol::NoiseParams deviations = read_noise(noise);
  const auto count = static_cast<py::ssize_t>(read_samples(samples));
  const physics::Scene<double> scene{play.table, play.materials, given.set,
                                     physics::cue_shot(intended)};
  if (const auto fine = physics::check_scene(scene); !fine) {
    raise_in_batch(fine.error(), given, std::nullopt);
  }
  py::array_t<double> executed({count, py::ssize_t{5}});
  py::array_t<bool> moved(count);
  double* next = executed.mutable_data();
  for (py::ssize_t i = 0; i < count; ++i) {
    const protocol::ExecutedShot played = protocol::executed_shot(
        intended, deviations, physics::sample_deviates(seed, first + static_cast<std::uint64_t>(i)),
        given.set, play.table, play.materials);
    const auto numbers = numbers_of(played.params);
    next = std::copy(numbers.begin(), numbers.end(), next);
    moved.mutable_data()[i] = played.moved;
  }
  return py::make_tuple(executed, moved);
}

// The nearest shot that can be played, as the server finds it after adding noise.
py::tuple nearest_shot(const py::object& balls, const py::object& shot, const py::object& table) {
  const PlayTable& play = table_or_default(table);
  const Balls given = read_balls(balls, play.materials.ball_radius, "/balls");
  const ShotParameters<double> wanted = read_shot(shot, "/shot");
  for (const double number : numbers_of(wanted)) {
    if (!(std::abs(number) <= 1e6)) {
      raise(
          {protocol::ErrorCode::bad_shot, "/shot", "expected finite numbers up to 1e6", {}, false},
          "not_finite");
    }
  }
  physics::Scene<double> scene{play.table, play.materials, given.set, {}};
  if (const auto fine = physics::check_scene(scene); !fine) {
    raise_in_batch(fine.error(), given, std::nullopt);
  }
  if (std::none_of(given.set.begin(), given.set.end(), [](const physics::Ball<double>& ball) {
        return ball.id == physics::cue_ball && !ball.pocket;
      })) {
    refuse("/balls", "expected ball 0 on the table, it is not there");
  }
  const physics::NearestShot nearest = physics::nearest_possible_shot(
      physics::cue_shot(wanted), given.set, play.table, play.materials);
  const auto numbers = numbers_of(nearest.shot.given);
  return py::make_tuple(py::cast(numbers), nearest.moved);
}

}  // namespace

void bind_evaluation(py::module_& module) {
  constexpr std::uint32_t event_limit = physics::SimulationOptions{}.event_limit;
  module.def("_evaluate", &evaluate, py::arg("balls"), py::arg("shots"),
             py::arg("table") = py::none(), py::kw_only(), py::arg("noise") = "olympiad",
             py::arg("samples") = 1000, py::arg("seed") = 0, py::arg("threads") = 1,
             py::arg("t_max") = py::none(), py::arg("event_limit") = event_limit,
             py::arg("contact") = "cluster");
  module.def("noisy_shots", &noisy_shots, py::arg("balls"), py::arg("shot"),
             py::arg("table") = py::none(), py::kw_only(), py::arg("noise") = "olympiad",
             py::arg("samples") = 1, py::arg("seed") = 0, py::arg("first") = 0, docs::noisy_shots);
  module.def(
      "noise_level",
      [](const py::object& noise) {
        const protocol::NoiseParams n = read_noise(noise);
        return py::make_tuple(n.a, n.b, n.theta, n.phi, n.v);
      },
      py::arg("noise"), docs::noise_level);
  module.def("_nearest_shot", &nearest_shot, py::arg("balls"), py::arg("shot"),
             py::arg("table") = py::none());
}

}  // namespace poolhall::python
