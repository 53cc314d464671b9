"""Scenes for the tests: two balls, and random shots from a seed."""
import numpy as np

import poolhall


def two_balls():
    balls = np.full((16, 2), np.nan)
    balls[0], balls[3] = (0.5, 0.5), (0.52, 1.5)
    return balls


SHOT = poolhall.Shot(1, 2, 5, 90, 3)


def random_scenes(count, seed=1):
    """(balls, shot) that can be played: 2 to 16 balls anywhere, a possible stroke."""
    random = np.random.default_rng(seed)
    table = poolhall.Table()
    while count > 0:
        balls = np.full((16, 2), np.nan)
        for n in [0, *random.permutation(np.arange(1, 16))[:random.integers(1, 16)]]:
            while True:
                place = random.uniform([0.1, 0.1], [table.width - 0.1, table.length - 0.1])
                gaps = np.linalg.norm(balls - place, axis=1)
                if not np.any(gaps < 0.0573):
                    balls[n] = place
                    break
        wanted = poolhall.Shot(*random.uniform([-8, -8, 0, 0, 0.5], [8, 8, 20, 360, 8]))
        shot, _ = poolhall.nearest_shot(balls, wanted, table)
        yield balls, shot
        count -= 1


def wire_scene(balls, shot=None, table="olympiad", physics="olympiad", **more):
    """The scene file of it."""
    listed = [{"id": n, "x": float(row[0]), "y": float(row[1])}
              for n, row in enumerate(balls) if not np.isnan(row[0])]
    scene = {"table": table, "physics": physics, "balls": listed, **more}
    if shot is not None:
        scene["shot"] = dict(zip("a b theta phi v".split(), map(float, shot)))
    return scene
