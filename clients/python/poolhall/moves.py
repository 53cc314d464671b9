"""What a player does in a turn: a stroke, a call, a place for the cue ball."""
from __future__ import annotations

from typing import Any, Mapping, NamedTuple, Optional, Tuple, Union

__all__ = ["Call", "Move", "Place", "Shot"]

#: None (no call), "safety", "push_out", or (ball, pocket) such as (3, "foot_left").
Call = Union[None, str, Tuple[int, str], Mapping[str, Any]]
#: x, y in metres.
Place = Union[Tuple[float, float], Mapping[str, float], Any]


class Shot(NamedTuple):
    """A stroke, in the units of the wire.

    a, b are where the tip meets the ball, in mm from its centre as the player sees it: a > 0 is
    left, b > 0 is up. theta is the elevation of the cue, 0 to 90 degrees. phi is the heading in
    degrees, counter-clockwise from +x (across the table to the right); 90 is straight down the
    table. v is the speed of the cue in m/s.
    """

    a: float = 0.0
    b: float = 0.0
    theta: float = 0.0
    phi: float = 0.0
    v: float = 0.0


class Move(NamedTuple):
    """A stroke with all that goes with it: what `poolhall.play` plays and a server is sent.

    `cue_ball` (x, y in m) places the cue ball where it is in hand, and is None elsewhere.
    """

    shot: Shot
    call: Call = None
    cue_ball: Optional[Place] = None


def as_move(move: Any) -> Move:
    """A Move of a Move or of a bare stroke."""
    return move if isinstance(move, Move) else Move(move)
