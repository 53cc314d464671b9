"""The client, on a real server and in front of a scripted one."""
import asyncio
import json
import math
import signal
import subprocess

import poolhall
import pytest
from poolhall import Client, Error, Move, Shot
from poolhall.agent import Agent, Concede, Settings

from conftest import Server, start_interruptible


def choose(turn):
    """Strikes whatever lies nearest to the cue ball."""
    if turn.kind == "decision":
        return turn.legal["decisions"][0]
    balls = turn.state.balls
    place = None if turn.kind == "shot" else (0.3 + 0.1 * (turn.turn % 6), 0.3)
    cue = place or balls[0]
    ways = [(math.hypot(x - cue[0], y - cue[1]), math.degrees(math.atan2(y - cue[1], x - cue[0])))
            for x, y in balls[1:] if x == x]
    call = "safety" if "safety" in turn.legal["calls"] else None
    return Move(Shot(b=18, theta=40, phi=min(ways)[1], v=6), call, place)


def play(address, chooser=choose, **settings):
    settings = {"name": "python-bot", "challenges": ["house:random"], "games": 1, **settings}
    return poolhall.play_on_server(chooser, address, **settings)


def test_plays_a_game_on_a_server(server):
    lines, methods = [], []
    end = play(server.address, log=lines.append, on_message=lambda m, p: methods.append(m))
    assert end.ending == "finished" and len(end.games) == 1
    game = end.games[0]
    assert game.opponent == "house:random" and game.scored and game.reason
    assert {"game.start", "game.turn", "game.over"} <= set(methods)
    assert not [line for line in lines if "not understood" in line or "invalid" in line], lines


def test_a_coroutine_chooses_too_and_nine_ball_is_played(server):
    async def chooser(turn):
        await asyncio.sleep(0)
        return choose(turn)

    end = play(server.address, chooser,
               challenges=[{"opponent": "house:random", "rules": "9-ball", "noise": "low"}] * 2,
               games=2, threads=2)
    assert end.ending == "finished" and len(end.games) == 2


def test_its_bytes_are_added_to_the_noise(server):
    told = {}
    ended = []

    async def run():
        client = Client(choose, server.address, name="noisy", challenges=["house:random"],
                        on_message=lambda m, p: told.setdefault(m, p))
        running = asyncio.ensure_future(client.run())
        while "match.over" not in told:
            await asyncio.sleep(0.02)
        client.stop()
        ended.append(await running)

    asyncio.run(asyncio.wait_for(run(), 120))
    seat = told["game.start"]["seat"]
    assert told["game.start"]["agent_commitments"][seat] is not None
    assert told["match.over"]["seeds"][0]["agent_secrets"][seat] is not None
    assert ended[0].ending == "stopped"


class Proxy:
    """Carries bytes between a client and a server, and cuts the line when told to."""

    def __init__(self, address):
        self.host, self.port = address.split(":")
        self.sent = []  # lines of the client's
        self.connections = 0
        self.cuts = {}  # turn: whether its shot still gets to the server

    def cut(self, line):
        """None: the line stays. Else whether this message still arrives."""
        is_shot = line["method"] == "shot"
        return self.cuts.pop(line["params"]["turn"], None) if is_shot else None

    async def start(self):
        self.listener = await asyncio.start_server(self.carry, "127.0.0.1", 0)
        return "127.0.0.1:%d" % self.listener.sockets[0].getsockname()[1]

    async def carry(self, reader, writer):
        self.connections += 1
        back_reader, back = await asyncio.open_connection(self.host, self.port, limit=1 << 22)

        async def answers():
            while data := await back_reader.read(65536):
                writer.write(data)
            writer.close()

        task = asyncio.ensure_future(answers())
        try:
            while line := await reader.readline():
                self.sent.append(json.loads(line))
                arrives = self.cut(self.sent[-1])
                if arrives is not False:
                    back.write(line)
                if arrives is not None:
                    await back.drain()
                    task.cancel()  # before the answer
                    break
        finally:
            back.close()
            writer.close()


def test_comes_back_and_sends_the_same_shot_again(server):
    async def run():
        proxy = Proxy(server.address)
        proxy.cuts = {turn: turn % 4 < 2 for turn in range(1, 13)}
        address = await proxy.start()
        thoughts = []

        def counted(turn):
            thoughts.append((turn.turn, turn.refusals))
            return choose(turn)

        end = await Client(counted, address, name="cut-off", challenges=["house:random"], games=1,
                           backoff=(0.01, 0.1)).run()
        proxy.listener.close()
        return proxy, thoughts, end

    proxy, thoughts, end = asyncio.run(asyncio.wait_for(run(), 120))
    assert end.ending == "finished" and end.games[0].reason != "timeout"
    shots = {}
    for line in proxy.sent:
        if line["method"] == "shot":
            shots.setdefault(line["params"]["shot_id"], []).append(line["params"])
    assert proxy.connections >= 3
    assert any(len(sent) > 1 for sent in shots.values())
    assert all(one == sent[0] for sent in shots.values() for one in sent)
    assert len(thoughts) == len(set(thoughts))  # no turn was thought about twice


def test_survives_a_kill_of_the_server(tmp_path):
    server = Server(tmp_path)
    address = server.address
    killed = []

    def chooser(turn):
        if turn.turn >= 4 and not killed:
            killed.append(turn.turn)
            server.kill()
            server.start(address)
        return choose(turn)

    try:
        end = play(address, chooser, backoff=(0.02, 0.2))
        assert killed and end.ending == "finished" and end.games[0].scored
    finally:
        server.stop()


def test_speaks_tls(tmp_path):
    key, certificate = tmp_path / "key.pem", tmp_path / "host.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                    "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", "/CN=test",
                    "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", certificate],
                   check=True, capture_output=True)
    server = Server(tmp_path, "--tls-listen", "127.0.0.1:0", "--tls-certificate", certificate,
                    "--tls-key", key)
    try:
        assert play(server.tls_address, tls=str(certificate)).ending == "finished"
        lines = []
        client = Client(choose, server.tls_address, name="doubting", tls=True, log=lines.append,
                        backoff=(0.01, 0.02))

        async def refused():
            running = asyncio.ensure_future(client.run())
            while len(lines) < 2:
                await asyncio.sleep(0.01)
            client.stop()
            return await running

        assert asyncio.run(asyncio.wait_for(refused(), 60)).ending == "stopped"
        assert "certificate" in lines[0].lower()
    finally:
        server.stop()


def test_ends_when_a_name_is_taken_or_the_token_is_used_elsewhere(server):
    async def run():
        first = Client(choose, server.address, name="only-one")
        running = asyncio.ensure_future(first.run())
        while not first._agent.logged_in:
            await asyncio.sleep(0.01)
        taken = await Client(choose, server.address, name="only-one").run()
        second = Client(choose, server.address, name="only-one", token=first.token)
        again = asyncio.ensure_future(second.run())
        end = await running
        second.stop()
        return taken, end, await again

    taken, superseded, stopped = asyncio.run(asyncio.wait_for(run(), 60))
    assert taken.ending == "refused" and "name_taken" in taken.reason
    assert superseded.ending == "superseded" and stopped.ending == "stopped"


def test_raises_what_the_player_raises(server):
    def broken(turn):
        raise ZeroDivisionError("no idea")

    with pytest.raises(ZeroDivisionError):
        play(server.address, broken)
    with pytest.raises(Error) as caught:
        play(server.address, lambda turn: 42, name="answers-42")
    assert caught.value.field == "/choice"


def test_ctrl_c_ends_it_even_while_the_player_thinks(server):
    code = f"""
import threading, poolhall
def choose(turn):
    print("thinking", flush=True)
    threading.Event().wait()
try:
    poolhall.play_on_server(choose, {server.address!r}, name="slow", challenges=["house:random"])
except KeyboardInterrupt:
    print("ended", flush=True)
"""
    child = start_interruptible(code)
    assert child.stdout.readline() == "thinking\n"
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert out == "ended\n" and child.returncode == 0


def test_checks_its_settings():
    with pytest.raises(Error):
        Client(choose, name="x").stop()
    for wrong, field in ((dict(address="nowhere"), "/address"), (dict(games=0), "/games"),
                         (dict(challenges=[7]), "/challenges"), (dict(threads=0), "/threads")):
        with pytest.raises(Error) as caught:
            Client(choose, **{"name": "x", **wrong})
        assert caught.value.field == field


# ---- The conversation alone ----


class Script:
    """Stands for the network: notes what is sent and what is to be thought about."""

    def __init__(self, **settings):
        self.sent, self.thoughts, self.wakes = [], [], []
        self.agent = Agent(Settings("script", **settings), self)
        self.agent.begin_session()

    def send(self, message):
        self.sent.append(message)

    def think(self, game, turn):
        self.thoughts.append((game, turn))

    def wake(self, game, seconds):
        self.wakes.append(game)

    def last(self, method):
        return [m for m in self.sent if m["method"] == method][-1]

    def count(self, method):
        return sum(m["method"] == method for m in self.sent)

    def reply(self, method, result):
        return self.agent.message_came({"jsonrpc": "2.0", "id": self.last(method)["id"],
                                        "result": result})

    def fail(self, method, code, number=-32000, **data):
        error = {"code": number, "message": code + ": because",
                 "data": {"code": code, "field": "/params", "retryable": False, **data}}
        return self.agent.message_came({"jsonrpc": "2.0", "id": self.last(method)["id"],
                                        "error": error})

    def tell(self, method, **params):
        return self.agent.message_came({"jsonrpc": "2.0", "method": method,
                                        "params": {"seq": 1, **params}})

    def log_in(self):
        self.reply("hello", {})
        method = "login" if self.count("login") else "register"
        self.reply(method, {"agent": "script", "token": self.agent.token, "games": []})

    def start(self, game=17):
        table = poolhall.Table()
        terms = dict(game=game, match=3, tournament=None, seat=0, opponent="you", rules="8-ball",
                     table=table.table, physics=table.physics, noise="hidden",
                     clock={"game_ms": 1000, "increment_ms": 0, "shot_ms": None}, max_refusals=3,
                     commitment="0" * 64, agent_commitments=[None, None])
        self.tell("game.start", **terms, state=poolhall.new_game().to_dict())

    def turn(self, number=1, refusals=0, game=17):
        state = {**poolhall.new_game().to_dict(), "turn": number}
        self.tell("game.turn", game=game, turn=number, kind="break", state=state, refusals=refusals,
                  clock={"own_ms": 1, "opponent_ms": 2, "deadline_ms": None},
                  legal=poolhall.new_game().legal())

    def choose(self, move=Move(Shot(phi=90, v=3), None, (0.5, 0.4))):
        game, turn = self.thoughts[-1]
        self.agent.move_chosen(game, turn, move)


def test_registers_once_and_logs_in_from_then_on():
    script = Script()
    script.log_in()
    assert script.count("register") == 1
    script.agent.session_ended()
    script.agent.begin_session()
    script.log_in()
    assert script.count("register") == 1 and script.count("login") == 1
    assert script.last("login")["params"]["token"] == script.last("register")["params"]["token"]


def test_registers_a_token_that_the_server_does_not_know():
    script = Script(token="a" * 64)
    script.reply("hello", {})
    assert script.fail("login", "unauthorized") is None
    assert script.last("register")["params"]["token"] == "a" * 64


def test_repeats_an_answer_until_it_is_confirmed_and_thinks_once():
    script = Script()
    script.log_in()
    script.start()
    script.turn()
    script.agent.session_ended()
    script.choose()
    assert script.count("shot") == 0  # nobody to send it to
    script.agent.begin_session()
    script.log_in()
    script.turn()
    script.turn()
    assert script.count("shot") == 2 and len(script.thoughts) == 1
    first, second = [m["params"] for m in script.sent if m["method"] == "shot"]
    assert first == second
    script.fail("shot", "rate_limited", retryable=True)
    assert script.wakes == [17]
    script.agent.send_answer_again(17)
    assert script.count("shot") == 3
    script.reply("shot", {})
    script.turn()
    assert len(script.thoughts) == 2


def test_thinks_again_when_a_move_is_refused_and_concedes_when_it_is_hopeless():
    script = Script()
    script.log_in()
    script.start()
    script.turn()
    for refusals in range(10):
        assert script.thoughts[-1][1].refusals == refusals
        script.choose()
        assert script.last("shot")["params"]["shot_id"] == f"t1r{refusals}"
        script.fail("shot", "bad_shot")
    assert script.count("concede") == 1


def test_forgets_a_turn_that_a_foul_has_ended():
    script = Script()
    script.log_in()
    script.start()
    script.turn()
    script.choose()
    script.fail("shot", "bad_shot", foul=True)
    assert len(script.thoughts) == 1 and script.count("concede") == 0
    script.turn(3)
    assert len(script.thoughts) == 2


def test_asks_what_is_pending_when_somebody_else_has_played_its_turn():
    script = Script()
    script.log_in()
    script.start()
    script.turn()
    script.choose()
    script.fail("shot", "conflicting_shot")
    assert script.last("sync")["params"] == {"game": 17}
    script.turn(5, game=99)
    assert script.last("sync")["params"] == {"game": 99}


def test_a_late_thought_does_not_answer_another_turn():
    script = Script()
    script.log_in()
    script.start()
    script.turn(1)
    late = script.thoughts[-1]
    script.tell("game.turn_lost", game=17, turn=1)
    script.turn(3)
    assert len(script.thoughts) == 1  # the player is still busy with the lost turn
    script.agent.move_chosen(*late, Move(Shot(v=1)))
    assert script.count("shot") == 0 and script.thoughts[-1][1].turn == 3
    script.choose()
    assert script.last("shot")["params"]["turn"] == 3


def test_answers_probes_acknowledges_ends_and_concedes():
    script = Script(games=1)
    script.log_in()
    script.tell("lag", t=5)
    assert script.sent[-1] == {"jsonrpc": "2.0", "method": "lag", "params": {"t": 5}}
    script.tell("challenge.offer", challenge=4)
    assert script.last("challenge.accept")["params"] == {"challenge": 4}
    script.start()
    script.turn()
    script.choose(Concede())
    assert script.last("concede")["params"] == {"game": 17}
    over = dict(game=17, match=3, winner=1, reason="conceded", scored=True, checksum="0" * 64)
    script.tell("game.over", **over)
    script.tell("game.over", **over)
    assert script.count("ack") == 2 and len(script.agent.games) == 1
    end = script.reply("ack", {"game": 17})
    assert end.ending == "finished" and not end.games[0].won
    script.tell("match.over", match=3)
    script.tell("tournament.over", tournament=8)
    assert script.last("ack")["params"] == {"tournament": 8}
    assert script.tell("superseded").ending == "superseded"
    assert script.tell("something.new") is None
