#include "clients/python/core/referee.hpp"

#include <pybind11/stl.h>

#include <memory>

#include "clients/python/core/docs.hpp"
#include "protocol/events_json.hpp"
#include "protocol/state_json.hpp"

namespace poolhall::python {
namespace {

using rules::GameState;

rules::RuleSet read_rules(const std::string& name) {
  const auto rules = rules::rule_set(name);
  if (!rules) {
    refuse("/rules", "expected \"8-ball\" or \"9-ball\", got \"" + name + "\"");
  }
  return *rules;
}

rules::Seat read_seat(int seat, const char* field) {
  if (seat != 0 && seat != 1) {
    refuse(field, "expected seat 0 or 1, got " + std::to_string(seat));
  }
  return static_cast<rules::Seat>(seat);
}

// What stands in a state or a log that Python gave is an argument like others.
[[noreturn]] void raise_refusal(const rules::Refusal& refusal, const std::string& prefix = {}) {
  protocol::Error error = protocol::error_from(refusal, prefix);
  if (refusal.code == rules::RefusalCode::bad_state ||
      refusal.code == rules::RefusalCode::bad_event_log) {
    error.code = protocol::ErrorCode::invalid_params;
  }
  raise(error, name(refusal.code));
}

GameState new_game(const std::string& rules, const py::object& table, int breaker,
                   std::uint64_t rack_seed, double rack_gap, double rack_jitter) {
  const PlayTable& play = table_or_default(table);
  const rules::GameSettings settings{read_rules(rules), read_seat(breaker, "/breaker"), rack_seed,
                                     rack_gap, rack_jitter};
  if (const auto fine = rules::check_settings(settings, play.table, play.materials); !fine) {
    raise_refusal(fine.error());
  }
  return rules::new_game(settings, play.table, play.materials);
}

GameState from_dict(const py::object& state, const py::object& table) {
  const PlayTable& play = table_or_default(table);
  const auto decoded = protocol::decode_state(dumps(state, "/state"));
  if (!decoded) {
    refuse("/state" + decoded.error().field, decoded.error().reason);
  }
  if (const auto fine = rules::check_state(*decoded, play.table, play.materials); !fine) {
    raise_refusal(fine.error(), "/state");
  }
  return *decoded;
}

py::array_t<double> places(const GameState& state) {
  Balls balls;
  balls.row_count = state.balls.size();
  balls.set = rules::balls_on_table(state);
  for (std::size_t i = 0; i < balls.set.count; ++i) {
    balls.rows[i] = static_cast<std::uint8_t>(physics::number(balls.set[i].id));
  }
  return positions_of(balls, balls.set.balls.data());
}

py::dict pocketed(const GameState& state) {
  py::dict out;
  for (const rules::BallPlace& ball : state.balls) {
    if (ball.where == rules::Whereabouts::pocketed) {
      out[py::int_(physics::number(ball.id))] = std::string(name(ball.pocket));
    }
  }
  return out;
}

py::list off_table(const GameState& state) {
  py::list out;
  for (const rules::BallPlace& ball : state.balls) {
    if (ball.where == rules::Whereabouts::off_table) {
      out.append(physics::number(ball.id));
    }
  }
  return out;
}

py::list numbers(const std::vector<rules::BallId>& balls) {
  py::list out;
  for (const rules::BallId ball : balls) {
    out.append(physics::number(ball));
  }
  return out;
}

py::list options(const GameState& state) {
  py::list out;
  for (const rules::Decision decision : state.options) {
    out.append(std::string(name(decision)));
  }
  return out;
}

// As `legal` of a turn on the wire.
py::dict legal(const GameState& state) {
  py::dict out;
  if (state.kind == rules::TurnKind::decision) {
    out["decisions"] = options(state);
    return out;
  }
  py::list calls;
  for (const rules::Call::Kind kind : rules::legal_calls(state)) {
    calls.append(std::string(name(kind)));
  }
  out["balls"] = numbers(rules::callable_balls(state));
  out["first_balls"] = numbers(rules::legal_first_balls(state));
  out["calls"] = calls;
  return out;
}

py::object group_of(const GameState& state, int seat) {
  const auto* memory = std::get_if<rules::EightBallMemory>(&state.memory);
  const auto group =
      memory == nullptr ? std::nullopt : rules::group_of(*memory, read_seat(seat, "/seat"));
  return group ? py::object(py::str(std::string(name(*group)))) : py::object(py::none());
}

py::object winner(const GameState& state) {
  const bool is_won = state.result && state.result->winner;
  return is_won ? py::object(py::int_(rules::index(*state.result->winner)))
                : py::object(py::none());
}

py::object reason(const GameState& state) {
  return state.result ? py::object(py::str(std::string(name(state.result->reason))))
                      : py::object(py::none());
}

GameState prepare(const GameState& state, const py::object& call, const py::object& cue_ball,
                  const py::object& table) {
  const PlayTable& play = table_or_default(table);
  const auto ready =
      rules::prepare_shot(state, read_call(call, "/call"), read_place(cue_ball, "/cue_ball"),
                          play.table, play.materials);
  if (!ready) {
    raise_refusal(ready.error());
  }
  return *ready;
}

py::tuple told(const rules::Ruling& ruling) {
  return py::make_tuple(loads(protocol::encode_ruling(ruling)), ruling.next);
}

py::tuple judge(const GameState& state, const py::object& events, const py::object& call,
                const py::object& cue_ball, const py::object& table) {
  const PlayTable& play = table_or_default(table);
  const GameState ready = prepare(state, call, cue_ball, table);
  const bool is_simulation = py::isinstance<SimulationResult>(events);
  auto log = is_simulation ? protocol::Expected<physics::EventLog<double>>(
                                 py::cast<const SimulationResult&>(events).done().events)
                           : protocol::decode_events(dumps(events, "/events"));
  if (!log) {
    refuse("/events" + log.error().field, log.error().reason);
  }
  const auto ruling =
      rules::judge(ready, read_call(call, "/call"), *log, play.table, play.materials);
  if (!ruling) {
    raise_refusal(ruling.error());
  }
  return told(*ruling);
}

void check_goes_on(const GameState& state) {
  if (state.result) {
    raise({protocol::ErrorCode::game_over, "/state", "the game is over", {}, false});
  }
}

py::tuple lost_turn(const GameState& state, const std::string& foul, const py::object& table) {
  check_goes_on(state);
  const auto code = rules::foul_code(foul);
  if (code != rules::FoulCode::shot_time_exceeded && code != rules::FoulCode::too_many_refusals) {
    refuse("/foul",
           "expected \"shot_time_exceeded\" or \"too_many_refusals\", got \"" + foul + "\"");
  }
  const PlayTable& play = table_or_default(table);
  return told(rules::judge_lost_turn(state, *code, play.table, play.materials));
}

GameState decide(const GameState& state, const std::string& choice, const py::object& table) {
  const auto decision = rules::decision(choice);
  if (!decision) {
    raise({protocol::ErrorCode::bad_decision,
           "/choice",
           "there is no decision \"" + choice + "\"",
           {},
           false});
  }
  const PlayTable& play = table_or_default(table);
  const auto next = rules::decide(state, *decision, play.table, play.materials);
  if (!next) {
    raise_refusal(next.error());
  }
  return *next;
}

GameState ended(const GameState& state, const std::optional<int>& winner,
                const std::string& reason) {
  check_goes_on(state);
  const auto known = rules::end_reason(reason);
  if (!known) {
    refuse("/reason", "there is no reason \"" + reason + "\" for an end");
  }
  rules::GameResult result{{}, *known};
  if (winner) {
    result.winner = read_seat(*winner, "/winner");
  }
  return rules::ended(state, result);
}

void bind_state(py::module_& module) {
  py::class_<GameState>(module, "GameState", docs::game_state)
      .def_static("from_dict", &from_dict, py::arg("state"), py::arg("table") = py::none(),
                  "The state of a dict as on the wire, checked to be possible on the table")
      .def(
          "to_dict", [](const GameState& s) { return loads(protocol::encode_state(s)); },
          "As on the wire")
      .def_property_readonly("rules",
                             [](const GameState& s) { return std::string(name(s.settings.rules)); })
      .def_property_readonly("kind", [](const GameState& s) { return std::string(name(s.kind)); })
      .def_property_readonly("to_move", [](const GameState& s) { return rules::index(s.to_move); })
      .def_property_readonly("breaker", [](const GameState& s) { return rules::index(s.breaker); })
      .def_readonly("turn", &GameState::turn)
      .def_readonly("rack", &GameState::rack)
      .def_readonly("turns_without_pocket", &GameState::turns_without_pocket)
      .def_property_readonly("is_over", [](const GameState& s) { return s.result.has_value(); })
      .def_property_readonly("winner", &winner, "The seat that has won, or None")
      .def_property_readonly("reason", &reason, "How the game ended, or None")
      .def_property_readonly("balls", &places, "(n, 2), m: row i is ball i; NaN: not on the table")
      .def_property_readonly("pocketed", &pocketed, "{ball: pocket}")
      .def_property_readonly("off_table", &off_table, "Balls driven off the table")
      .def_property_readonly("options", &options, "The choices of a turn of kind \"decision\"")
      .def("group_of", &group_of, py::arg("seat"), "\"solids\", \"stripes\", or None: open table")
      .def("legal", &legal, "What may be done, as `legal` of a turn on the wire")
      .def("prepare", &prepare, py::arg("call") = py::none(), py::arg("cue_ball") = py::none(),
           py::arg("table") = py::none(),
           "The state with the cue ball placed; raises Error if refused")
      .def("decide", &decide, py::arg("choice"), py::arg("table") = py::none(),
           "The state after a choice; raises Error (bad_decision)")
      .def("ended", &ended, py::arg("winner"), py::arg("reason"),
           "The game ended otherwise, such as \"conceded\" or \"timeout\"")
      .def("__eq__",
           [](const GameState& s, const py::object& other) {
             return py::isinstance<GameState>(other) && s == py::cast<const GameState&>(other);
           })
      .def("__reduce__",
           [](const GameState& s) {
             return py::make_tuple(py::module_::import("poolhall.pickles").attr("state_from_json"),
                                   py::make_tuple(protocol::encode_state(s)));
           })
      .def("__repr__", [](const GameState& s) {
        return "<poolhall.GameState " + std::string(name(s.settings.rules)) + ", turn " +
               std::to_string(s.turn) + ": " +
               (s.result ? "over, " + std::string(name(s.result->reason))
                         : std::string(name(s.kind)) + " of seat " +
                               std::to_string(rules::index(s.to_move))) +
               ">";
      });
}

GameState state_from_json(const std::string& json) {
  const auto state = protocol::decode_state(json);
  if (!state) {
    refuse("/state" + state.error().field, state.error().reason);
  }
  return *state;
}

}  // namespace

void bind_referee(py::module_& module) {
  bind_state(module);
  module.def("_state_from_json", &state_from_json);
  module.def("new_game", &new_game, py::arg("rules") = "8-ball", py::arg("table") = py::none(),
             py::kw_only(), py::arg("breaker") = 0, py::arg("rack_seed") = 0,
             py::arg("rack_gap") = 0.0, py::arg("rack_jitter") = 0.0, docs::new_game);
  module.def("_judge", &judge, py::arg("state"), py::arg("events"), py::arg("call") = py::none(),
             py::arg("cue_ball") = py::none(), py::arg("table") = py::none());
  module.def("_lost_turn", &lost_turn, py::arg("state"), py::arg("foul"),
             py::arg("table") = py::none());
  bind_play(module);
}

}  // namespace poolhall::python
