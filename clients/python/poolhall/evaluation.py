"""What noise makes of shots."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Tuple

import numpy as np

from . import _core
from .errors import Error
from .moves import Shot, as_move

__all__ = ["Outcomes", "Rehearsal", "evaluate", "nearest_shot", "noise_level",
           "noisy_shots", "rehearse"]

noisy_shots = _core.noisy_shots
noise_level = _core.noise_level


@dataclass(frozen=True, eq=False)
class Outcomes:
    """How often what happened; balls by number 0 to 15, pockets as in `poolhall.POCKETS`.

    Of many shots every array has one more dimension in front.

    Attributes:
        samples: how often the shot was played.
        moved: how often noise made it impossible, so that the nearest possible one was played.
        unfinished: how often `t_max` or the limit of events was met.
        no_contact: how often the cue ball touched nothing.
        first_contact: (16,) how often each ball was the first that the cue ball touched.
        pocketed: (16, 6) how often each ball went into each pocket.
        resting: (16,) how often each ball stayed on the table.
        resting_mean: (16, 2) where it then came to rest, mean of x and y in m; NaN if never.
        resting_deviation: (16, 2) standard deviation of that, m.
    """

    samples: np.ndarray
    moved: np.ndarray
    unfinished: np.ndarray
    no_contact: np.ndarray
    first_contact: np.ndarray
    pocketed: np.ndarray
    resting: np.ndarray
    resting_mean: np.ndarray
    resting_deviation: np.ndarray

    def chance(self, ball: int, pocket: Optional[str] = None) -> Any:
        """Share of the samples in which `ball` went down (in `pocket`, if one is named)."""
        if not 0 <= ball <= 15:
            raise Error("invalid_params", f"expected a ball from 0 to 15, got {ball}", "/ball")
        if pocket is None:
            times = self.pocketed[..., ball, :].sum(axis=-1)
        elif pocket in _core.POCKETS:
            times = self.pocketed[..., ball, _core.POCKETS.index(pocket)]
        else:
            raise Error("invalid_params", f"expected one of {', '.join(_core.POCKETS)}, "
                        f"got {pocket!r}", "/pocket")
        return times / self.samples


def evaluate(balls: Any, shots: Any, table: Optional[_core.Table] = None, *,
             noise: Any = "olympiad", samples: int = 1000, seed: int = 0, threads: int = 1,
             t_max: Optional[float] = None, event_limit: int = 1_000_000,
             contact: str = "cluster") -> Outcomes:
    """Plays each shot `samples` times with noise, without the interpreter's lock.

    balls: (n, 2) or (n, 7), as in `simulate`; or (shots, n, 2 or 7), a table for each shot.
    shots: one Shot, or many: a list of them or an array (shots, 5).
    noise: "none", "low", "olympiad", "high", or standard deviations (a, b, theta, phi, v) in mm,
        degrees and m/s.
    seed: sample i draws the same deviates for every shot of the same seed, so that shots are
        compared in the same luck, and for any number of threads.
    threads: 0 is one a core.

    Raises Error for a shot that cannot be played without noise, naming it ("/shots/3/v"). Ctrl-C
    ends it within a twentieth of a second.
    """
    return Outcomes(**_core._evaluate(balls, shots, table, noise=noise, samples=samples, seed=seed,
                                      threads=threads, t_max=t_max, event_limit=event_limit,
                                      contact=contact))


def nearest_shot(balls: Any, shot: Any, table: Optional[_core.Table] = None) -> Tuple[Shot, bool]:
    """The nearest shot that can be played, and whether it is another one than `shot`.

    The speed comes into its range, the elevation to 0 to 90 degrees, the tip inside the miscue
    limit, and then the cue is raised by tenths of a degree until it is clear of balls and rails:
    what the server does with a shot that noise has made impossible.
    """
    numbers, moved = _core._nearest_shot(balls, shot, table)
    return Shot(*numbers), moved


@dataclass(frozen=True, eq=False)
class Rehearsal:
    """What the referee said of moves under noise; every array has one entry a move.

    Attributes:
        samples: how often the move was played; 0 if it cannot be.
        goes_on: how often the player had the table afterwards, without a foul.
        fouls: how often there was one.
        won, lost: how often the game ended so for the player.
        moved: how often noise made the stroke impossible, so that the nearest one was played.
        refused: why a move cannot be played; None where it can.
    """

    samples: np.ndarray
    goes_on: np.ndarray
    fouls: np.ndarray
    won: np.ndarray
    lost: np.ndarray
    moved: np.ndarray
    refused: List[Optional[Error]]


def rehearse(state: _core.GameState, moves: Sequence[Any], table: Optional[_core.Table] = None, *,
             noise: Any = "olympiad", samples: int = 100, seed: int = 0,
             threads: int = 1) -> Rehearsal:
    """Plays moves in `state` many times: noise, physics and referee, as on the server.

    `moves` are Moves, or Shots where neither call nor place is needed. A move that cannot be
    played is no error: `Rehearsal.refused` says why. Seeds and threads as in `evaluate`.
    """
    counts, refused = _core._rehearse(state, [as_move(m) for m in moves], table, noise, samples,
                                      seed, threads)
    return Rehearsal(*counts.T, refused=refused)
