"""One shot: the program's bits, the log, any instant, and what is refused."""
import json
import pickle
import subprocess
import sys
import threading

import numpy as np
import poolhall
import pytest
from poolhall import Error, Shot, Table, simulate

from scenes import SHOT, random_scenes, two_balls, wire_scene


def printed(program, scenes):
    text = "\n".join(json.dumps(scene) for scene in scenes)
    done = subprocess.run([program, "simulate", "--lines", "-"], input=text, text=True,
                          capture_output=True, check=True)
    return done.stdout.splitlines()


def test_gives_the_bits_that_the_program_prints(program):
    cases = list(random_scenes(60))
    rack = poolhall.new_game(rack_seed=5).balls
    rack[0] = (0.5, 0.4)
    cases.append((rack, Shot(0, 3, 10, 87, 9)))
    lines = printed(program, [wire_scene(*case) for case in cases])
    assert [simulate(*case).to_json() for case in cases] == lines


def test_gives_the_program_s_bits_on_other_tables_and_materials(program):
    physics = {"preset": "modern", "mu_roll": 0.012, "cushion": {"model": "mathavan2010"}}
    table = Table("bar7", physics)
    balls = two_balls()
    scene = wire_scene(balls, SHOT, "bar7", physics, t_max=1.5, contact="hertz")
    assert simulate(balls, SHOT, table, t_max=1.5, contact="hertz").to_json() == printed(
        program, [scene])[0]


def test_many_are_the_same_as_one_after_another():
    cases = list(random_scenes(20, seed=2))
    balls = np.stack([case[0] for case in cases])
    shots = np.array([case[1] for case in cases])
    for threads in (1, 3):
        together = poolhall.simulate_many(balls, shots, threads=threads)
        assert [one.to_json() for one in together] == [simulate(*case).to_json() for case in cases]


def test_threads_of_python_do_not_disturb_each_other():
    cases = list(random_scenes(30, seed=3))
    alone = [simulate(*case).to_json() for case in cases]
    seen = {}

    def work(name):
        seen[name] = [simulate(*case).to_json() for case in cases]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(seen[i] == alone for i in range(4))


def test_takes_what_the_ways_to_give_balls_and_shots_have_in_common():
    balls = two_balls()
    first = simulate(balls, SHOT)
    records = np.zeros(2, poolhall.BALL)
    records["id"], records["pocket"] = [0, 3], -1
    records["x"], records["y"] = balls[[0, 3]].T
    moving = np.full((16, 7), np.nan)
    moving[[0, 3]] = 0
    moving[:, :2] = balls
    for given in (balls.tolist(), balls.astype(">f8"), np.asfortranarray(balls), balls[:4],
                  records, moving):
        assert simulate(given, SHOT).to_json() == first.to_json()
    for shot in (tuple(SHOT), list(SHOT), np.array(SHOT), SHOT._asdict(),
                 [np.float32(1), 2, np.int64(5), 90.0, 3]):
        assert simulate(balls, shot).to_json() == first.to_json()


def test_moving_balls_run_without_a_shot():
    balls = np.full((2, 7), np.nan)
    balls[1] = [0.5, 0.5, 1.0, 2.0, 0, 0, 3]
    done = simulate(balls)
    assert done.ending == "at_rest" and done.first_contact is None
    assert np.isnan(done.positions[0]).all()


def test_events_are_records_and_dicts_of_the_same_log():
    rack = poolhall.new_game(rack_seed=5).balls
    rack[0] = (0.5, 0.4)
    done = simulate(rack, Shot(0, 3, 10, 87, 9))
    events, log = done.events, done.log()
    assert len(events) == len(log) > 100
    for row, entry in zip(events, log):
        assert poolhall.EVENT_TYPES[row["type"]] == entry["type"] and row["t"] == entry["t"]
        assert [b for b in row["balls"] if b != 255] == entry["balls"]
        assert row["until"] == entry.get("until", row["t"])
        assert row["count"] == entry.get("count", 1)
        assert (poolhall.RAILS[row["rail"]] if row["rail"] >= 0 else None) == entry.get("rail")
        for ball, after in zip(row["after"], entry["after"]):
            assert ball["x"] == after["x"] and ball["wz"] == after["wz"]
            assert poolhall.STATES[ball["state"]] == after["state"]
    struck = [entry for entry in log if entry["type"] == "ball_collision" and 0 in entry["balls"]]
    assert done.first_contact == (set(struck[0]["balls"]) - {0}).pop()
    assert [b for b, _ in done.pocketed] == [e["balls"][0] for e in log if e["type"] == "pocketed"]


def test_positions_at_any_instant_fit_the_log():
    for balls, shot in random_scenes(25, seed=4):
        done = simulate(balls, shot)
        assert np.array_equal(done.positions_at(0.0), balls, equal_nan=True)
        assert np.allclose(done.positions_at(done.duration), done.positions, atol=1e-12,
                           equal_nan=True)
        assert np.array_equal(done.positions_at(done.duration + 9),
                              done.positions_at(done.duration), equal_nan=True)
        for event in done.events:
            if poolhall.EVENT_TYPES[event["type"]] == "pocketed":
                continue
            # From both sides: before it by the motion laws, after it by the log.
            for t in (np.nextafter(event["t"], 0), event["t"]):
                near = done.positions_at(t)
                for ball, after in zip(event["balls"], event["after"]):
                    if ball != 255 and event["count"] == 1:
                        assert np.allclose(near[ball], [after["x"], after["y"]], atol=1e-9)
        several = done.positions_at([0.1, 0.2, 0.3])
        assert several.shape == (3, 16, 2)
        assert np.array_equal(several[1], done.positions_at(0.2), equal_nan=True)


def test_a_shot_that_is_stopped_is_where_it_was_at_that_instant():
    balls = two_balls()
    whole, part = simulate(balls, SHOT), simulate(balls, SHOT, t_max=0.4)
    assert part.ending == "t_max" and part.end == 0.4
    assert np.allclose(part.positions, whole.positions_at(0.4), atol=1e-12, equal_nan=True)
    speeds = whole.balls_at(0.4)
    assert speeds["vy"][0] < 3 and speeds["state"][0] in range(5)


def test_a_result_is_pickled_as_its_scene():
    balls = two_balls()
    for done in (simulate(balls, SHOT), simulate(balls, SHOT, Table("wpa9", "modern"), t_max=0.7),
                 simulate(balls[:7], SHOT, event_limit=3)):
        again = pickle.loads(pickle.dumps(done))
        assert again.to_json() == done.to_json() and again.ending == done.ending
        assert np.array_equal(again.positions, done.positions, equal_nan=True)
    assert done.ending == "event_limit"


WRONG = [
    (dict(balls="abc"), "invalid_params", "/balls"),
    (dict(balls=np.zeros((3, 5))), "invalid_params", "/balls"),
    (dict(balls=np.zeros((17, 2))), "invalid_params", "/balls"),
    (dict(balls=np.zeros(4)), "invalid_params", "/balls"),
    (dict(balls=np.zeros((2, 2), complex)), "invalid_params", "/balls"),
    (dict(balls=np.zeros((2, 2), bool)), "invalid_params", "/balls"),
    (dict(balls=np.zeros((2, 2), object)), "invalid_params", "/balls"),
    (dict(balls=[[0.5, 0.5], [0.5]]), "invalid_params", "/balls"),
    (dict(balls=np.zeros(2, [("x", "f8")])), "invalid_params", "/balls"),
    (dict(balls=[[0.5, np.nan]]), "invalid_params", "/balls/0/y"),
    (dict(balls=[[0.5, 0.5], [np.inf, 1]]), "invalid_params", "/balls/1/x"),
    (dict(balls=[[0.5, 0.5], [np.nan, np.nan], [0.51, 0.5]]), "invalid_params", "/balls/2/x"),
    (dict(balls=[[0.5, 9]]), "invalid_params", "/balls/0/y"),
    (dict(shot=Shot(v=0)), "bad_shot", "/shot/v"),
    (dict(shot=Shot(phi=float("nan"), v=1)), "bad_shot", "/shot/phi"),
    (dict(shot=Shot(a=40, v=1)), "bad_shot", "/shot"),
    (dict(shot=(1, 2, 3)), "invalid_params", "/shot"),
    (dict(shot=(1, 2, 3, 4, "5")), "invalid_params", "/shot/v"),
    (dict(shot=(1, 2, 3, 4, True)), "invalid_params", "/shot/v"),
    (dict(shot={"a": 0, "b": 0, "theta": 0, "phi": 0}), "invalid_params", "/shot/v"),
    (dict(shot={**SHOT._asdict(), "speed": 1}), "invalid_params", "/shot"),
    (dict(shot=3.0), "invalid_params", "/shot"),
    (dict(shot=SHOT, balls=[[np.nan, np.nan], [0.5, 1]]), "bad_shot", "/shot"),
    (dict(table="olympiad"), "invalid_params", "/table"),
    (dict(t_max=-1), "invalid_params", "/t_max"),
    (dict(t_max=float("nan")), "invalid_params", "/t_max"),
    (dict(event_limit=0), "invalid_params", "/event_limit"),
    (dict(contact="glue"), "invalid_params", "/contact"),
    (dict(solver="guess"), "invalid_params", "/solver"),
]


@pytest.mark.parametrize("arguments,code,field", WRONG)
def test_refuses_what_is_wrong_and_names_the_argument(arguments, code, field):
    with pytest.raises(Error) as caught:
        simulate(**{"balls": two_balls(), "shot": SHOT, **arguments})
    error = caught.value
    assert (error.code, error.field[:len(field)]) == (code, field), str(error)
    assert error.number == {"invalid_params": -32602, "bad_shot": -32009}[code]
    assert error.reason and str(error).startswith(code)
    again = pickle.loads(pickle.dumps(error))
    assert (again.code, again.field, again.fault) == (error.code, error.field, error.fault)


def test_the_simulator_s_own_word_stands_beside_the_wire_s_code():
    balls = two_balls()
    balls[3] = (0.5, 0.44)
    with pytest.raises(Error) as caught:
        simulate(balls, Shot(phi=90, v=2))
    assert caught.value.code == "bad_shot" and caught.value.fault == "cue_obstructed"


def test_tables_are_presets_or_one_s_own():
    assert set(poolhall.presets["tables"]) >= {"olympiad", "bar7", "wpa8", "wpa9"}
    own = Table({"preset": "wpa9", "head_string": 0.6}, {"preset": "modern", "mu_roll": 0.02})
    assert own.head_string == 0.6 and own.physics["mu_roll"] == 0.02
    assert Table(own.table, own.physics) == own == pickle.loads(pickle.dumps(own))
    assert own != Table("wpa9", "modern") and hash(own) == hash(pickle.loads(pickle.dumps(own)))
    assert Table().pockets["side_right"] == (1.116, 1.118)
    for wrong, field in ((("snooker",), "/table"), (("olympiad", "felt"), "/physics"),
                         (({"width": 1},), "/table"), ((3,), "/table"),
                         (("olympiad", {"mu_slide": -1}), "/physics/mu_slide"),
                         (("olympiad", {"colour": 1}), "/physics/colour"),
                         (("olympiad", {"mu_slide": float("nan")}), "/physics")):
        with pytest.raises(Error) as caught:
            Table(*wrong)
        assert caught.value.code == "invalid_params" and caught.value.field.startswith(field)


def test_keeps_no_references():
    balls, table = two_balls(), Table("wpa8")
    before = sys.getrefcount(balls), sys.getrefcount(table), sys.getrefcount(SHOT)
    for _ in range(50):
        done = simulate(balls, SHOT, table)
        done.events, done.positions, done.log(), done.positions_at([0.1]), pickle.dumps(done)
        with pytest.raises(Error):
            simulate(balls, SHOT._replace(v=-1), table)
        poolhall.evaluate(balls, SHOT, table, samples=5)
    del done
    assert (sys.getrefcount(balls), sys.getrefcount(table), sys.getrefcount(SHOT)) == before


def test_a_result_outlives_its_table():
    done = simulate(two_balls(), SHOT, Table("wpa8", "modern"))
    assert done.positions_at(0.3).shape == (16, 2)
