"""What Python adds to the price of the physics: `./pool bench python`, or `python3 -m poolhall.bench`.

Both sides of every ratio are taken in this process, in turns, in processor time, and the least of
some runs counts: what the machine does beside is not the package's. Exit code 1 when a goal is not
met.
"""
from __future__ import annotations

import argparse
import time

import numpy as np

from . import Shot, _core, evaluate, new_game, simulate

ROUNDS = 25
SAMPLES = 1000


def scenes():
    """A straight pot, eight balls, a break: (name, balls, shot)."""
    two = np.full((16, 2), np.nan)
    two[0], two[3] = (0.5, 0.5), (0.52, 1.5)
    eight = np.full((16, 2), np.nan)
    eight[:8] = [(0.5, 0.5), (0.3, 1.2), (0.8, 1.5), (0.52, 1.4), (0.9, 0.9), (0.2, 1.9),
                 (0.6, 2.0), (1.0, 1.9)]
    rack = new_game(rack_seed=1, rack_gap=1e-4).balls
    rack[0] = (0.558, 0.5)
    shot = Shot(1, 2, 5, 90, 3)
    return [("cue ball and one", two, shot), ("8 balls", eight, shot),
            ("break", rack, Shot(0, 2, 8, 90, 9))]


def cost(run) -> float:
    """Processor time of all threads, s."""
    begin = time.process_time()
    run()
    return time.process_time() - begin


def least_of_both(one, other) -> tuple:
    """The least of each, taken in turns."""
    pairs = [(cost(one), cost(other)) for _ in range(ROUNDS)]
    return min(p[0] for p in pairs), min(p[1] for p in pairs)


def repeated(run, times: int) -> None:
    for _ in range(times):
        run()


def main() -> int:
    parser = argparse.ArgumentParser(prog="python3 -m poolhall.bench", description=__doc__)
    parser.add_argument("--threads", type=int, default=1, help="of evaluate, in both languages")
    threads = parser.parse_args().threads
    held = True
    print(f"{'':18}{'C++':>10}{'Python':>10}")
    for name, balls, shot in scenes():
        repeats = 200
        cpp, python = least_of_both(
            lambda: _core._simulate_seconds(balls, shot, repeats),
            lambda: repeated(lambda: simulate(balls, shot), repeats))
        over = 1e6 * (python - cpp) / repeats
        held = held and over < 5
        print(f"{name:18}{1e6 * cpp / repeats:8.2f}us{1e6 * python / repeats:8.2f}us  simulate: "
              f"{over:+.2f} us over C++ (goal: less than 5)")
        cpp, python = least_of_both(
            lambda: _core._evaluate_seconds(balls, shot, SAMPLES, threads, 1),
            lambda: evaluate(balls, shot, samples=SAMPLES, threads=threads))
        held = held and python < 1.2 * cpp
        print(f"{'':18}{1e6 * cpp / SAMPLES:8.2f}us{1e6 * python / SAMPLES:8.2f}us  evaluate, a "
              f"shot of {SAMPLES}: {python / cpp:.3f} of C++ (goal: less than 1.2)", flush=True)
    return 0 if held else 1


if __name__ == "__main__":
    raise SystemExit(main())
