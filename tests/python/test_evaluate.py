"""Shots under noise, by one thread and by many."""
import signal
import threading

import numpy as np
import poolhall
import pytest
from poolhall import Error, Shot, evaluate, noisy_shots, simulate

from conftest import start_interruptible
from scenes import SHOT, random_scenes, two_balls

POT = Shot(0, 0, 5, 88.9, 2)


def same(one, other):
    return all(np.array_equal(getattr(one, f), getattr(other, f), equal_nan=True)
               for f in one.__dataclass_fields__)


def test_is_what_simulating_each_sample_gives():
    balls = two_balls()
    whole = evaluate(balls, SHOT, samples=200, seed=7, contact="sequential")
    executed, moved = noisy_shots(balls, SHOT, samples=200, seed=7)
    assert executed.shape == (200, 5) and moved.sum() == whole.moved
    first, pocketed, resting = np.zeros(16, int), np.zeros((16, 6), int), []
    for shot in executed:
        done = simulate(balls, shot, contact="sequential")
        if done.first_contact is not None:
            first[done.first_contact] += 1
        for ball, pocket in done.pocketed:
            pocketed[ball, poolhall.POCKETS.index(pocket)] += 1
        resting.append(done.positions)
    assert whole.samples == 200 and whole.no_contact == 200 - first.sum()
    assert np.array_equal(whole.first_contact, first)
    assert np.array_equal(whole.pocketed, pocketed)
    third = np.array(resting)[:, 3]
    assert np.allclose(whole.resting_mean[3], np.nanmean(third, axis=0), atol=1e-9)
    assert np.allclose(whole.resting_deviation[3], np.nanstd(third, axis=0), atol=1e-6)
    assert np.isnan(whole.resting_mean[5]).all() and whole.resting[5] == 0


def test_is_the_same_for_any_number_of_threads():
    balls = two_balls()
    one = evaluate(balls, SHOT, samples=500, seed=3)
    for threads in (2, 5, 0):
        assert same(evaluate(balls, SHOT, samples=500, seed=3, threads=threads), one)
    assert not same(evaluate(balls, SHOT, samples=500, seed=4), one)


def test_many_shots_are_the_same_as_one_after_another():
    balls = two_balls()
    shots = [SHOT, POT, Shot(0, 5, 5, 270, 1)]
    for threads in (1, 2, 8):
        many = evaluate(balls, shots, samples=90, noise="low", threads=threads)
        assert many.pocketed.shape == (3, 16, 6) and many.resting_mean.shape == (3, 16, 2)
        for i, shot in enumerate(shots):
            alone = evaluate(balls, shot, samples=90, noise="low")
            assert np.array_equal(many.pocketed[i], alone.pocketed)
            assert np.array_equal(many.resting_mean[i], alone.resting_mean, equal_nan=True)
    array = evaluate(balls, np.array(shots), samples=90, noise="low")
    assert np.array_equal(array.pocketed, many.pocketed)
    stack = evaluate(np.stack([balls] * 3), shots, samples=90, noise="low")
    assert np.array_equal(stack.pocketed, many.pocketed)
    assert evaluate(balls, [SHOT], samples=5).pocketed.shape == (1, 16, 6)


def test_noise_is_a_preset_or_one_s_own():
    balls = two_balls()
    assert poolhall.noise_level("olympiad") == (0.5, 0.5, 0.1, 0.125, 0.075)
    assert poolhall.noise_level(None) == (0,) * 5
    assert same(evaluate(balls, SHOT, noise="olympiad", samples=50),
                evaluate(balls, SHOT, samples=50))
    steady = evaluate(balls, POT, noise="none", samples=10)
    assert steady.chance(3) in (0, 1) and np.allclose(np.nan_to_num(steady.resting_deviation), 0,
                                                      atol=1e-7)
    wild = evaluate(balls, SHOT, noise=(0, 0, 0, 20, 0), samples=200)
    assert wild.no_contact > steady.no_contact
    assert same(evaluate(balls, SHOT, noise={"a": 0, "b": 0, "theta": 0, "phi": 20, "v": 0},
                         samples=200), wild)


WRONG = [
    (dict(noise="loud"), "/noise"), (dict(noise=(1, 2)), "/noise"),
    (dict(noise=(-1, 0, 0, 0, 0)), "/noise/a"),
    (dict(noise=(0, 0, 0, 0, float("nan"))), "/noise/v"),
    (dict(samples=0), "/samples"), (dict(samples=10**9), "/samples"),
    (dict(shots=[SHOT, SHOT._replace(v=-1)]), "/shots/1/v"),
    (dict(shots=np.zeros((2, 4))), "/shots"), (dict(shots=[SHOT, 3]), "/shots/1"),
    (dict(balls=np.zeros((2, 16, 2)), shots=[SHOT]), "/balls"),
    (dict(shots=SHOT._replace(v=-1)), "/shot/v"),
]


@pytest.mark.parametrize("arguments,field", WRONG)
def test_refuses_what_is_wrong_and_names_the_argument(arguments, field):
    with pytest.raises(Error) as caught:
        evaluate(**{"balls": two_balls(), "shots": SHOT, **arguments})
    assert caught.value.field == field, str(caught.value)


def test_finds_the_nearest_shot():
    balls = two_balls()
    assert poolhall.nearest_shot(balls, SHOT) == (SHOT, False)
    balls[3] = (0.5, 0.44)
    shot, moved = poolhall.nearest_shot(balls, Shot(phi=90, v=50))
    assert moved and shot.v == 10 and shot.theta > 0
    simulate(balls, shot)
    with pytest.raises(Error):
        poolhall.nearest_shot(balls, Shot(v=float("inf")))


def test_other_threads_go_on_meanwhile():
    rack = poolhall.new_game().balls
    rack[0] = (0.5, 0.4)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    evaluate(rack, Shot(0, 3, 10, 87, 9), samples=3000)
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 100  # with the lock held it is none or a few


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_it(threads):
    code = f"""
import sys, poolhall
rack = poolhall.new_game().balls
rack[0] = (0.5, 0.4)
print("begun", flush=True)
try:
    poolhall.evaluate(rack, poolhall.Shot(0, 3, 10, 87, 9), samples=10_000_000, threads={threads})
except KeyboardInterrupt:
    poolhall.evaluate(rack, poolhall.Shot(0, 3, 10, 87, 9), samples=10)
    print("ended", flush=True)
"""
    child = start_interruptible(code)
    assert child.stdout.readline() == "begun\n"
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)  # whole, it would take many minutes
    assert out in ("ended\n", "") and child.returncode in (0, 1, -signal.SIGINT)


def test_random_scenes_can_be_evaluated():
    for balls, shot in random_scenes(10, seed=9):
        assert evaluate(balls, shot, samples=3).samples == 3
