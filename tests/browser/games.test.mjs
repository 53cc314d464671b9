// Games as they also happen: one that the clock ends, one of hundreds of turns, one that is met in the
// middle of a shot.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { Bot } from './bot.mjs';
import { Chromium } from './chromium.mjs';
import { startServer, temporaryDirectory, until } from './program.mjs';

const enough = { timeout: 50_000 };
const manyTurns = 400;
let directory;
let server;
let browser;
let bots = [];

before(async () => {
  directory = temporaryDirectory();
  [server, browser] = await Promise.all([startServer(directory.path), Chromium.start()]);
}, enough);

after(async () => {
  bots.forEach((bot) => bot.leave());
  await browser?.close();
  await server?.stop();
  directory?.remove();
});

const api = async (path) => (await fetch(server.url + path)).json();

/** A new game of two who do in each turn what `act` says; its id. */
async function game(names, clock, act) {
  const pair = await Promise.all(names.map((name) => Bot.join(server.agents, name)));
  bots.push(...pair);
  return new Promise((resolve, reject) => {
    pair.forEach((bot) => {
      bot.onTurn = (turn) => {
        resolve(turn.game);
        act(bot, turn);
      };
    });
    pair[0].ask('challenge', { opponent: names[1], clock }).catch(reject);
  });
}

const hardBreak = { phi: 90.3, v: 8, theta: 5, b: 2 };

async function open(hash, key) {
  const page = await browser.newPage();
  await page.open(`${server.url}/#${hash}`);
  await page.ready(key);
  return page;
}

async function close(page) {
  assert.deepEqual(page.problems, []);
  await page.close();
}

test('a game that the clock ends says so, live and afterwards', enough, async () => {
  const page = await open('/', 'tournaments/');
  const id = await game(['hasty', 'sleepy'], { game_ms: 3000 }, (bot, turn) => (turn.turn < 2 ? bot.shoot(turn, hardBreak) : null));
  await page.go(`#/games/${id}`, `games/${id}`);
  await page.until(() => document.querySelector('main').dataset.over === 'true', 'the clock has ended it');
  await page.until(() => /wins: timeout/.test(document.querySelector('.result')?.textContent ?? ''), 'the result');
  const look = () => page.evaluate(() => ({
    result: document.querySelector('.result').textContent,
    last: document.querySelector('.shots li:last-child').textContent,
    clocks: [...document.querySelectorAll('.clock')].map((e) => e.textContent),
    winner: document.querySelector('.player.winner .name').textContent,
    score: [...document.querySelectorAll('.score')].map((e) => e.textContent),
    live: !document.querySelector('.options button').hidden,
  }));
  const seen = await look();
  const { agents, turns, winner } = await api(`/api/games/${id}`);
  assert.equal(turns.at(-1).action, 'timeout');
  assert.equal(seen.result, `${agents[winner]} wins: timeout.`);
  assert.match(seen.last, /ran out of time/);
  assert.equal(seen.clocks[1 - winner], '0.0');
  assert.equal(seen.winner, agents[winner]);
  assert.equal(seen.score[winner], '1');
  assert.equal(seen.live, false);
  await page.go('#/', 'tournaments/');
  await page.go(`#/games/${id}/shots/${turns.length}`, `games/${id}`);
  assert.deepEqual(await look(), seen);
  await close(page);
});

test('a game is met in the middle of a shot', enough, async () => {
  const page = await open('/', 'tournaments/');
  const id = await game(['breaker', 'thinker'], { game_ms: 600_000 }, (bot, turn) => (turn.turn === 1 ? bot.shoot(turn, hardBreak) : null));
  const { stored_ms: stored, events } = await until(async () => {
    const { turns: [first] } = await api(`/api/games/${id}`);
    return first && api(`/api/games/${id}/shots/1`);
  }, 'the break is stored');
  await until(() => Date.now() > stored + 1200, 'the balls roll');
  await page.go(`#/games/${id}`, `games/${id}`);
  await page.until(() => document.querySelector('main').dataset.live === 'open' && window.poolhall.view.playback.playing, 'it plays');
  const { t, now } = await page.evaluate(() => ({ t: window.poolhall.view.playback.t, now: Date.now() }));
  const age = (now - stored) / 1000;
  assert.ok(age < events.at(-1).t, `the balls still roll after ${age} s`);
  // What the server said is from before the page was ready to draw it.
  assert.ok(t > age - 1 && t < age + 0.05, `${t} s on the screen, ${age} s since the strike`);
  await close(page);
});

test('who leaves a game at once is not held back by its address', enough, async () => {
  const id = await game(['quick', 'slow'], { game_ms: 600_000 }, (bot, turn) => (turn.turn === 1 ? bot.shoot(turn, hardBreak) : null));
  await until(async () => (await api(`/api/games/${id}`)).turns.length > 0, 'the break is stored');
  const page = await open(`/games/${id}/shots/1?t=0.5`, `games/${id}`);
  await page.evaluate(() => {
    location.hash = '#/agents';
    window.poolhall.view.remember();  // as its timer may, before the page hears of the new address
  });
  await page.ready('agents/');
  await close(page);
});

/** In the page: a game's turns over and over again, until there are many. */
function lengthen(id, most) {
  const real = window.fetch;
  window.fetch = async (url, options) => {
    const [, turn] = new URL(url).pathname.match(`^/api/games/${id}(?:/shots/(\\d+))?$`) ?? [null, null];
    if (turn === null) {
      return real(url, options);
    }
    const game = await (await real(`/api/games/${id}`)).json();
    if (turn !== undefined) {
      const shot = await (await real(`/api/games/${id}/shots/${1 + ((turn - 1) % game.turns.length)}`)).json();
      return new Response(JSON.stringify({ ...shot, turn: Number(turn) }));
    }
    const turns = [...Array(most).keys()].map((i) => ({ ...game.turns[i % game.turns.length], turn: i + 1 }));
    return new Response(JSON.stringify({ ...game, turns }));
  };
}

test('a game of hundreds of turns is quick to use', enough, async () => {
  const id = await game(['tap', 'tip'], { game_ms: 600_000 }, (bot, turn) => (turn.turn === 1 ? bot.shoot(turn, hardBreak)
    : bot.ask('concede', { game: turn.game })));
  await until(async () => (await api(`/api/games/${id}`)).over, 'it is over');
  const page = await open('/', 'tournaments/');
  await page.evaluate(lengthen, id, manyTurns);
  await page.go(`#/games/${id}/shots/350?t=0`, `games/${id}`);
  const seen = await page.evaluate(() => {
    const list = document.querySelector('.shots');
    const [outer, inner] = [list, list.querySelector('.current')].map((e) => e.getBoundingClientRect());
    return { count: list.children.length, turn: list.querySelector('.current').dataset.turn,
      inside: inner.top >= outer.top && inner.bottom <= outer.bottom };
  });
  assert.deepEqual(seen, { count: manyTurns, turn: '350', inside: true });
  // One more turn, told live, and where one is: laid out, too.
  const each = await page.evaluate(() => {
    const { view } = window.poolhall;
    const spent = [...Array(21).keys()].map(() => {
      view.game.turns.push({ ...view.game.turns[0], turn: view.game.turns.length + 1 });
      const began = performance.now();
      view.paintList();
      document.querySelector('.shots').getBoundingClientRect();
      return performance.now() - began;
    });
    return spent.sort((a, b) => a - b)[10];
  });
  console.log(`# a line more in a list of ${manyTurns}: ${each.toFixed(2)} ms`);
  assert.equal(await page.evaluate(() => document.querySelector('.shots').children.length), manyTurns + 21);
  assert.ok(each < 10, `${each} ms`);
  await close(page);
});
