"""Environments for learners, by Gymnasium's interface, with or without Gymnasium installed.

    env = poolhall.env.PoolEnv(noise="olympiad")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

One step is one shot, on the server's physics and by its referee. Without an `opponent` the agent
plays both seats in turn: everything in an observation is seen by who is to move, and a reward
belongs to who has just played. With one, the opponent answers inside `step` and the agent has
`seat`. Decisions (after an illegal break, say) are taken by `decide`.

An action need not be playable: by default the nearest stroke, place and call that are allowed are
played, and info["mended"] names what was mended. With strict=True they are refused as on a server:
info["refused"] has the code, and the third refusal of a turn is a foul.
"""
from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import _core, spaces
from .agent import GameInfo, Turn
from .errors import Error
from .evaluation import nearest_shot
from .moves import Move, Shot, as_move
from .referee import Played, judge_lost_turn, play_many

__all__ = ["PoolEnv", "VectorPoolEnv"]

KINDS = ("break", "shot", "ball_in_hand", "ball_in_hand_behind_head_string")
GROUPS = (None, "solids", "stripes")
MAX_REFUSALS = 3

if spaces.HAS_GYMNASIUM:
    import gymnasium
    _Base: Any = gymnasium.Env
    _VectorBase: Any = gymnasium.vector.VectorEnv
else:
    _Base = _VectorBase = object


def first_option(options: List[str]) -> str:
    """The first choice that is offered: play on as the table lies, where that is one."""
    return options[0]


def outcome_reward(played: Played, seat: int) -> float:
    """1 for a won game, -1 for a lost one, else 0."""
    state = played.state
    return 0.0 if not state.is_over or state.winner is None else 1.0 if state.winner == seat else -1.0


def observation_space(table: _core.Table) -> Any:
    """What an observation is: see `PoolEnv`."""
    far = max(table.width, table.length)
    return spaces.Dict({
        "balls": spaces.Box(-1.0, far, (16, 2), np.float64),
        "on_table": spaces.MultiBinary(16),
        "kind": spaces.Discrete(len(KINDS)),
        "group": spaces.Discrete(len(GROUPS)),
        "callable": spaces.MultiBinary(16),
        "first_balls": spaces.MultiBinary(16),
        "noise": spaces.Box(0.0, 1000.0, (5,), np.float64),
    })


def action_space(table: _core.Table) -> Any:
    """What an action is: see `PoolEnv`."""
    radius = 1000 * table.ball_radius
    return spaces.Dict({
        "shot": spaces.Box(np.array([-radius, -radius, 0.0, 0.0, 0.01]),
                           np.array([radius, radius, 90.0, 360.0, table.max_cue_speed]),
                           dtype=np.float64),
        "cue_ball": spaces.Box(np.zeros(2), np.array([table.width, table.length]),
                               dtype=np.float64),
        "call": spaces.Discrete(1 + 16 * len(_core.POCKETS)),
    })


class _Game:
    """One game of an environment: what is pending, and how it goes on."""

    def __init__(self, settings: "_Settings", random: np.random.Generator):
        self.settings = settings
        self.random = random
        self.start({})

    def start(self, options: Dict[str, Any]) -> None:
        s = self.settings
        self.refusals = self.steps = self.shots = 0
        self.seed = int(self.random.integers(2**53))
        rack_seed = options.get("rack_seed", int(self.random.integers(2**53)))
        self.state = options.get("state") or _core.new_game(
            s.rules, s.table, breaker=options.get("breaker", 0), rack_seed=rack_seed,
            rack_gap=s.rack_gap)
        self.settle()

    def settle(self) -> None:
        """Takes the decisions that are due."""
        while not self.state.is_over and self.state.kind == "decision":
            choice = self.settings.decide(self.state.options)
            self.state = self.state.decide(choice, self.settings.table)

    @property
    def awaits_opponent(self) -> bool:
        s = self.settings
        return s.opponent is not None and not self.state.is_over and self.state.to_move != s.seat

    def observe(self) -> Dict[str, Any]:
        state = self.state
        balls = np.full((16, 2), -1.0)
        places = state.balls
        on_table = np.zeros(16, np.int8)
        on_table[:len(places)] = ~np.isnan(places[:, 0])
        balls[on_table == 1] = places[on_table[:len(places)] == 1]
        legal = {} if state.is_over else state.legal()
        return {
            "balls": balls, "on_table": on_table,
            "kind": np.int64(KINDS.index(state.kind) if state.kind in KINDS else 1),
            "group": np.int64(GROUPS.index(state.group_of(state.to_move))),
            "callable": _mask(legal.get("balls", ())),
            "first_balls": _mask(legal.get("first_balls", ())),
            "noise": np.array(self.settings.noise),
        }

    def info(self) -> Dict[str, Any]:
        return {"to_move": self.state.to_move, "turn": self.state.turn}

    def move_of(self, action: Dict[str, Any]) -> Tuple[Move, List[str]]:
        """The move of an action, and what of it had to be mended."""
        shot = Shot(*(float(x) for x in np.asarray(action["shot"], float).reshape(5)))
        call = _call_of(int(action["call"]))
        place = (None if self.state.kind == "shot" else
                 tuple(float(x) for x in np.asarray(action["cue_ball"], float).reshape(2)))
        if self.settings.strict:
            return Move(shot, call or self._no_call(), place), []
        return self._mended(shot, call, place)

    def _no_call(self) -> Optional[str]:
        calls = self.state.legal()["calls"]
        return "safety" if "safety" in calls and "none" not in calls else None

    def _mended(self, shot: Shot, call: Any, place: Any) -> Tuple[Move, List[str]]:
        table, legal, mended = self.settings.table, self.state.legal(), []
        if call is None or "pocket" not in legal["calls"] or call[0] not in legal["balls"]:
            mended += ["call"] if call is not None else []
            call = self._no_call()
        if place is not None:
            free = self._free_place(place)
            mended += ["cue_ball"] if free != place else []
            place = free
        balls = self.state.balls
        if place is not None:
            balls[0] = place
        shot, is_moved = nearest_shot(balls, shot, table)
        return Move(shot, call, place), mended + (["shot"] if is_moved else [])

    def _free_place(self, place: Tuple[float, float]) -> Tuple[float, float]:
        """The place, or one near it where the cue ball may be put down."""
        table, radius = self.settings.table, self.settings.table.ball_radius
        is_kitchen = self.state.kind in ("break", "ball_in_hand_behind_head_string")
        top = table.head_string - 1e-6 if is_kitchen else table.length - radius
        low, high = np.array([radius, radius]), np.array([table.width - radius, top])
        for spread in np.linspace(0, 1, 200):
            offset = spread * table.length * self.random.uniform(-1, 1, 2) if spread else np.zeros(2)
            x, y = np.clip(np.array(place) + offset, low, high)
            try:
                self.state.prepare(self._some_call(), (x, y), table)
                return float(x), float(y)
            except Error:
                continue
        return place

    def _some_call(self) -> Any:
        calls = self.state.legal()["calls"]
        return None if "none" in calls else calls[-1] if calls[-1] != "pocket" else "safety"

    def turn(self) -> Turn:
        """What an opponent is asked."""
        s, state = self.settings, self.state
        info = GameInfo(0, 0, None, state.to_move, "environment", s.rules, s.table, s.noise,
                        {"game_ms": 0, "increment_ms": 0, "shot_ms": None})
        return Turn(info, state, state.turn, state.kind, state.legal(), 0, 0, self.refusals)

    def take(self, result: Any) -> Tuple[float, Dict[str, Any]]:
        """What a move brought: its reward for who played it, and what is to be told."""
        seat = self.state.to_move
        if isinstance(result, Error):
            self.refusals += 1
            info = {"refused": result.code}
            if self.refusals >= MAX_REFUSALS:
                ruling = judge_lost_turn(self.state, "too_many_refusals", self.settings.table)
                self._go_on(ruling.next)
                info["fouls"] = [foul["code"] for foul in ruling.fouls]
            return 0.0, info
        self.shots += 1
        reward = float(self.settings.reward(result, seat))
        info = {"fouls": [foul["code"] for foul in result.ruling.fouls],
                "pocketed": [p["ball"] for p in result.ruling.pocketed],
                "executed": result.executed}
        self._go_on(result.state)
        return reward, info

    def _go_on(self, state: _core.GameState) -> None:
        self.state = state
        self.refusals = 0
        self.settle()


class _Settings:
    def __init__(self, rules: str, table: Optional[_core.Table], noise: Any,
                 opponent: Optional[Callable[[Turn], Any]], seat: int, strict: bool,
                 reward: Callable[[Played, int], float], decide: Callable[[List[str]], str],
                 max_steps: int, rack_gap: float):
        if seat not in (0, 1):
            raise Error("invalid_params", f"expected seat 0 or 1, got {seat!r}", "/seat")
        if max_steps < 1:
            raise Error("invalid_params", f"expected at least 1, got {max_steps}", "/max_steps")
        self.rules, self.opponent, self.seat, self.strict = rules, opponent, seat, strict
        self.table = _core.Table() if table is None else table
        self.noise = _noise_of(noise)
        self.reward, self.decide, self.max_steps, self.rack_gap = reward, decide, max_steps, rack_gap


def _noise_of(noise: Any) -> tuple:
    return tuple(float(x) for x in _core.noise_level(noise))


def _mask(balls: Any) -> np.ndarray:
    mask = np.zeros(16, np.int8)
    mask[list(balls)] = 1
    return mask


def _call_of(number: int) -> Optional[Tuple[int, str]]:
    if number == 0:
        return None
    ball, pocket = divmod(number - 1, len(_core.POCKETS))
    return ball, _core.POCKETS[pocket]


def _advance(games: List[_Game], moves: List[Move], threads: int) -> List[Tuple[float, Dict[str, Any]]]:
    """Plays one move in each game, and what opponents answer until it is the agent's turn."""
    def played(some: List[_Game], their_moves: List[Move]) -> list:
        return play_many([g.state for g in some], their_moves, games[0].settings.table,
                         noise=games[0].settings.noise, seeds=[g.seed for g in some],
                         samples=[g.shots for g in some], threads=threads)

    told = [game.take(result) for game, result in zip(games, played(games, moves))]
    waiting = [i for i, game in enumerate(games) if game.awaits_opponent]
    while waiting:
        some = [games[i] for i in waiting]
        answers = [as_move(game.settings.opponent(game.turn())) for game in some]
        for i, result in zip(waiting, played(some, answers)):
            reward, _ = games[i].take(result)
            told[i] = (told[i][0] - reward, told[i][1])
        waiting = [i for i in waiting if games[i].awaits_opponent]
    return told


def _opening(games: List[_Game], threads: int) -> None:
    """An opponent that breaks."""
    for game in games:
        while game.awaits_opponent:
            result = play_many([game.state], [as_move(game.settings.opponent(game.turn()))],
                               game.settings.table, noise=game.settings.noise, seeds=[game.seed],
                               samples=[game.shots], threads=threads)[0]
            game.take(result)


class PoolEnv(_Base):
    """8-ball or nine-ball, one shot a step; see the module.

    An observation: `balls` (16, 2) x, y in m, -1 where a ball is not on the table; `on_table`;
    `kind` of the turn (0 break, 1 shot, 2 ball in hand, 3 ball in hand behind the head string);
    `group` of who is to move (0 open, 1 solids, 2 stripes); `callable` balls; legal `first_balls`;
    `noise`, standard deviations of a, b, theta, phi, v in mm, degrees and m/s.

    An action: `shot` (5,) a, b, theta, phi, v in mm, degrees and m/s; `cue_ball` (2,) x, y in m,
    used where it is in hand; `call`, 0 for none (a safety where one must call), else
    1 + 6 * ball + index of the pocket in poolhall.POCKETS.

    reset's options: state (a GameState to begin with), breaker, rack_seed. reward: called with the
    Played and the seat of who played. An episode is truncated after `max_steps`.
    """

    metadata: Dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(self, rules: str = "8-ball", table: Optional[_core.Table] = None, *,
                 noise: Any = "olympiad", opponent: Optional[Callable[[Turn], Any]] = None,
                 seat: int = 0, strict: bool = False,
                 reward: Callable[[Played, int], float] = outcome_reward,
                 decide: Callable[[List[str]], str] = first_option, max_steps: int = 500,
                 rack_gap: float = 0.0):
        self._settings = _Settings(rules, table, noise, opponent, seat, strict, reward, decide,
                                   max_steps, rack_gap)
        self.observation_space = observation_space(self._settings.table)
        self.action_space = action_space(self._settings.table)
        self._game: Optional[_Game] = None
        self._is_over = True

    @property
    def state(self) -> _core.GameState:
        """The game as it stands, for those who want more than the observation."""
        return self._current().state

    def _current(self) -> _Game:
        if self._game is None:
            raise Error("invalid_request", "reset() comes before the first step()")
        return self._game

    def reset(self, *, seed: Optional[int] = None,
              options: Optional[Dict[str, Any]] = None) -> Tuple[dict, dict]:
        if spaces.HAS_GYMNASIUM:
            super().reset(seed=seed)
        elif seed is not None or self._game is None:
            self.np_random = np.random.default_rng(seed)
        self._game = _Game(self._settings, self.np_random)
        if options:
            self._game.start(options)
        _opening([self._game], 1)
        self._is_over = False
        return self._game.observe(), self._game.info()

    def step(self, action: Dict[str, Any]) -> Tuple[dict, float, bool, bool, dict]:
        game = self._current()
        if self._is_over:
            raise Error("invalid_request", "the episode is over; reset() begins another one")
        move, mended = game.move_of(action)
        (reward, told), = _advance([game], [move], 1)
        game.steps += 1
        terminated = game.state.is_over
        truncated = not terminated and game.steps >= self._settings.max_steps
        self._is_over = terminated or truncated
        return (game.observe(), reward, terminated, truncated,
                {**game.info(), **told, "mended": mended})

    def close(self) -> None:
        self._game = None


class VectorPoolEnv(_VectorBase):
    """`num_envs` games at once, their shots played by `threads` threads (0: one a core).

    As Gymnasium's vector environments with autoreset on the next step: the step after an
    episode's end ignores that game's action, begins a new game and gives reward 0. Arrays have one
    more dimension in front; infos are a dict of lists, one entry a game. The other settings are
    those of PoolEnv.
    """

    def __init__(self, num_envs: int, *, threads: int = 0, **settings: Any):
        if num_envs < 1:
            raise Error("invalid_params", f"expected at least 1, got {num_envs}", "/num_envs")
        self.num_envs = num_envs
        self._threads = threads
        self._settings = PoolEnv(**settings)._settings
        self.single_observation_space = observation_space(self._settings.table)
        self.single_action_space = action_space(self._settings.table)
        self.observation_space = spaces.batch_space(self.single_observation_space, num_envs)
        self.action_space = spaces.batch_space(self.single_action_space, num_envs)
        self.metadata = {"render_modes": [], "autoreset_mode": _autoreset_mode()}
        self._games: List[_Game] = []
        self._ended = np.zeros(num_envs, bool)

    def reset(self, *, seed: Any = None,
              options: Optional[Dict[str, Any]] = None) -> Tuple[dict, dict]:
        """`seed`: one for all (game i gets seed + i), or a list of one for each."""
        if seed is None and self._games:
            randoms = [game.random for game in self._games]
        else:
            seeds = ([None] * self.num_envs if seed is None else
                     [seed + i for i in range(self.num_envs)] if np.ndim(seed) == 0 else list(seed))
            if len(seeds) != self.num_envs:
                raise Error("invalid_params", f"expected {self.num_envs} seeds, got {len(seeds)}",
                            "/seed")
            randoms = [np.random.default_rng(s) for s in seeds]
        self._games = [_Game(self._settings, random) for random in randoms]
        for game in self._games if options else []:
            game.start(options or {})
        _opening(self._games, self._threads)
        self._ended[:] = False
        return self._observe(), self._infos([{}] * self.num_envs)

    def step(self, actions: Dict[str, Any]) -> Tuple[dict, np.ndarray, np.ndarray, np.ndarray, dict]:
        if not self._games:
            raise Error("invalid_request", "reset() comes before the first step()")
        rewards = np.zeros(self.num_envs)
        told: List[Dict[str, Any]] = [{} for _ in self._games]
        playing = [i for i in range(self.num_envs) if not self._ended[i]]
        moves = []
        for i in playing:
            move, mended = self._games[i].move_of({k: actions[k][i] for k in
                                                   ("shot", "cue_ball", "call")})
            moves.append(move)
            told[i]["mended"] = mended
        for i in np.flatnonzero(self._ended):
            self._games[i].start({})
            _opening([self._games[i]], self._threads)
        if playing:
            results = _advance([self._games[i] for i in playing], moves, self._threads)
            for i, (reward, info) in zip(playing, results):
                rewards[i] = reward
                told[i].update(info)
                self._games[i].steps += 1
        terminations = np.array([game.state.is_over for game in self._games])
        truncations = ~terminations & np.array(
            [game.steps >= self._settings.max_steps for game in self._games])
        self._ended = terminations | truncations
        return self._observe(), rewards, terminations, truncations, self._infos(told)

    def _observe(self) -> dict:
        seen = [game.observe() for game in self._games]
        return {key: np.stack([one[key] for one in seen]) for key in seen[0]}

    def _infos(self, told: List[Dict[str, Any]]) -> dict:
        whole = [{**game.info(), **one} for game, one in zip(self._games, told)]
        keys = {key for one in whole for key in one}
        return {key: np.array([one.get(key) for one in whole] + [None], object)[:-1]
                for key in sorted(keys)}

    def close(self, **_: Any) -> None:
        self._games = []


def _autoreset_mode() -> Any:
    if spaces.HAS_GYMNASIUM and hasattr(gymnasium.vector, "AutoresetMode"):
        return gymnasium.vector.AutoresetMode.NEXT_STEP
    return "NextStep"
