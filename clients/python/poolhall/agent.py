"""One agent's conversation with a server, without sockets, threads and clocks.

Messages come in (`Agent.message_came`), messages and thoughts go out (`Outside`). An agent outlives
its connections: games, unconfirmed answers and the token stay, so that after a new login
everything that was pending is sent again as it was. `poolhall.client` puts a network around it.
"""
from __future__ import annotations

import hashlib
import secrets
from collections import OrderedDict
from dataclasses import dataclass, replace
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Protocol, Sequence, Set, Union

from . import _core
from .errors import Error
from .moves import Move, Shot

RETRY_SECONDS = 0.25
#: A player whose moves are refused so often in one turn will not find one.
HOPELESS_REFUSALS = 10
_REFUSALS = {"bad_shot", "bad_call", "bad_cue_ball_position", "bad_decision", "invalid_params"}

# What a table and its materials are made of. A later server may tell more; that is left out.
_PARTS = set("""
    name width length pockets nose_height head_string foot_spot x y kind corner side cushion_width
    angle depth radius jaw_radius gravity ball_radius ball_mass mu_slide mu_roll mu_spin
    spin_deceleration ball_restitution ball_friction cushion model normal tangential spin
    restitution friction stiffness damping_ratio cue_mass tip_restitution squirt_end_mass_ratio
    miscue_limit max_cue_speed separation_speed
""".split())


def _known(part: Any) -> Any:
    if not isinstance(part, dict):
        return part
    return {name: _known(value) for name, value in part.items() if name in _PARTS}


class Concede:
    """What `choose` returns to give the game up."""


@dataclass(frozen=True)
class GameInfo:
    """What is fixed for a game.

    `noise` is (a, b, theta, phi, v), standard deviations in mm, degrees and m/s, or None where the
    tournament does not tell. `clock` is {game_ms, increment_ms, shot_ms}.
    """

    game: int
    match: int
    tournament: Optional[int]
    seat: int
    opponent: str
    rules: str
    table: _core.Table
    noise: Optional[tuple]
    clock: dict


@dataclass(frozen=True)
class Turn:
    """A turn of this player's.

    `legal` is {"balls", "first_balls", "calls"} or {"decisions"}; `own_ms` and `opponent_ms` are
    the clocks as the turn came; `refusals` counts moves of this turn that were refused.
    """

    info: GameInfo
    state: _core.GameState
    turn: int
    kind: str
    legal: dict
    own_ms: int
    opponent_ms: int
    refusals: int


class GameEnd(NamedTuple):
    """How a game ended: `winner` is a seat, or None; `won` is about this player."""

    game: int
    opponent: str
    won: bool
    winner: Optional[int]
    reason: str
    scored: bool


class End(NamedTuple):
    """Why an agent is done for good: "finished", "superseded", "refused" or "stopped"."""

    ending: str
    reason: str
    games: List[GameEnd]


Choice = Union[Move, Shot, str, Concede]


class Outside(Protocol):
    """What an agent needs from the world."""

    def send(self, message: dict) -> None: ...

    def think(self, game: int, turn: Turn) -> None:
        """Let the player choose, then call `Agent.move_chosen(game, turn, choice)`."""

    def wake(self, game: int, seconds: float) -> None:
        """Call `Agent.send_answer_again(game)` later."""


@dataclass
class Settings:
    name: str
    token: Optional[str] = None
    challenges: Sequence[dict] = ()
    tournaments: Sequence[int] = ()
    games: Optional[int] = None
    accept_challenges: bool = True
    own_noise: bool = True
    detail: str = "summary"
    log: Callable[[str], None] = lambda line: None
    on_game_over: Callable[[GameEnd], None] = lambda end: None
    on_message: Callable[[str, dict], None] = lambda method, params: None


@dataclass
class _Desk:
    """One game's memory: whose turn, what is thought about, the answer not confirmed yet."""

    info: GameInfo
    turn: Optional[Turn] = None
    answer: Optional[tuple] = None  # method, params
    is_thinking: bool = False

    def over(self, number: int) -> None:
        if self.turn is not None and self.turn.turn <= number:
            self.turn = self.answer = None


@dataclass
class _InFlight:
    method: str
    game: Optional[int] = None
    turn: int = 0
    refusals: int = 0
    index: int = 0


def json_number(value: Any, name: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise Error("invalid_params", f"expected a number, got {value!r}", name) from None
    if number != number or number in (float("inf"), float("-inf")):
        raise Error("invalid_params", f"expected a finite number, got {number}", name)
    return number


def _answer(info: GameInfo, turn: Turn, choice: Choice) -> tuple:
    """The request of a choice; the same shot_id for the same attempt, however often it is sent."""
    base = {"game": info.game, "turn": turn.turn}
    if isinstance(choice, Concede) or choice is Concede:
        return "concede", {"game": info.game}
    if isinstance(choice, str):
        return "decide", {**base, "choice": choice}
    if isinstance(choice, Shot):
        choice = Move(choice)
    if not isinstance(choice, Move):
        raise Error("invalid_params", "expected a Move, a Shot, a decision's name or Concede from "
                    f"the player, got {type(choice).__name__}", "/choice")
    shot = choice.shot
    values = [shot[key] for key in Shot._fields] if isinstance(shot, dict) else list(shot)
    if len(values) != 5:
        raise Error("invalid_params", f"expected five numbers, got {len(values)}", "/choice/shot")
    params = {key: json_number(value, "/choice/shot/" + key)
              for key, value in zip(Shot._fields, values)}
    request = {**base, "shot_id": f"t{turn.turn}r{turn.refusals}", "params": params,
               "call": _call(choice.call)}
    if choice.cue_ball is not None:
        x, y = ((choice.cue_ball["x"], choice.cue_ball["y"]) if isinstance(choice.cue_ball, dict)
                else choice.cue_ball)
        request["cue_ball"] = {"x": json_number(x, "/choice/cue_ball/x"),
                               "y": json_number(y, "/choice/cue_ball/y")}
    return "shot", request


def _call(call: Any) -> Any:
    if call is None or isinstance(call, str):
        return call
    ball, pocket = (call["ball"], call["pocket"]) if isinstance(call, dict) else call
    return {"ball": int(ball), "pocket": str(pocket)}


class Agent:
    """See the module. The methods are called by one thread."""

    def __init__(self, settings: Settings, outside: Outside):
        self.settings = settings
        self.outside = outside
        self.token = settings.token or secrets.token_hex(32)
        self.games: List[GameEnd] = []
        self.logged_in = False
        self._may_be_registered = settings.token is not None
        self._stage = "hello"
        self._next_id = 1
        self._in_flight: Dict[int, _InFlight] = {}
        self._desks: Dict[int, _Desk] = {}
        self._finished: Set[int] = set()
        self._done: Set[tuple] = set()  # wishes that the server has heard
        self._challenge_ids = [secrets.token_hex(16) for _ in settings.challenges]
        self._secrets: "OrderedDict[str, str]" = OrderedDict()  # commitment: bytes

    # ---- Sessions ----

    def begin_session(self) -> None:
        """On a fresh connection."""
        self._in_flight.clear()
        self.logged_in = False
        client = {"name": "poolhall-python", "version": _core.__version__}
        self._ask("hello", {"protocol": [1, 1], "name": self.settings.name, "client": client,
                            "detail": self.settings.detail})

    def session_ended(self) -> None:
        """The connection is gone: nothing is sent until the next session."""
        self._in_flight.clear()
        self.logged_in = False

    def send_ping(self) -> None:
        if self.logged_in:
            self._ask("ping", {})

    def _ask(self, method: str, params: dict, **about: Any) -> None:
        number = self._next_id
        self._next_id += 1
        self._in_flight[number] = _InFlight(method, **about)
        self.outside.send({"jsonrpc": "2.0", "id": number, "method": method, "params": params})

    def _send_answer(self, desk: _Desk) -> None:
        if self.logged_in and desk.answer is not None and desk.turn is not None:
            method, params = desk.answer
            self._ask(method, params, game=desk.info.game, turn=desk.turn.turn,
                      refusals=desk.turn.refusals)

    def send_answer_again(self, game: int) -> None:
        if game in self._desks:
            self._send_answer(self._desks[game])

    # ---- Thinking ----

    def _think(self, desk: _Desk) -> None:
        if desk.turn is None or desk.is_thinking:
            return
        if desk.turn.refusals >= HOPELESS_REFUSALS:
            desk.answer = _answer(desk.info, desk.turn, Concede())
            self._send_answer(desk)
            return
        desk.is_thinking = True
        self.outside.think(desk.info.game, desk.turn)

    def move_chosen(self, game: int, turn: Turn, choice: Choice) -> None:
        """What the player chose in `turn`; nothing is sent if that turn is over meanwhile."""
        desk = self._desks.get(game)
        if desk is None:
            return
        desk.is_thinking = False
        if desk.turn is None:
            return
        if (desk.turn.turn, desk.turn.refusals) != (turn.turn, turn.refusals):
            self._think(desk)
            return
        desk.answer = _answer(desk.info, desk.turn, choice)
        self._send_answer(desk)

    # ---- What the server says ----

    def message_came(self, message: dict) -> Optional[End]:
        """Why the agent is done for good, if this message says so."""
        if "method" in message:
            params = message.get("params") or {}
            self.settings.on_message(message["method"], params)
            handler = self._notices.get(message["method"])
            return handler(self, params) if handler else None
        error = message.get("error")
        asked = self._in_flight.pop(message.get("id"), None) if _is_id(message) else None
        if error is not None:
            return self._error_came(Error.from_wire(error), asked)
        return self._reply_came(asked, message.get("result") or {}) if asked else None

    def _reply_came(self, asked: _InFlight, result: dict) -> Optional[End]:
        if asked.method == "hello":
            self._log_in()
        elif asked.method in ("register", "login"):
            self._logged_in(result)
        elif asked.method in ("shot", "decide", "concede"):
            if asked.game in self._desks:
                self._desks[asked.game].over(asked.turn)
        elif asked.method == "ack":
            return self._acknowledged()
        elif asked.method == "sync":
            return self._synchronised(result)
        elif asked.method in ("challenge", "tournament.join"):
            self._done.add((asked.method, asked.index))
        return None

    def _log_in(self) -> None:
        if self._may_be_registered:
            self._stage = "login"
            self._ask("login", {"token": self.token})
        else:
            self._stage = "register"
            self._may_be_registered = True  # the reply may get lost
            self._ask("register", {"name": self.settings.name, "token": self.token})

    def _logged_in(self, result: dict) -> None:
        self.logged_in = True
        self.token = result.get("token") or self.token
        self.settings.log(f"logged in as {result.get('agent')}, games under way: "
                          f"{len(result.get('games', []))}")
        self._add_to_next_noise()  # before anything that a game may come of
        for index, tournament in enumerate(self.settings.tournaments):
            if ("tournament.join", index) not in self._done:
                self._ask("tournament.join", {"tournament": tournament}, index=index)
        for index, challenge in enumerate(self.settings.challenges):
            if ("challenge", index) not in self._done:
                # One id for all repetitions: a lost reply must not become a second game.
                self._ask("challenge", {"challenge_id": self._challenge_ids[index], **challenge},
                          index=index)

    def _acknowledged(self) -> Optional[End]:
        wanted = self.settings.games
        if wanted is not None and len(self._finished) >= wanted:
            return End("finished", "all games are played", self.games)
        return None

    def _synchronised(self, result: dict) -> Optional[End]:
        self._open_desk(result)
        if result.get("over"):
            return self._game_over(result["over"])
        return self._turn_came(result["pending"]) if result.get("pending") else None

    # ---- Errors ----

    def _error_came(self, error: Error, asked: Optional[_InFlight]) -> Optional[End]:
        if error.code == "superseded":
            return End("superseded", str(error), self.games)
        if asked is None:
            self.settings.log(f"the server says {error}")
            return None
        if asked.method in ("hello", "register", "login"):
            return self._login_failed(error)
        if asked.method in ("shot", "decide", "concede"):
            self._answer_failed(error, asked)
        elif asked.method in ("challenge", "tournament.join"):
            if not error.retryable:
                return End("refused", str(error), self.games)
            self.settings.log(f"will ask again after the next login: {error}")
        elif asked.method == "ack":
            return self._acknowledged()
        else:
            self.settings.log(f"the server refused {asked.method}: {error}")
        return None

    def _login_failed(self, error: Error) -> Optional[End]:
        if self._stage == "login" and error.code == "unauthorized" and self.settings.name:
            self._stage = "register"
            self._ask("register", {"name": self.settings.name, "token": self.token})
            return None
        if error.retryable:
            self.settings.log(f"not logged in: {error}")
            return None
        return End("refused", str(error), self.games)

    def _answer_failed(self, error: Error, asked: _InFlight) -> None:
        self.settings.log(f"game {asked.game}: {error}")
        desk = self._desks.get(asked.game)
        if desk is None:
            return
        key = (asked.turn, asked.refusals)
        if error.code in _REFUSALS and not error.foul:
            if desk.turn is not None and (desk.turn.turn, desk.turn.refusals) == key:
                desk.answer = None
                desk.turn = replace(desk.turn, refusals=desk.turn.refusals + 1)
                self._think(desk)
        elif error.retryable:
            self.outside.wake(asked.game, RETRY_SECONDS)
        else:
            desk.over(asked.turn)
            if error.code == "conflicting_shot":
                # Somebody else has played this turn with our token; what is pending now?
                self._ask("sync", {"game": asked.game}, game=asked.game)

    # ---- Notifications ----

    def _open_desk(self, terms: dict) -> None:
        game = terms["game"]
        if game in self._desks or game in self._finished:
            return
        noise = terms["noise"]
        told = None if noise == "hidden" else tuple(noise[key] for key in Shot._fields)
        info = GameInfo(game, terms["match"], terms["tournament"], terms["seat"],
                        terms["opponent"], terms["rules"],
                        _core.Table(_known(terms["table"]), _known(terms["physics"])), told,
                        terms["clock"])
        self.settings.log(f"game {game} against {info.opponent}")
        self._desks[game] = _Desk(info)

    def _game_started(self, params: dict) -> None:
        self._open_desk(params)
        self._reveal(params)
        self._add_to_next_noise()

    def _state_came(self, params: dict) -> None:
        self._open_desk(params)
        if params["state"]["turn"] == 1:
            self._reveal(params)

    def _turn_came(self, params: dict) -> Optional[End]:
        desk = self._desks.get(params["game"])
        if desk is None:
            self._ask("sync", {"game": params["game"]}, game=params["game"])
            return None
        clock = params["clock"]
        state = _core.GameState.from_dict(params["state"], desk.info.table)
        turn = Turn(desk.info, state, params["turn"], params["kind"], params["legal"],
                    clock["own_ms"], clock["opponent_ms"], params["refusals"])
        is_same = desk.turn is not None and (
            (desk.turn.turn, desk.turn.refusals) == (turn.turn, turn.refusals))
        desk.turn = turn
        if not is_same:
            desk.answer = None
        if desk.answer is not None:
            self._send_answer(desk)
        else:
            self._think(desk)
        return None

    def _turn_lost(self, params: dict) -> None:
        if params["game"] in self._desks:
            self._desks[params["game"]].over(params["turn"])

    def _game_over(self, params: dict) -> Optional[End]:
        game = params["game"]
        desk = self._desks.pop(game, None)
        if desk is not None and game not in self._finished:
            end = GameEnd(game, desk.info.opponent, params["winner"] == desk.info.seat,
                          params["winner"], params["reason"], params["scored"])
            self.games.append(end)
            self.settings.log(f"game {game} is over: {end.reason}, "
                              f"{'won' if end.won else 'not won'}")
            self.settings.on_game_over(end)
        self._finished.add(game)
        self._ask("ack", {"game": game}, game=game)
        return None

    def _match_over(self, params: dict) -> None:
        self._ask("ack", {"match": params["match"]})

    def _tournament_over(self, params: dict) -> None:
        self._ask("ack", {"tournament": params["tournament"]})

    def _offered(self, params: dict) -> None:
        answer = "accept" if self.settings.accept_challenges else "decline"
        self._ask("challenge." + answer, {"challenge": params["challenge"]})

    def _probed(self, params: dict) -> None:
        self.outside.send({"jsonrpc": "2.0", "method": "lag", "params": {"t": params["t"]}})

    def _superseded(self, params: dict) -> End:
        del params
        return End("superseded", "another login with the same token took over", self.games)

    # ---- Noise: bytes of the agent's own, so that nobody can choose it ----

    def _add_to_next_noise(self) -> None:
        if not self.settings.own_noise:
            return
        secret = secrets.token_bytes(32)
        commitment = hashlib.sha256(secret).hexdigest()
        self._secrets[commitment] = secret.hex()
        while len(self._secrets) > 64:
            self._secrets.popitem(last=False)
        self._ask("game.ready", {"commitment": commitment})

    def _reveal(self, terms: dict) -> None:
        secret = self._secrets.get(terms["agent_commitments"][terms["seat"]] or "")
        if secret is not None:
            self._ask("game.reveal", {"game": terms["game"], "secret": secret}, game=terms["game"])

    _notices: Dict[str, Callable[["Agent", dict], Optional[End]]] = {
        "game.start": _game_started, "game.state": _state_came, "game.turn": _turn_came,
        "game.turn_lost": _turn_lost, "game.over": _game_over, "match.over": _match_over,
        "tournament.over": _tournament_over, "challenge.offer": _offered, "lag": _probed,
        "superseded": _superseded,
    }


def _is_id(message: dict) -> bool:
    number = message.get("id")
    return isinstance(number, int) and not isinstance(number, bool)


