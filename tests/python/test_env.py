"""The environments: Gymnasium's interface, seeds, games played to their ends."""
import numpy as np
import poolhall
import pytest
from poolhall import Error, Move, Shot
from poolhall.env import PoolEnv, VectorPoolEnv


def rollout(env, seed, steps):
    env.action_space.seed(seed)
    observation, info = env.reset(seed=seed)
    seen = [observation]
    for _ in range(steps):
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        assert env.observation_space.contains(observation), observation
        assert isinstance(reward, float) and isinstance(info, dict)
        seen.append(observation)
        if terminated or truncated:
            break
    return seen


def equal(one, other):
    return all(np.array_equal(one[key], other[key]) for key in one)


@pytest.mark.parametrize("rules", ["8-ball", "9-ball"])
def test_random_actions_play_on(rules):
    env = PoolEnv(rules, max_steps=60)
    games = [rollout(env, seed, 60) for seed in range(4)]
    assert sum(map(len, games)) > 15 and not equal(games[0][0], games[0][2])
    assert env.action_space.contains(env.action_space.sample())


def test_a_seed_fixes_everything():
    first, again = (rollout(PoolEnv(), 11, 15) for _ in range(2))
    other = rollout(PoolEnv(), 12, 15)
    assert len(first) == len(again) and all(map(equal, first, again))
    assert not all(map(equal, first, other))
    env = PoolEnv()
    env.reset(seed=1)
    one = env.reset()[0]
    env.reset(seed=1)
    assert equal(env.reset()[0], one)  # without a seed the same stream goes on


def test_options_begin_where_one_likes():
    state = poolhall.new_game("9-ball", rack_seed=4, breaker=1)
    env = PoolEnv("9-ball", noise=None)
    _, info = env.reset(seed=1, options={"state": state})
    assert env.state == state and info["to_move"] == 1
    env.reset(seed=1, options={"rack_seed": 4, "breaker": 1})
    assert env.state == state


def test_a_step_is_the_shot_that_the_package_plays():
    env = PoolEnv(noise=None, strict=True)
    env.reset(seed=2)
    state = env.state
    action = {"shot": np.array([0, 5, 10, 90, 9.0]), "cue_ball": np.array([0.558, 0.5]), "call": 0}
    played = poolhall.play(state, Move(Shot(0, 5, 10, 90, 9), None, (0.558, 0.5)))
    observation, _, _, _, info = env.step(action)
    assert info["executed"] == played.executed and info["mended"] == []
    if played.state.kind != "decision":
        assert env.state == played.state
    assert np.array_equal(observation["on_table"], ~np.isnan(env.state.balls[:, 0]))


def test_strict_refuses_and_the_third_refusal_is_a_foul():
    env = PoolEnv(strict=True)
    env.reset(seed=2)
    bad = {"shot": np.array([0, 5, 10, 90, 99.0]), "cue_ball": np.array([0.558, 0.5]), "call": 0}
    for _ in range(2):
        _, _, _, _, info = env.step(bad)
        assert info["refused"] == "bad_shot" and info["to_move"] == 0
    _, _, _, _, info = env.step(bad)
    assert info["fouls"] == ["too_many_refusals"] and info["to_move"] == 1


def test_mends_what_cannot_be_played_and_says_so():
    env = PoolEnv()
    env.reset(seed=2)
    bad = {"shot": np.array([0, 5, 10, 90, 99.0]), "cue_ball": np.array([0.558, 2.0]), "call": 20}
    _, _, _, _, info = env.step(bad)
    assert info["mended"] == ["call", "cue_ball", "shot"] and "refused" not in info


def test_an_opponent_answers_inside_step():
    turns = []

    def opponent(turn):
        turns.append(turn.state.to_move)
        balls = turn.state.balls
        place = None
        if turn.kind != "shot":
            place = max(((x, 0.2) for x in np.linspace(0.1, 1, 10)), key=lambda spot: np.nanmin(
                np.linalg.norm(balls[1:] - spot, axis=1)))
            balls[0] = place
        call = "safety" if "safety" in turn.legal["calls"] else None
        shot, _ = poolhall.nearest_shot(balls, Shot(phi=80 + turn.turn % 20, v=4))
        return Move(shot, call, place)

    for seat in (0, 1):
        env = PoolEnv(opponent=opponent, seat=seat, max_steps=30)
        env.action_space.seed(1)
        _, info = env.reset(seed=1)
        for _ in range(12):
            assert info["to_move"] == seat
            _, _, terminated, truncated, info = env.step(env.action_space.sample())
            if terminated or truncated:
                break
        assert set(turns) == {1 - seat}
        turns.clear()


def test_a_won_game_is_worth_one():
    state = poolhall.new_game(rack_seed=1).to_dict()
    for ball in state["balls"]:
        if 1 <= ball["id"] <= 7:
            ball.pop("x"), ball.pop("y")
            ball["pocket"] = "side_left"
    state["balls"][0].update(x=0.558, y=1.2)
    state["balls"][8].update(x=0.3, y=2.0)
    state.update(kind="shot", groups=["solids", "stripes"], open_table=False, turn=9,
                 ball_in_hand=None)
    start = poolhall.GameState.from_dict(state)
    corner = poolhall.Table().pockets["foot_left"]
    eight = np.array([0.3, 2.0])
    away = (eight - corner) / np.linalg.norm(eight - np.array(corner))
    way = eight + 2 * 0.028575 * away - np.array([0.558, 1.2])
    phi = np.degrees(np.arctan2(way[1], way[0]))
    env = PoolEnv(noise=None)
    for turn in np.linspace(-0.6, 0.6, 61):  # throw: one of them goes in
        env.reset(seed=1, options={"state": start})
        action = {"shot": np.array([0, 0, 5, phi + turn, 2]), "cue_ball": np.zeros(2),
                  "call": 1 + 6 * 8 + poolhall.POCKETS.index("foot_left")}
        _, reward, terminated, _, _ = env.step(action)
        if reward == 1.0:
            assert terminated and env.state.winner == 0
            with pytest.raises(Error):
                env.step(action)
            return
    pytest.fail("the 8 never went in")


def test_many_games_at_once_are_the_same_for_any_number_of_threads():
    def run(threads):
        env = VectorPoolEnv(4, threads=threads, max_steps=6)
        env.action_space.seed(5)
        observation, _ = env.reset(seed=5)
        out = [observation]
        for _ in range(10):
            observation, rewards, terminated, truncated, infos = env.step(env.action_space.sample())
            assert rewards.shape == terminated.shape == truncated.shape == (4,)
            assert observation["balls"].shape == (4, 16, 2)
            assert len(infos["turn"]) == 4
            out.append(observation)
        return out, truncated

    one, _ = run(1)
    two, _ = run(2)
    assert all(map(equal, one, two))


def test_a_game_of_a_vector_is_the_game_alone_and_begins_again_by_itself():
    vector, alone = VectorPoolEnv(2, max_steps=3), PoolEnv(max_steps=3)
    seen, _ = vector.reset(seed=[8, 9])
    first, _ = alone.reset(seed=9)
    assert np.array_equal(seen["balls"][1], first["balls"])
    vector.action_space.seed(1)
    for step in range(5):
        action = vector.action_space.sample()
        seen, rewards, terminated, truncated, _ = vector.step(action)
        if step < 3:
            mine, _, _, over, _ = alone.step({key: action[key][1] for key in action})
            assert np.array_equal(seen["balls"][1], mine["balls"]) and over == truncated[1]
        if step == 3:
            assert seen["kind"].tolist() == [0, 0] and rewards.tolist() == [0, 0]


def test_checks_its_arguments():
    for wrong, field in ((dict(seat=2), "/seat"), (dict(max_steps=0), "/max_steps"),
                         (dict(noise="loud"), "/noise")):
        with pytest.raises(Error) as caught:
            PoolEnv(**wrong)
        assert caught.value.field == field
    with pytest.raises(Error):
        PoolEnv().step({})
    with pytest.raises(Error):
        VectorPoolEnv(0)
