#!/usr/bin/env python3
"""Draws the pictures of docs/physics.md with `poolhall simulate --svg`.

    docs/physics/pictures.py                 # again, after the physics has changed
    docs/physics/pictures.py --into DIR      # elsewhere, to compare
"""
import argparse
import json
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
#: With cushions that take spin as real ones do; the Olympiad's damp nine tenths of it.
MODERN = {"preset": "modern"}


def straight(b, v=2.5, **more):
    """A straight shot at a ball half a metre off."""
    return scene([(0, 0.558, 0.8), (1, 0.558, 1.3)], b=b, phi=90, v=v, theta=4, **more)


def into_the_rail(a):
    """The cue ball alone, square into the right rail."""
    return scene([(0, 0.5, 1.5)], MODERN, a=a, phi=0, v=2.5, theta=4)


def cut(friction):
    """A half-ball cut: without friction between the balls the 1 goes straight up."""
    return scene([(0, 0.408, 0.883), (1, 0.558, 1.2)], {**MODERN, "ball_friction": friction},
                 phi=60, v=1.2, theta=4, t_max=1.2)


def scene(balls, physics="olympiad", a=0, b=0, theta=0, phi=0, v=0, **more):
    return {"table": "olympiad", "physics": physics,
            "balls": [{"id": n, "x": x, "y": y} for n, x, y in balls],
            "shot": {"a": a, "b": b, "theta": theta, "phi": phi, "v": v}, **more}


def masse(a):
    return scene([(0, 0.558, 0.5)], a=a, b=0, theta=65, phi=90, v=4.5)


def squirt(ratio):
    return scene([(0, 0.558, 0.4)], {"preset": "modern", "squirt_end_mass_ratio": ratio},
                 a=12, phi=90, v=6, theta=4)


SCENES = {
    "stun": straight(0, t_max=1.2),
    "follow": straight(12, t_max=1.2),
    "draw": straight(-14),
    "late-draw": straight(-14, 1.2),
    "side-left": into_the_rail(10),
    "side-none": into_the_rail(0),
    "side-right": into_the_rail(-10),
    "throw": cut("alciatore"),
    "throw-none": cut(0),
    "masse-left": masse(12),
    "masse-right": masse(-12),
    "squirt": squirt(30),
}


def draw(program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, what in SCENES.items():
        subprocess.run([program, "simulate", "-", "--svg", folder / f"{name}.svg"], check=True,
                       input=json.dumps(what), text=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build" / "release" / "poolhall")
    parser.add_argument("--into", type=Path, default=HERE)
    arguments = parser.parse_args()
    draw(arguments.program, arguments.into)
