// Whole turns: a move with its noise, simulated and judged, one or many at once.
#include <pybind11/stl.h>

#include <memory>

#include "clients/python/core/referee.hpp"
#include "clients/python/core/workers.hpp"
#include "physics/samples.hpp"
#include "protocol/shot_path.hpp"
#include "protocol/state_json.hpp"

namespace poolhall::python {
namespace {

using rules::GameState;

// Why a move cannot be played, and the simulator's or the referee's own word for it.
struct Refused {
  protocol::Error error;
  std::string fault;
};

// What the simulator refuses stands at `stroke` in a move.
Refused refused_by(const protocol::ShotRefusal& refusal, const char* stroke) {
  if (const auto* error = std::get_if<physics::Error>(&refusal)) {
    return {protocol::error_from(*error, stroke), std::string(name(error->fault))};
  }
  const auto& why = std::get<rules::Refusal>(refusal);
  return {protocol::error_from(why, ""), std::string(name(why.code))};
}

struct PlayedMove {
  protocol::ExecutedShot executed;
  protocol::PlayedShot shot;
};

tl::expected<protocol::ReadyShot, Refused> ready_move(const GameState& state, const Move& move,
                                                      const PlayTable& play) {
  return protocol::ready_shot(state, move.call, move.cue_ball, move.shot, play.table,
                              play.materials)
      .map_error([](const auto& refusal) { return refused_by(refusal, "/shot"); });
}

// Of what was asked for; `ready` has the stroke that was played afterwards.
tl::expected<PlayedMove, Refused> play_move(protocol::ReadyShot& ready,
                                            const protocol::ShotParams& asked,
                                            const protocol::NoiseParams& noise,
                                            const physics::ShotDeviates& deviates) {
  physics::Scene<double>& scene = ready.scene;
  const protocol::ExecutedShot executed =
      protocol::executed_shot(asked, noise, deviates, scene.balls, scene.table, scene.materials);
  scene.shot = protocol::to_physics(executed.params);
  auto played = protocol::play_shot(ready);
  if (!played) {
    return tl::unexpected(refused_by(played.error(), ""));
  }
  return PlayedMove{executed, *std::move(played)};
}

const GameState& state_of(py::handle argument, const std::string& field) {
  if (!py::isinstance<GameState>(argument)) {
    refuse(field,
           "expected a poolhall.GameState, got " + std::string(Py_TYPE(argument.ptr())->tp_name));
  }
  return py::cast<const GameState&>(argument);
}

// One turn that is to be played, and what came of it.
struct Turn {
  GameState state;
  Move move;
  std::uint64_t seed = 0;
  std::uint64_t sample = 0;
  std::optional<protocol::ReadyShot> ready{};
  std::optional<tl::expected<PlayedMove, Refused>> played{};
};

void play(Turn& turn, const protocol::NoiseParams& noise, const PlayTable& table) {
  auto ready = ready_move(turn.state, turn.move, table);
  if (!ready) {
    turn.played = tl::unexpected(ready.error());
    return;
  }
  turn.ready = std::move(*ready);
  turn.played = play_move(*turn.ready, turn.move.shot, noise,
                          physics::sample_deviates(turn.seed, turn.sample));
}

Balls balls_of(const protocol::ReadyShot& ready) {
  Balls balls;
  balls.set = ready.scene.balls;
  balls.row_count = ready.state.balls.size();
  for (std::size_t i = 0; i < balls.set.count; ++i) {
    balls.rows[i] = static_cast<std::uint8_t>(physics::number(balls.set[i].id));
  }
  return balls;
}

// (simulation, executed, moved, ruling, next state), or the Error.
py::object told(Turn& turn, const py::object& table) {
  if (!*turn.played) {
    const Refused& refused = turn.played->error();
    return error_object(refused.error, refused.fault);
  }
  PlayedMove& played = **turn.played;
  const auto& e = played.executed.params;
  return py::make_tuple(
      std::make_unique<SimulationResult>(PlayedScene{table, balls_of(*turn.ready), e, {}},
                                         std::move(played.shot.simulation)),
      py::make_tuple(e.a, e.b, e.theta, e.phi, e.v), played.executed.moved,
      loads(protocol::encode_ruling(played.shot.ruling)), played.shot.ruling.next);
}

py::list play_many(const py::sequence& states, const py::sequence& moves, const py::object& table,
                   const py::object& noise, const std::vector<std::uint64_t>& seeds,
                   const std::vector<std::uint64_t>& samples, unsigned threads) {
  const std::size_t count = states.size();
  if (moves.size() != count || seeds.size() != count || samples.size() != count) {
    refuse("/moves", "expected one move, seed and sample for each of the " + std::to_string(count) +
                         " states");
  }
  const PlayTable& play_table = table_or_default(table);
  const protocol::NoiseParams deviations = read_noise(noise);
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string at = "/" + std::to_string(i);
    turns.push_back({state_of(states[i], "/states" + at), read_move(moves[i], "/moves" + at),
                     seeds[i], samples[i]});
  }
  const auto job = [&](std::size_t i, const Stop&) { play(turns[i], deviations, play_table); };
  if (count == 1) {
    job(0, [] { return false; });
  } else if (count > 1) {
    for_each_index(count, thread_count(threads), job);
  }
  py::list out;
  for (Turn& turn : turns) {
    out.append(told(turn, table));
  }
  return out;
}

struct Chances {
  std::uint64_t samples = 0;
  std::uint64_t goes_on = 0;
  std::uint64_t fouls = 0;
  std::uint64_t won = 0;
  std::uint64_t lost = 0;
  std::uint64_t moved = 0;
};

void count(Chances& chances, const PlayedMove& played, rules::Seat mover) {
  const rules::Ruling& ruling = played.shot.ruling;
  const GameState& next = ruling.next;
  ++chances.samples;
  chances.moved += played.executed.moved ? 1U : 0U;
  chances.fouls += ruling.fouls.empty() ? 0U : 1U;
  if (next.result) {
    chances.won += next.result->winner == mover ? 1U : 0U;
    chances.lost += next.result->winner == rules::other(mover) ? 1U : 0U;
  } else {
    chances.goes_on += next.to_move == mover && ruling.fouls.empty() ? 1U : 0U;
  }
}

struct Noise {
  protocol::NoiseParams deviations;
  std::uint64_t samples = 0;
  std::uint64_t seed = 0;
};

tl::expected<Chances, Refused> rehearsed(const GameState& state, const Move& move,
                                         const Noise& noise, const PlayTable& table,
                                         const Stop& stop) {
  auto ready = ready_move(state, move, table);
  if (!ready) {
    return tl::unexpected(ready.error());
  }
  Chances chances;
  for (std::uint64_t i = 0; i < noise.samples && !stop(); ++i) {
    const auto played =
        play_move(*ready, move.shot, noise.deviations, physics::sample_deviates(noise.seed, i));
    if (!played) {
      return tl::unexpected(played.error());
    }
    count(chances, *played, state.to_move);
  }
  return chances;
}

py::tuple rehearse(const GameState& state, const py::sequence& moves, const py::object& table,
                   const py::object& noise, std::uint64_t samples, std::uint64_t seed,
                   unsigned threads) {
  const PlayTable& play_table = table_or_default(table);
  const Noise drawn{read_noise(noise), samples, seed};
  if (samples == 0 || samples > 1'000'000) {
    refuse("/samples", "expected 1 to 1000000, got " + std::to_string(samples));
  }
  std::vector<Move> list;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    list.push_back(read_move(moves[i], "/moves/" + std::to_string(i)));
  }
  // Nobody else's while the lock is away.
  const GameState before = state;  // NOLINT(performance-unnecessary-copy-initialization)
  std::vector<std::optional<tl::expected<Chances, Refused>>> results(list.size());
  for_each_index(list.size(), thread_count(threads), [&](std::size_t i, const Stop& stop) {
    results[i] = rehearsed(before, list[i], drawn, play_table, stop);
  });
  py::list refusals;
  py::array_t<std::uint64_t> counts({static_cast<py::ssize_t>(list.size()), py::ssize_t{6}});
  std::uint64_t* next = counts.mutable_data();
  for (const auto& result : results) {
    const Chances c = *result ? **result : Chances{};
    refusals.append(*result ? py::object(py::none())
                            : error_object(result->error().error, result->error().fault));
    for (const std::uint64_t value : {c.samples, c.goes_on, c.fouls, c.won, c.lost, c.moved}) {
      *next++ = value;
    }
  }
  return py::make_tuple(counts, refusals);
}

}  // namespace

Move read_move(py::handle argument, const std::string& field) {
  if (!py::isinstance<py::tuple>(argument) || py::len(argument) != 3) {
    refuse(field, "expected a poolhall.Move");
  }
  const auto parts = py::reinterpret_borrow<py::tuple>(argument);
  return {read_shot(parts[0], field + "/shot"), read_call(parts[1], field + "/call"),
          read_place(parts[2], field + "/cue_ball")};
}

void bind_play(py::module_& module) {
  module.def("_play_many", &play_many, py::arg("states"), py::arg("moves"), py::arg("table"),
             py::arg("noise"), py::arg("seeds"), py::arg("samples"), py::arg("threads"));
  module.def("_rehearse", &rehearse, py::arg("state"), py::arg("moves"), py::arg("table"),
             py::arg("noise"), py::arg("samples"), py::arg("seed"), py::arg("threads"));
}

}  // namespace poolhall::python
