"""How what is written in C++ is made again by pickle, which finds Python's own functions only."""
from __future__ import annotations

from typing import Any

from . import _core


def played_again(*scene: Any) -> _core.Simulation:
    """A Simulation from its scene."""
    return _core._played_again(*scene)


def state_from_json(json: str) -> _core.GameState:
    """A GameState from its JSON text."""
    return _core._state_from_json(json)
