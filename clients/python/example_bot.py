#!/usr/bin/env python3
"""Plays one game of 8-ball against house:greedy by the ghost ball. Needs nothing but Python 3.
Run: poolhall serve   and in another terminal: python3 clients/python/example_bot.py 127.0.0.1:7777"""
import cmath, hashlib, itertools, json, math, os, random, socket, sys, time

def ask(method, **params):
    print(json.dumps({"jsonrpc": "2.0", "id": method, "method": method, "params": params}), file=out, flush=True)

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
    theta = min(40 + 20 * turn["refusals"], 80)  # over all rails; steeper where a ball is in the way
    ask("shot", shot_id=next(numbers), **move, params={
        "theta": theta, "a": 0, "b": 1000 * radius * math.sin(math.radians(theta)),  # through the centre
        "phi": math.degrees(cmath.phase(aim - balls[0])), "v": 3 if "call" in move else 9})

connection, numbers, turns = socket.create_connection(sys.argv[1].split(":")), itertools.count(1), {}
out = connection.makefile("w", encoding="utf-8", newline="\n")
ask("hello", protocol=[1, 1], name="example")
ask("register", name=f"example-{random.randrange(10**9)}")
secret = os.urandom(32)  # added to the game's noise, so that nobody can choose it: first its hash, then itself
commitment = hashlib.sha256(secret).hexdigest()
ask("game.ready", commitment=commitment)
ask("challenge", opponent="house:greedy")
for message in map(json.loads, connection.makefile("r", encoding="utf-8")):
    params, error, turn = message.get("params", {}), message.get("error"), None
    if error and message["id"] in ("hello", "register", "challenge"): sys.exit(error["message"])
    if message.get("method") == "game.start":
        start = params
        if start["agent_commitments"][start["seat"]] == commitment: ask("game.reveal", game=start["game"], secret=secret.hex())
    if message.get("method") == "game.turn": turn = turns[params["game"]] = params
    if error and error["data"]["retryable"]:  # the same again, a little later
        turn = turns.get(error["data"].get("game")); time.sleep(0.1)
    if error and error["data"]["code"].startswith("bad_") and "foul" not in error["data"]:  # refused: another shot
        turn = turns[error["data"]["game"]]
        turn["refusals"] += 1
    if turn: answer(turn, start["table"], start["physics"]["ball_radius"])
    if message.get("method") == "game.over": break
print("game over:", "won," if params["winner"] == start["seat"] else "not won,", params["reason"])
