"""The referee: pure functions of state, call and event log (rules/README.md)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Tuple

from . import _core
from .errors import Error
from .moves import Call, Place, Shot, as_move

__all__ = ["Played", "Ruling", "apply", "judge", "judge_lost_turn", "play", "play_many"]


@dataclass(frozen=True)
class Ruling:
    """What the referee says of a shot.

    Attributes:
        legal: no foul.
        fouls: all of them: {code, rule, text, event}; `event` is an index into the log, or None.
        pocketed: {ball, pocket, event} in the order of the log.
        driven_off: balls off the table.
        first_contact: the ball that the cue ball struck first, or None.
        notes: the other clauses that decided: {rule, text, event}.
        next: the state of the next turn, or of the game's end.
    """

    legal: bool
    fouls: List[dict]
    pocketed: List[dict]
    driven_off: List[int]
    first_contact: Optional[int]
    notes: List[dict]
    next: _core.GameState


@dataclass(frozen=True)
class Played:
    """A move that was played: what was executed, the shot, the ruling.

    `moved` says that noise had made the stroke impossible and the nearest possible one was
    played; `state` is the next turn's, `ruling.next`.
    """

    executed: Shot
    moved: bool
    simulation: _core.Simulation
    ruling: Ruling

    @property
    def state(self) -> _core.GameState:
        return self.ruling.next


def _ruling(told: dict, state: _core.GameState) -> Ruling:
    return Ruling(told["legal"], told["fouls"], told["pocketed"], told["driven_off"],
                  told["first_contact"], told["notes"], state)


def judge(state: _core.GameState, events: Any, call: Call = None,
          cue_ball: Optional[Place] = None, table: Optional[_core.Table] = None) -> Ruling:
    """Judges a shot from `state` by its event log: a Simulation, or `events` as on the wire.

    Raises Error where the call or the place is not allowed in this state (codes bad_call,
    bad_cue_ball_position), and invalid_params where the log cannot be that of a shot from it.
    """
    return _ruling(*_core._judge(state, events, call, cue_ball, table))


def apply(state: _core.GameState, ruling: Ruling) -> _core.GameState:
    """The state after a ruling that `judge` gave for `state`."""
    del state
    return ruling.next


def judge_lost_turn(state: _core.GameState, foul: str,
                    table: Optional[_core.Table] = None) -> Ruling:
    """A turn lost without a shot: "shot_time_exceeded" or "too_many_refusals"."""
    return _ruling(*_core._lost_turn(state, foul, table))


def _played(result: Any) -> Any:
    if isinstance(result, Error):
        return result
    simulation, executed, moved, told, state = result
    return Played(Shot(*executed), moved, simulation, _ruling(told, state))


def play(state: _core.GameState, move: Any, table: Optional[_core.Table] = None, *,
         noise: Any = None, seed: int = 0, sample: int = 0) -> Played:
    """Plays a Move (or a bare Shot) as the server does: noise, physics, referee.

    `noise` as in `evaluate`; None is none. Deviates are those of `sample` under `seed`. Raises
    Error with the wire's codes for what a server would refuse.
    """
    result = _played(_core._play_many([state], [as_move(move)], table, noise, [seed], [sample],
                                      1)[0])
    if isinstance(result, Error):
        raise result
    return result


def play_many(states: Sequence[_core.GameState], moves: Sequence[Any],
              table: Optional[_core.Table] = None, *, noise: Any = None,
              seeds: Optional[Sequence[int]] = None, samples: Optional[Sequence[int]] = None,
              threads: int = 1) -> List[Any]:
    """`play` for many states at once, by `threads` threads without the interpreter's lock.

    A move that is refused gives its Error in the list instead of a Played.
    """
    count = len(states)
    results = _core._play_many(states, [as_move(m) for m in moves], table, noise,
                               [0] * count if seeds is None else list(seeds),
                               list(range(count)) if samples is None else list(samples), threads)
    return [_played(result) for result in results]
