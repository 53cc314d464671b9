// The docstrings of what is written in C++, as `help(poolhall)` shows them.
#pragma once

namespace poolhall::python::docs {

inline constexpr const char* table =
    R"(Table(table="olympiad", physics="olympiad")

A table to play on: its geometry, and what balls, cloth, cushions and cue are made of.

table: the name of a preset (poolhall.presets["tables"]) or a dict as in a scene file:
    {"preset": name, ...changes} or {width, length, pockets, nose_height?, head_string?, foot_spot?}.
physics: the name of a preset (poolhall.presets["physics"]) or a dict {preset?, ...changes}.
What `game.start` says of a game can be handed over as it is: Table(start["table"],
start["physics"]). SI units. Raises Error (invalid_params) that names the field.

Frame: the origin is the corner of the cushions' nose lines at the left of the head rail, x runs
across the table (0 to width), y along it (0 to length) from the head to the foot.)";

inline constexpr const char* table_pockets =
    "Where the middles of the mouths are: {pocket: (x, y)}, m; empty without pockets.";

inline constexpr const char* simulate =
    R"(simulate(balls, shot=None, table=None, *, t_max=None, event_limit=1000000,
         contact="cluster", solver="bracketed") -> Simulation

Plays one shot, or lets moving balls run, until everything rests: the same bits as
`poolhall simulate`.

balls: an array (n, 2) of x, y in m, or (n, 7) of x, y, vx, vy, wx, wy, wz in m, m/s and rad/s. Row
    i is ball i, 0 the cue ball; a row whose x and y are NaN is a ball that is not on the table.
    Or an array of records poolhall.BALL, in any order.
shot: a Shot, five numbers a, b, theta, phi, v (mm, mm, degrees, degrees, m/s), or None.
table: a Table; None is the Olympiad's.
t_max: s, when to stop.
event_limit: how many events at most; then `ending` is "event_limit" and the log partial.
contact: "cluster", "sequential" or "hertz", for balls that touch (physics/README.md).

Raises Error: bad_shot for a stroke that is impossible ("/shot/v"), invalid_params for the rest.)";

inline constexpr const char* simulate_many =
    R"(simulate_many(balls, shots, table=None, *, threads=1, ...) -> list of Simulation

`simulate` for many shots by several threads (0: one a core), without the interpreter's lock.

balls: one table for all shots, or an array (shots, n, 2 or 7). shots: a list of Shots or an array
(shots, 5). The first shot that is impossible raises Error, naming it ("/shots/3/v").)";

inline constexpr const char* simulation =
    R"(What came of a shot: where the balls are, the event log, and any instant between.

Pickled, it is its scene, which is played again; so it needs the same version of the physics.)";

inline constexpr const char* noisy_shots =
    R"(noisy_shots(balls, shot, table=None, *, noise="olympiad", samples=1, seed=0, first=0)

What is played of a shot under noise: an array (samples, 5) of executed shots in the units of the
wire, and an array of whether noise had made the shot impossible, so that the nearest possible one
is played. Samples first, first + 1, ... under `seed`, the same that `evaluate` plays.)";

inline constexpr const char* noise_level =
    R"(noise_level(noise) -> (a, b, theta, phi, v)

The standard deviations of a preset, or of what else is taken for noise: mm, mm, degrees, degrees,
m/s. None is no noise.)";

inline constexpr const char* new_game =
    R"(new_game(rules="8-ball", table=None, *, breaker=0, rack_seed=0, rack_gap=0.0, rack_jitter=0.0)

The state before a game's first turn. rules: "8-ball" or "9-ball". rack_seed: an integer below
2**53 that fixes the random order of the rack. rack_gap: m between neighbours. rack_jitter: m,
largest displacement of a ball.)";

inline constexpr const char* game_state =
    R"(A game between two shots; immutable. `from_dict` reads a `state` of the wire.)";

}  // namespace poolhall::python::docs
