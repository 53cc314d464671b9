"""A bot on a server: connects, logs in, lets your function choose, and comes back by itself.

    import poolhall

    def choose(turn):
        if turn.kind == "decision":
            return turn.legal["decisions"][0]
        place = None if turn.kind == "shot" else (0.5, 0.3)
        return poolhall.Move(poolhall.Shot(b=18, theta=40, phi=90, v=4), "safety", place)

    end = poolhall.play_on_server(choose, "127.0.0.1:7777", name="mine",
                                  challenges=["house:random"], games=1)
    print(end.games)

`choose(turn)` is a function, which runs in a thread of its own and may think as long as the clock
allows, or a coroutine function. It returns a Move (or a bare Shot), a decision's name, or Concede.
In a program of your own with asyncio: `await Client(choose, ...).run()`.
"""
from __future__ import annotations

import asyncio
import inspect
import json
import random
import ssl
import threading
from dataclasses import replace
from typing import Any, Callable, Iterable, Optional, Sequence, Tuple, Union

from .agent import Agent, Choice, Concede, End, GameEnd, GameInfo, Settings, Turn
from .errors import Error

__all__ = ["Client", "Concede", "End", "GameEnd", "GameInfo", "Turn", "play_on_server"]

LONGEST_LINE = 4 * 1024 * 1024  # bytes; a server's lines are at most 1 MiB by default

#: None: plain TCP. True: TLS, certificates that the system believes. A path: TLS, believing the
#: certificates of that PEM file. Or an SSLContext.
Tls = Union[None, bool, str, ssl.SSLContext]


def _address(address: str) -> Tuple[str, int]:
    host, colon, port = address.rpartition(":")
    if not colon or not host or not port.isdigit() or not 0 < int(port) < 65536:
        raise Error("invalid_params", f"expected HOST:PORT, got {address!r}", "/address")
    return host.strip("[]"), int(port)


def _context(tls: Tls) -> Optional[ssl.SSLContext]:
    if tls is None or tls is False:
        return None
    if isinstance(tls, ssl.SSLContext):
        return tls
    return ssl.create_default_context(cafile=None if tls is True else tls)


def _challenge(challenge: Any) -> dict:
    if isinstance(challenge, str):
        return {"opponent": challenge}
    if isinstance(challenge, dict) and "opponent" in challenge:
        return dict(challenge)
    raise Error("invalid_params", "expected an opponent's name or a dict with `opponent`, got "
                f"{challenge!r}", "/challenges")


class Client:
    """An agent on a server; `run` returns when it is done for good.

    choose: see the module. token: 64 hexadecimal digits; without one the agent registers `name`
    with a fresh token (`Client.token`, to log in again another day). challenges: opponents' names,
    or dicts {opponent, rules?, noise?, clock?}. tournaments: ids to join. games: stop after so
    many; None: never. own_noise: add 32 random bytes to each game's noise, so that the host
    cannot choose it. detail: "full" also brings every event's balls (`on_message`).
    threads: how many games are thought about at the same time. log: called with a line for every
    event. on_message: called with method and params of every notification.

    The connection is made again after `backoff[0]` seconds at first and never more than
    `backoff[1]`; a shot that was sent and not confirmed is sent again with the same shot_id. A
    connection without a login after `login_seconds`, or silent for twice `silence_seconds`, is
    given up.
    """

    def __init__(self, choose: Callable[[Turn], Any], address: str = "127.0.0.1:7777", *,
                 name: str, token: Optional[str] = None, tls: Tls = None,
                 challenges: Iterable[Any] = (), tournaments: Sequence[int] = (),
                 games: Optional[int] = None, accept_challenges: bool = True,
                 own_noise: bool = True, detail: str = "summary", threads: int = 1,
                 log: Optional[Callable[[str], None]] = None,
                 on_game_over: Optional[Callable[[GameEnd], None]] = None,
                 on_message: Optional[Callable[[str, dict], None]] = None,
                 backoff: Tuple[float, float] = (0.1, 5.0), login_seconds: float = 10.0,
                 silence_seconds: float = 20.0):
        if games is not None and games < 1:
            raise Error("invalid_params", f"expected at least 1 game, got {games}", "/games")
        if threads < 1:
            raise Error("invalid_params", f"expected at least 1 thread, got {threads}", "/threads")
        self._choose = choose
        self._address = _address(address)
        self._tls = _context(tls)
        settings = Settings(name, token, [_challenge(c) for c in challenges], list(tournaments),
                            games, accept_challenges, own_noise, detail)
        hooks = {"log": log, "on_game_over": on_game_over, "on_message": on_message}
        self._settings = replace(settings, **{k: v for k, v in hooks.items() if v is not None})
        self._agent = Agent(self._settings, self)
        self._backoff = backoff
        self._login_seconds = login_seconds
        self._silence_seconds = silence_seconds
        self._threads = threads
        self._writer: Optional[asyncio.StreamWriter] = None
        self._last_line = 0.0
        self._loop: Optional[asyncio.AbstractEventLoop] = None

    @property
    def token(self) -> str:
        """What to log in with again: keep it secret."""
        return self._agent.token

    async def run(self) -> End:
        """Plays until done for good; raises what `choose` raised. Once for each Client."""
        self._loop = asyncio.get_running_loop()
        self._done: "asyncio.Future[End]" = self._loop.create_future()
        self._room_to_think = asyncio.Semaphore(self._threads)
        self._tasks: set = set()
        try:
            life = self._task(self._live())
            await asyncio.wait({self._done, life}, return_when=asyncio.FIRST_COMPLETED)
            if not self._done.done():
                life.result()  # raises: it never ends by itself
            return self._done.result()
        finally:
            for task in list(self._tasks):
                task.cancel()
            await asyncio.gather(*self._tasks, return_exceptions=True)

    def stop(self) -> None:
        """Ends `run`, which has begun, with ending "stopped"; from any thread."""
        if self._loop is None:
            raise Error("invalid_request", "the client does not run yet")
        end = End("stopped", "stopped by the host program", self._agent.games)
        self._loop.call_soon_threadsafe(self._finish, end)

    # ---- What the agent asks for ----

    def send(self, message: dict) -> None:
        if self._writer is not None and not self._writer.is_closing():
            self._writer.write(json.dumps(message, allow_nan=False).encode() + b"\n")

    def think(self, game: int, turn: Turn) -> None:
        self._task(self._thought(game, turn))

    def wake(self, game: int, seconds: float) -> None:
        self._loop.call_later(seconds, self._agent.send_answer_again, game)

    # ---- Inside ----

    def _task(self, work: Any) -> "asyncio.Task[Any]":
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    def _finish(self, end: End) -> None:
        if not self._done.done():
            self._done.set_result(end)

    async def _thought(self, game: int, turn: Turn) -> None:
        try:
            async with self._room_to_think:
                if inspect.iscoroutinefunction(self._choose):
                    choice = await self._choose(turn)
                else:
                    choice = await self._in_a_thread(turn)
            self._agent.move_chosen(game, turn, choice)
        except asyncio.CancelledError:
            raise
        except BaseException as failure:  # the player's own: whoever called run() gets it
            if not self._done.done():
                self._done.set_exception(failure)

    async def _in_a_thread(self, turn: Turn) -> Choice:
        """A thread that does not keep the program from ending, as those of an executor do."""
        answer: "asyncio.Future[Choice]" = self._loop.create_future()

        def tell(setter: Callable[[Any], None], value: Any) -> None:
            if not answer.done():
                setter(value)

        def work() -> None:
            try:
                told = (answer.set_result, self._choose(turn))
            except BaseException as failure:
                told = (answer.set_exception, failure)
            try:
                self._loop.call_soon_threadsafe(tell, *told)
            except RuntimeError:
                pass  # the loop is closed: nobody waits any more

        threading.Thread(target=work, name="poolhall-player", daemon=True).start()
        return await answer

    async def _live(self) -> None:
        delay = self._backoff[0]
        while True:
            was_logged_in = False
            try:
                connecting = asyncio.open_connection(*self._address, limit=LONGEST_LINE,
                                                     ssl=self._tls)
                reader, self._writer = await asyncio.wait_for(connecting, self._login_seconds)
                was_logged_in = await self._serve(reader)
            except (OSError, asyncio.TimeoutError, ssl.SSLError, ValueError) as problem:
                self._settings.log(f"connection lost: {problem or type(problem).__name__}")
            finally:
                self._agent.session_ended()
                if self._writer is not None:
                    self._writer.close()
                    self._writer = None
            delay = self._backoff[0] if was_logged_in else delay
            # Between half and all of it, so that a crowd of bots does not come back in step.
            await asyncio.sleep(random.uniform(delay / 2, delay))
            delay = min(2 * delay, self._backoff[1])

    async def _serve(self, reader: asyncio.StreamReader) -> bool:
        """One connection, from its first line to its end; whether it got to a login."""
        was_logged_in = False
        connected_at = self._last_line = self._loop.time()
        watch = self._task(self._watch(self._writer, connected_at))
        try:
            self._agent.begin_session()
            while line := await reader.readline():
                self._last_line = self._loop.time()
                end = self._line_came(line)
                was_logged_in = was_logged_in or self._agent.logged_in
                await self._drain()
                if end is not None:
                    self._finish(end)
                    return True
            self._settings.log("connection lost: the server has closed it")
        finally:
            watch.cancel()
        return was_logged_in

    async def _drain(self) -> None:
        if self._writer is not None:
            await self._writer.drain()

    def _line_came(self, line: bytes) -> Optional[End]:
        try:
            message = json.loads(line)
            return self._agent.message_came(message)
        except (KeyError, TypeError, AttributeError, ValueError, Error) as problem:
            self._settings.log(f"the server's line was not understood: {problem!r}")
            return None

    async def _watch(self, writer: Any, connected_at: float) -> None:
        """Gives up a connection on which nothing happens any more."""
        step = min(self._login_seconds, self._silence_seconds) / 2
        while True:
            await asyncio.sleep(step)
            now = self._loop.time()
            is_late = not self._agent.logged_in and now - connected_at > self._login_seconds
            if is_late or now - self._last_line > 2 * self._silence_seconds:
                writer.transport.abort()
                return
            if now - self._last_line > self._silence_seconds:
                self._agent.send_ping()


def play_on_server(choose: Callable[[Turn], Any], address: str = "127.0.0.1:7777",
                   **settings: Any) -> End:
    """`Client(choose, address, **settings).run()` for programs without asyncio. Ctrl-C ends it."""
    return asyncio.run(Client(choose, address, **settings).run())
