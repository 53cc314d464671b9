"""Poolhall: computational pool with the server's own physics and referee.

    import numpy as np, poolhall
    balls = np.full((16, 2), np.nan)              # row i is ball i; NaN: not on the table
    balls[0], balls[3] = (0.5, 0.5), (0.5, 1.5)   # metres
    shot = poolhall.Shot(b=5, phi=90, theta=5, v=3)
    done = poolhall.simulate(balls, shot)         # where everything stops, and the whole way
    poolhall.evaluate(balls, shot, samples=1000).chance(3)   # how often the 3 goes down, with noise

Lengths are metres, times seconds, speeds m/s, angular velocities rad/s; a Shot is in the units of
the wire (mm and degrees). docs/python.md is the manual, docs/tutorial.md makes a bot of it.

`poolhall.client` plays on a server, `poolhall.env` is an environment for learners; both are
imported when they are first asked for.
"""
from __future__ import annotations

import importlib as _importlib
from typing import Any as _Any

from ._core import (BALL, EVENT, EVENT_TYPES, POCKETS, RAILS, STATES, GameState, Simulation, Table,
                    __version__, new_game, physics_version, presets, rules_version, simulate,
                    simulate_many)
from .errors import Error
from .evaluation import (Outcomes, Rehearsal, evaluate, nearest_shot, noise_level, noisy_shots,
                         rehearse)
from .moves import Move, Shot
from .referee import Played, Ruling, apply, judge, judge_lost_turn, play, play_many

__all__ = [
    "BALL", "EVENT", "EVENT_TYPES", "POCKETS", "RAILS", "STATES", "Client", "Error", "GameState",
    "Move", "Outcomes", "Played", "Rehearsal", "Ruling", "Shot", "Simulation", "Table",
    "__version__", "apply", "client", "env", "evaluate", "judge", "judge_lost_turn", "nearest_shot",
    "new_game", "noise_level", "noisy_shots", "physics_version", "play", "play_many", "play_on_server", "presets",
    "rehearse", "rules_version", "simulate", "simulate_many",
]

_later = {"client": ("client", None), "env": ("env", None), "Client": ("client", "Client"),
          "play_on_server": ("client", "play_on_server")}


def __getattr__(name: str) -> _Any:
    if name not in _later:
        raise AttributeError(f"module 'poolhall' has no attribute {name!r}")
    module_name, member = _later[name]
    module = _importlib.import_module("." + module_name, __name__)
    value = module if member is None else getattr(module, member)
    globals()[name] = value
    return value


def __dir__() -> list:
    return sorted(set(globals()) | set(_later))
