// The page's modules and the bot client from Node, as a reader of clients/javascript/README.md uses
// them, against a real server.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { AgentError, ApiError, hallAt, motionOf, play } from '../../clients/javascript/poolhall.js';
import { root, simulateText, startServer, temporaryDirectory, until } from './program.mjs';

const enough = { timeout: 50_000 };
let directory;
let server;
let hall;

before(async () => {
  directory = temporaryDirectory();
  server = await startServer(directory.path);
  hall = hallAt(server.url);
}, enough);

after(async () => {
  await server.stop();
  directory.remove();
});

const port = () => Number(server.agents.split(':')[1]);

/** Soft strokes that depend on the turn alone: a long game. */
const stroke = (turn, terms) => (turn.kind === 'decision' ? { choice: turn.legal.decisions[0] } : {
  params: { a: 0, b: 10, theta: 60 + 3 * turn.refusals, phi: (turn.turn * 137.5 + 40 * turn.refusals) % 360, v: 1.5 },
  ...(turn.kind === 'shot' ? {} : { cue_ball: { x: terms.table.width / 2, y: 0.9 * terms.table.head_string } }),
  call: turn.legal.calls.includes('safety') ? 'safety' : null,
});

test('a bot plays, another program follows the game live and reads it back in numbers', enough, async () => {
  let game = null;
  let enoughSeen = false;
  const over = play({
    port: port(), name: 'js', challenge: { opponent: 'house:random' }, games: 1, onGame: (terms) => { game = terms.game; },
  }, (turn, terms) => (enoughSeen ? 'concede' : stroke(turn, terms)));
  await until(() => game, 'the game begins');
  const messages = [];
  const live = hall.follow(game, (message) => messages.push(message));
  await until(() => messages.filter((m) => m.type === 'turn').length >= 4, 'turns come');
  enoughSeen = true;
  assert.equal((await over).games, 1);
  await until(() => messages.at(-1).over, 'the end is told');
  live.close();
  const { board, turns, agents } = await hall.game(game);
  assert.ok(agents.includes('js'));
  assert.equal(messages[0].type, 'snapshot');
  const told = messages.filter((m) => m.type === 'turn').map((m) => m.turn.turn);
  assert.deepEqual(told, told.map((_, i) => told[0] + i), 'none is missed');
  for (const { turn: number } of turns.filter((t) => t.action === 'shot')) {
    const turn = await hall.turn(game, number);
    const motion = motionOf(board, turn);
    for (const { t, after: balls } of turn.events) {
      for (const ball of balls.filter((b) => b.state !== 'pocketed')) {
        const there = motion.ballsAt(t).find((b) => b.id === ball.id);
        assert.ok(Math.hypot(there.x - ball.x, there.y - ball.y) < 1e-9, `ball ${ball.id} at ${t}`);
      }
    }
    const end = motion.ballsAt(motion.duration);
    for (const ball of turn.state_after.balls.filter((b) => b.x !== undefined && b.id !== 0)) {
      const last = end.find((b) => b.id === ball.id);
      assert.ok(Math.hypot(last.x - ball.x, last.y - ball.y) < 1e-9, `ball ${ball.id} at rest`);
    }
  }
});

test('the server simulates for it as the program does, and refuses with a reason', enough, async () => {
  const scene = { table: 'olympiad', physics: 'olympiad', balls: [{ id: 0, x: 0.5, y: 0.5 }, { id: 3, x: 0.51, y: 1.2 }],
    shot: { a: 1, b: 2, theta: 5, phi: 90, v: 3 } };
  assert.deepEqual(await hall.simulate(scene), JSON.parse(simulateText(scene)));
  const cloud = await hall.evaluate({ scene, noise: 'olympiad', samples: 20, seed: 3 });
  assert.equal(cloud.samples, 20);
  await assert.rejects(hall.game(999_999), (error) => error instanceof ApiError && error.status === 404);
  await assert.rejects(hall.simulate({ ...scene, balls: [{ id: 99, x: 0, y: 0 }] }),
    (error) => error.status === 422 && error.field.includes('balls'));
  await assert.rejects(hallAt('http://127.0.0.1:1').live(), (error) => error.status === 0);
});

test('a bot is told why it is refused, and comes back after a restart with its game', enough, async () => {
  const refusals = [];
  let turns = 0;
  let restarted = false;
  let token = null;
  const games = new Set();
  const over = play({
    port: port(), name: 'back', challenge: { opponent: 'house:random' }, games: 1,
    onToken: (given) => { token = given; },
    onGame: (terms) => games.add(terms.game),
    onRefusal: (error) => refusals.push(error),
  }, (turn, terms) => {
    turns += 1;
    if (restarted) {
      return 'concede';
    }
    return turn.refusals === 0 && turn.kind === 'shot' ? { params: { a: 0, b: 0, theta: 5, phi: 0, v: -1 } } : stroke(turn, terms);
  });
  await until(() => refusals.length > 0 && turns > 3, 'a refusal and some turns');
  assert.ok(refusals[0] instanceof AgentError);
  assert.match(refusals[0].code, /^bad_/);
  const { agents: listen, http } = server;
  await server.stop('SIGKILL');
  restarted = true;
  server = await startServer(directory.path, { listen, http });
  const result = await over;
  assert.equal(result.token, token);
  assert.equal(games.size, 1, 'the same game goes on');
});

test('what would not help a second time is an error at once', enough, async () => {
  const options = { port: port(), challenge: { opponent: 'nobody' }, games: 1 };
  await assert.rejects(play({ ...options, name: 'lonely' }, stroke), (error) => error.code === 'unknown_agent');
  await assert.rejects(play({ ...options, name: 'no such name' }, stroke), (error) => /name/.test(error.message));
  await assert.rejects(play({ ...options, name: 'faulty', challenge: { opponent: 'house:random' } },
    () => { throw new Error('of the bot'); }), /of the bot/);
});

test('the example bot plays a whole game', enough, async () => {
  const said = await new Promise((resolve, reject) => {
    execFile(process.execPath, [join(root, 'clients/javascript/example_bot.js'), server.agents],
      (error, out, problem) => (error ? reject(new Error(problem)) : resolve(out)));
  });
  assert.match(said, /^game over: (won|not won), \w+/);
});
