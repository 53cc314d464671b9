#!/usr/bin/env python3
"""Plays one game of 8-ball against house:greedy by the ghost ball. Needs nothing but Python 3.
Run: poolhall serve   and in another terminal: python3 clients/python/example_bot.py 127.0.0.1:7777"""
import cmath, hashlib, json, math, os, random, socket, sys

def ask(method, **params):
    print(json.dumps({"jsonrpc": "2.0", "id": method, "method": method, "params": params}), file=wire, flush=True)

def answer(turn, table, radius):  # points of the table are complex numbers: x across, y along
    move = {"game": turn["game"], "turn": turn["turn"]}
    if turn["kind"] == "decision":
        return ask("decide", choice=turn["legal"]["decisions"][0], **move)
    balls = {ball["id"]: complex(ball["x"], ball["y"]) for ball in turn["state"]["balls"] if "x" in ball}
    if turn["kind"] != "shot":  # cue ball in hand: where it is free behind the head string, always allowed
        spots = (complex(random.uniform(0.1, 1) * table["width"] * 0.9, table["head_string"] * 0.9) for _ in range(99))
        balls[0] = max(spots, key=lambda spot: min(abs(spot - balls[ball]) for ball in balls if ball))
        move["cue_ball"] = {"x": balls[0].real, "y": balls[0].imag}
    aim, straightest = complex(table["foot_spot"]["x"], table["foot_spot"]["y"]), -1  # for the break
    for ball in turn["legal"]["balls"] if turn["kind"] != "break" else []:
        for end, y in ("head", 0), ("side", table["length"] / 2), ("foot", table["length"]):
            for side, x in ("left", 0), ("right", table["width"]):
                away = balls[ball] - complex(x, y)  # from the pocket
                ghost = balls[ball] + 2 * radius * away / abs(away)  # where the cue ball must touch the ball
                straight = -math.cos(cmath.phase((ghost - balls[0]) / away))  # 1: no cut; below 0: impossible
                if straight >= straightest:
                    straightest, aim, move["call"] = straight, ghost, {"ball": ball, "pocket": f"{end}_{side}"}
    ask("shot", shot_id=turn["turn"], **move, params={
        "theta": 40, "a": 0, "b": 1000 * radius * math.sin(math.radians(40)),  # through the centre, over all rails
        "phi": math.degrees(cmath.phase(aim - balls[0])), "v": 3 if "call" in move else 9})

wire = socket.create_connection(sys.argv[1].split(":")).makefile("rw", encoding="utf-8", newline="\n")
ask("hello", protocol=[1, 1], name="example")
ask("register", name=f"example-{random.randrange(10**9)}")
secret = os.urandom(32)  # added to the game's noise, so that nobody can choose it: first its hash, then itself
ask("game.ready", commitment=hashlib.sha256(secret).hexdigest())
ask("challenge", opponent="house:greedy")
for message in map(json.loads, wire):
    if "error" in message: sys.exit(message["error"]["message"])
    if message.get("method") == "game.start":
        start = message["params"]
        ask("game.reveal", game=start["game"], secret=secret.hex())
    if message.get("method") == "game.turn": answer(message["params"], start["table"], start["physics"]["ball_radius"])
    if message.get("method") == "game.over": break
print("game over:", "won," if message["params"]["winner"] == start["seat"] else "not won,", message["params"]["reason"])
