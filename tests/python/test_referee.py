"""The referee: whole games, rulings, and what is refused."""
import json
import pickle
import subprocess

import numpy as np
import poolhall
import pytest
from poolhall import Error, GameState, Move, Shot, Table, judge, new_game, play


def some_move(state, random):
    legal = state.legal()
    if "decisions" in legal:
        return None
    table = Table()
    place = None
    balls = state.balls
    if state.kind != "shot":
        for _ in range(1000):
            place = random.uniform([0.05, 0.05], [table.width - 0.05, table.head_string - 1e-3])
            if np.nanmin(np.linalg.norm(balls[1:] - place, axis=1)) > 0.06:
                break
        balls[0] = place
    ball = random.choice(legal["first_balls"])
    way = balls[ball] - balls[0]
    wanted = Shot(phi=np.degrees(np.arctan2(way[1], way[0])) + random.normal(0, 1), v=9
                  if state.kind == "break" else random.uniform(1, 5), theta=5)
    shot, _ = poolhall.nearest_shot(balls, wanted)
    call = None
    if "pocket" in legal["calls"]:
        call = (int(random.choice(legal["balls"])), random.choice(poolhall.POCKETS))
    return Move(shot, call, place)


@pytest.mark.parametrize("rules", ["8-ball", "9-ball"])
def test_plays_whole_games(rules):
    for seed in range(3):
        random = np.random.default_rng(seed)
        state = new_game(rules, rack_seed=seed, breaker=seed % 2)
        assert state.to_move == seed % 2 and state.kind == "break"
        while not state.is_over:
            move = some_move(state, random)
            if move is None:
                state = state.decide(random.choice(state.options))
                continue
            played = play(state, move, noise="olympiad", seed=seed, sample=state.turn)
            again = judge(state, played.simulation, move.call, move.cue_ball)
            by_log = judge(state, played.simulation.log(), move.call, move.cue_ball)
            assert again == played.ruling == by_log
            assert GameState.from_dict(played.state.to_dict()) == played.state
            assert pickle.loads(pickle.dumps(played)).state == played.state
            state = poolhall.apply(state, played.ruling)
        assert state.reason and state.winner in (0, 1, None)


def test_says_what_the_program_says(program):
    state = new_game(rack_seed=3)
    move = Move(Shot(0, 5, 10, 90, 9), None, (0.558, 0.5))
    played = play(state, move)
    document = {"state": state.to_dict(), "cue_ball": {"x": 0.558, "y": 0.5},
                "shot": move.shot._asdict()}
    told = json.loads(subprocess.run([program, "judge", "-"], input=json.dumps(document), text=True,
                                     capture_output=True, check=True).stdout)
    assert told["state"] == played.state.to_dict()
    assert told["ruling"]["fouls"] == played.ruling.fouls
    assert told["ruling"]["pocketed"] == played.ruling.pocketed
    assert told["events"] == played.simulation.log()


def test_the_state_says_what_it_is():
    state = new_game("9-ball", rack_seed=1)
    assert state.rules == "9-ball" and state.balls.shape == (10, 2) and state.turn == 1
    assert state.legal()["calls"] == ["none"] and state.pocketed == {}
    assert state.winner is None and not state.is_over and state.group_of(0) is None
    over = state.ended(1, "conceded")
    assert over.is_over and over.winner == 1 and over.reason == "conceded"
    assert "over" in repr(over) and "break" in repr(state)
    assert new_game(rack_seed=1) == new_game(rack_seed=1) != new_game(rack_seed=2)


BREAK = Move(Shot(0, 5, 10, 90, 9), None, (0.558, 0.5))
REFUSED = [
    (BREAK._replace(cue_ball=(0.5, 1.0)), "bad_cue_ball_position", "/cue_ball/y"),
    (BREAK._replace(call="safety"), "bad_call", "/call"),
    (BREAK._replace(call="jump"), "invalid_params", "/moves/0/call"),
    (BREAK._replace(call=(3, "middle")), "invalid_params", "/moves/0/call/pocket"),
    (BREAK._replace(call=(3,)), "invalid_params", "/moves/0/call"),
    (BREAK._replace(cue_ball=(0.5,)), "invalid_params", "/moves/0/cue_ball"),
    (BREAK._replace(shot=Shot(v=20)), "bad_shot", "/shot/v"),
    (BREAK._replace(shot=(1, 2)), "invalid_params", "/moves/0/shot"),
]


@pytest.mark.parametrize("move,code,field", REFUSED)
def test_refuses_with_the_wire_s_codes(move, code, field):
    with pytest.raises(Error) as caught:
        play(new_game(), move)
    assert (caught.value.code, caught.value.field) == (code, field)


def test_refuses_states_and_logs_that_cannot_be():
    state = new_game().to_dict()
    other = json.loads(json.dumps(state))
    other["balls"][3]["x"] = other["balls"][4]["x"]
    other["balls"][3]["y"] = other["balls"][4]["y"]
    for wrong, field in ((other, "/state/balls"), ({}, "/state"), ({**state, "kind": "tea"}, "/state/kind"),
                         ({**state, "turn": float("nan")}, "/state")):
        with pytest.raises(Error) as caught:
            GameState.from_dict(wrong)
        assert caught.value.code == "invalid_params" and caught.value.field.startswith(field)
    played = play(new_game(), BREAK)
    with pytest.raises(Error) as caught:
        judge(new_game(), played.simulation.log()[1:], None, BREAK.cue_ball)
    assert (caught.value.code, caught.value.fault) == ("invalid_params", "bad_event_log")
    with pytest.raises(Error) as caught:
        judge(new_game(), [{"t": 1}], None, BREAK.cue_ball)
    assert caught.value.field.startswith("/events/0")
    with pytest.raises(Error) as caught:
        new_game().decide("accept")
    assert caught.value.code == "bad_decision"
    for arguments, field in ((dict(rules="snooker"), "/rules"), (dict(breaker=2), "/breaker"),
                             (dict(rack_gap=1), "/rack_gap"), (dict(rack_seed=2**60), "/rack_seed")):
        with pytest.raises(Error) as caught:
            new_game(**arguments)
        assert caught.value.field.endswith(field)


def test_a_turn_can_be_lost_without_a_shot():
    ruling = poolhall.judge_lost_turn(new_game(), "shot_time_exceeded")
    assert ruling.fouls[0]["code"] == "shot_time_exceeded" and ruling.next.to_move == 1
    with pytest.raises(Error):
        poolhall.judge_lost_turn(new_game(), "scratch")
    with pytest.raises(Error) as caught:
        poolhall.judge_lost_turn(new_game().ended(0, "conceded"), "shot_time_exceeded")
    assert caught.value.code == "game_over"


def test_rehearses_moves_under_noise():
    state = new_game(rack_seed=3)
    moves = [BREAK, BREAK._replace(shot=Shot(0, 5, 10, 90, 3)), BREAK._replace(shot=Shot(v=99))]
    told = poolhall.rehearse(state, moves, noise="olympiad", samples=40, seed=5)
    assert told.samples.tolist() == [40, 40, 0]
    assert told.refused[:2] == [None, None] and told.refused[2].code == "bad_shot"
    by_hand = [play(state, BREAK, noise="olympiad", seed=5, sample=i) for i in range(40)]
    assert told.fouls[0] == sum(bool(p.ruling.fouls) for p in by_hand)
    assert told.goes_on[0] == sum(p.state.to_move == 0 and not p.ruling.fouls and not p.state.is_over
                                  for p in by_hand)
    again = poolhall.rehearse(state, moves, noise="olympiad", samples=40, seed=5, threads=3)
    assert np.array_equal(again.goes_on, told.goes_on) and np.array_equal(again.fouls, told.fouls)


def test_many_turns_at_once_are_the_same_as_one_after_another():
    states = [new_game(rack_seed=i) for i in range(6)]
    moves = [BREAK] * 5 + [BREAK._replace(shot=Shot(v=99))]
    many = poolhall.play_many(states, moves, noise="high", seeds=[4] * 6, threads=2)
    assert isinstance(many[5], Error)
    for i in range(5):
        alone = play(states[i], moves[i], noise="high", seed=4, sample=i)
        assert many[i].executed == alone.executed and many[i].ruling == alone.ruling
