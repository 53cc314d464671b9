#!/usr/bin/env python3
"""A bot that does all that protocol/README.md demands, and one thing wrong if it is told to.

    poolhall conformance --command "/usr/bin/python3 bad_bot.py --fault keeps-half-a-line"

It plays by no plan: the first legal call, a stroke from above in a direction that changes with the
turn. What each fault does stands where it is asked about, with `self.has(...)`.
"""
import argparse
import hashlib
import json
import math
import os
import select
import socket
import sys
import time

FAULTS = """
answers-opponents-turns calls-the-8 chatters-before-login comes-back-after-superseded decides-accept
dies-of-pocketed-cue-ball dies-of-unknown-members dies-of-unknown-notifications forgets-cue-ball
gives-up-after-error gives-up-after-refusal hears-one-line-a-segment keeps-half-a-line
knows-one-game logs-in-once loops-on-stale-turn plays-lost-turns reads-64-kib replies-in-order
rethinks-on-resend reveals-early sends-nan skips-hello stays-away thinks-too-long
two-places-for-the-cue-ball wrong-lag
""".split()

# Members of a turn that a strict reader knows.
TURN_MEMBERS = {"seq", "game", "turn", "kind", "state", "clock", "legal", "refusals"}
THETA = 60.0  # degrees: the cue passes over rails and most balls


class Gone(Exception):
    """The connection is lost."""


class Bot:
    def __init__(self, fault, server, token):
        self.fault, self.token = fault, token
        self.host, port = server.rsplit(":", 1)
        self.port = int(port)
        self.buffer = b""
        self.next_id = 1
        self.asked = {}  # what each id stands for
        self.games = {}  # terms by game
        self.turns = {}  # the pending turn by game
        self.answers = {}  # the unconfirmed answer by (game, turn, refusals)
        self.again_at = {}  # when an answer is sent again, by game
        self.secrets = {}  # by commitment
        self.superseded = False

    def has(self, fault):
        return self.fault == fault

    # ---- Lines ----

    def ask(self, method, about=None, **params):
        self.next_id += 1
        self.asked[self.next_id] = (method, about)
        self.send({"jsonrpc": "2.0", "id": self.next_id, "method": method, "params": params})

    def send(self, message):
        try:
            self.wire.sendall(json.dumps(message).encode() + b"\n")
        except OSError as error:
            raise Gone from error

    def lines(self):
        """Lines as they come; None when an answer is due to be sent again."""
        while True:
            while b"\n" in self.buffer:
                line, self.buffer = self.buffer.split(b"\n", 1)
                yield line
                if self.has("hears-one-line-a-segment"):
                    self.buffer = b""
            if self.has("reads-64-kib") and len(self.buffer) > 65536:
                sys.exit("the server's line is too long")
            wait = min(self.again_at.values(), default=math.inf) - time.monotonic()
            readable = select.select([self.wire], [], [], max(0, min(wait, 3600)))[0]
            if not readable:
                yield None
                continue
            try:
                chunk = self.wire.recv(1 << 20)
            except OSError as error:
                raise Gone from error
            if not chunk:
                raise Gone
            self.buffer += chunk

    # ---- Sessions ----

    def run(self):
        pause = 0.05
        while not self.superseded or self.has("comes-back-after-superseded"):
            try:
                self.wire = socket.create_connection((self.host, self.port))
                if not self.has("keeps-half-a-line"):
                    self.buffer = b""
                self.again_at.clear()
                self.asked.clear()
                self.session()
            except (OSError, Gone):
                if self.has("stays-away"):
                    time.sleep(3600)
                if self.games:
                    pause = 0.05
                time.sleep(pause)
                pause = min(pause * 2, 1)

    def session(self):
        if not self.has("skips-hello"):
            name = "b" * 5000 if self.has("chatters-before-login") else "bad-bot"
            self.ask("hello", protocol=[1, 1], name="bad-bot", client={"name": name[:60]}, note=name)
        self.ask("login", token=self.token)
        for line in self.lines():
            if line is None:
                self.send_due_answers()
                continue
            message = json.loads(line)
            if "method" in message:
                self.notified(message["method"], message["params"])
            else:
                self.replied(message)
            if self.superseded:
                return

    def replied(self, message):
        if message["id"] is None:
            return
        if self.has("replies-in-order") and message["id"] != min(self.asked):
            sys.exit("a reply to something else")
        method, about = self.asked.pop(message["id"])
        if method == "login":
            if "error" in message:
                if self.has("logs-in-once"):
                    return
                if message["error"]["data"]["retryable"]:
                    raise Gone  # and back a little later
                sys.exit(message["error"]["message"])
            self.commit()
        if method not in ("shot", "decide"):
            return
        game, key = about
        if "error" not in message:
            self.forget(game, key)
        else:
            self.refused(game, key, message["error"]["data"])

    def refused(self, game, key, data):
        if self.has("gives-up-after-refusal"):
            return
        if data["code"] in ("stale_turn", "game_over", "unknown_game", "conflicting_shot",
                            "conflicting_request"):
            if self.has("loops-on-stale-turn") and data["code"] == "stale_turn":
                self.send_answer(game, key)
            else:
                self.forget(game, key)
        elif data.get("foul"):
            if self.has("plays-lost-turns"):
                self.think(game)
            self.forget(game, key)
        elif data["retryable"]:
            if not self.has("gives-up-after-error"):
                self.again_at[game] = time.monotonic() + 0.1
        elif game in self.turns:
            self.answers.pop(key, None)
            self.turns[game]["refusals"] += 1
            self.think(game)

    def forget(self, game, key):
        self.answers.pop(key, None)
        self.again_at.pop(game, None)
        if game in self.turns and self.turns[game]["turn"] <= key[1]:
            del self.turns[game]

    # ---- Notifications ----

    def notified(self, method, params):
        if method == "game.start" or method == "game.state":
            if method == "game.start":
                self.commit()
            if self.has("knows-one-game") and self.games and params["game"] not in self.games:
                return
            self.games[params["game"]] = params
            self.reveal(params)
        elif method == "game.turn":
            if self.has("dies-of-unknown-members") and set(params) - TURN_MEMBERS:
                sys.exit("unknown members")
            if params["game"] in self.games:
                self.turns[params["game"]] = params
                self.think(params["game"])
        elif method == "game.shot" and self.has("answers-opponents-turns"):
            self.turns[params["game"]] = {"game": params["game"], "turn": params["turn"] + 1,
                                          "kind": "shot", "state": params["state"], "refusals": 0,
                                          "legal": {"balls": [], "calls": ["safety"]}}
            self.think(params["game"])
        elif method == "game.turn_lost":
            self.turns.pop(params["game"], None)
            self.again_at.pop(params["game"], None)
        elif method == "game.over":
            self.games.pop(params["game"], None)
            self.turns.pop(params["game"], None)
            self.again_at.pop(params["game"], None)
            self.ask("ack", game=params["game"])
        elif method == "match.over":
            self.ask("ack", match=params["match"])
        elif method == "tournament.over":
            self.ask("ack", tournament=params["tournament"])
        elif method == "lag":
            t = params["t"] + 1 if self.has("wrong-lag") else params["t"]
            self.send({"jsonrpc": "2.0", "method": "lag", "params": {"t": t}})
        elif method == "superseded":
            self.superseded = True
        elif method not in ("game.decision", "challenge.offer", "challenge.over", "game.shot",
                            "shutting_down"):
            if self.has("dies-of-unknown-notifications"):
                sys.exit("unknown notification " + method)

    # ---- Noise ----

    def commit(self):
        secret = os.urandom(32)
        commitment = hashlib.sha256(secret).hexdigest()
        self.secrets[commitment] = secret.hex()
        self.ask("game.ready", commitment=commitment)
        if self.has("reveals-early"):
            self.ask("game.reveal", game=1, secret=secret.hex())

    def reveal(self, terms):
        commitment = terms["agent_commitments"][terms["seat"]]
        if commitment in self.secrets and terms["state"]["turn"] == 1:
            self.ask("game.reveal", game=terms["game"], secret=self.secrets[commitment])

    # ---- Answers ----

    def key(self, game):
        turn = self.turns[game]
        return game, turn["turn"], turn["refusals"]

    def think(self, game):
        key = self.key(game)
        if self.has("thinks-too-long"):
            time.sleep(1.2)
        if key not in self.answers or self.has("rethinks-on-resend"):
            self.answers[key] = self.answer(self.turns[game])
        self.send_answer(game, key)

    def send_answer(self, game, key):
        if key in self.answers:
            method, params = self.answers[key]
            self.ask(method, (game, key), **params)

    def send_due_answers(self):
        now = time.monotonic()
        for game in [game for game, at in self.again_at.items() if at <= now]:
            del self.again_at[game]
            if game in self.turns:
                self.send_answer(game, self.key(game))

    def answer(self, turn):
        params = {"game": turn["game"], "turn": turn["turn"]}
        if turn["kind"] == "decision":
            choice = turn["legal"]["decisions"][0]
            return "decide", {"choice": "accept" if self.has("decides-accept") else choice, **params}
        terms = self.games[turn["game"]]
        radius = terms["physics"]["ball_radius"]
        balls = {ball["id"]: (ball["x"], ball["y"])
                 for ball in turn["state"]["balls"] if "x" in ball}
        if self.has("dies-of-pocketed-cue-ball"):
            print("cue ball at", balls[0])
        if turn["kind"] != "shot" and not self.has("forgets-cue-ball"):
            x, y = self.place(terms["table"], balls, radius)
            if self.has("two-places-for-the-cue-ball"):
                y = terms["table"]["length"] - y
            params["cue_ball"] = {"x": x, "y": y}
        params["call"] = self.call(turn["legal"])
        params["shot_id"] = f"t{turn['turn']}r{turn['refusals']}"
        phi = (turn["turn"] * 37 + turn["refusals"] * 61) % 360
        if self.has("rethinks-on-resend"):
            phi = time.monotonic() * 1000 % 360
        if self.has("sends-nan"):
            phi = math.nan
        params["params"] = {"a": 0, "b": 1000 * radius * math.sin(math.radians(THETA)),
                            "theta": THETA, "phi": phi, "v": 3}
        return "shot", params

    def call(self, legal):
        if self.has("calls-the-8") and "pocket" in legal["calls"]:
            return {"ball": 8, "pocket": "foot_left"}
        if "safety" in legal["calls"]:
            return "safety"
        return None

    @staticmethod
    def place(table, balls, radius):
        """The place behind the head string, on a grid, that is furthest from all balls."""
        others = [place for ball, place in balls.items() if ball]
        spots = [(table["width"] * i / 24, table["head_string"] * j / 12)
                 for i in range(2, 23) for j in range(1, 12)]
        spots = [spot for spot in spots if spot[1] > 1.5 * radius]
        return max(spots, key=lambda spot: min([math.dist(spot, other) for other in others]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--fault", choices=FAULTS)
    arguments = parser.parse_args()
    Bot(arguments.fault, os.environ["POOLHALL_SERVER"], os.environ["POOLHALL_TOKEN"]).run()


if __name__ == "__main__":
    main()
