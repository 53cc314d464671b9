// Tournaments of every kind on a running server: watched while they go on, and when they are over.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Chromium } from './chromium.mjs';
import { startServer, temporaryDirectory, until } from './program.mjs';

const enough = { timeout: 50_000 };
const token = 'a'.repeat(64);
let directory;
let server;
let browser;

before(async () => {
  directory = temporaryDirectory();
  const file = join(directory.path, 'token');
  writeFileSync(file, `${token}\n`, { mode: 0o600 });
  [server, browser] = await Promise.all([startServer(directory.path, { args: ['--admin-token-file', file] }), Chromium.start()]);
}, enough);

after(async () => {
  await browser?.close();
  await server?.stop();
  directory?.remove();
});

const api = async (path) => (await fetch(server.url + path)).json();

async function asHost(path, body) {
  const response = await fetch(`${server.url}/api/admin/${path}`, {
    method: 'POST', body, headers: { Authorization: `Bearer ${token}`, 'Content-Type': 'application/toml' },
  });
  assert.ok(response.ok, `${path}: ${response.status} ${await response.text()}`);
}

/** A tournament of house bots that cannot play; 'able' is the one that can. */
function settings(name, format, names, more = '') {
  const entries = names.map((entry) => `[[entry]]\nname = "${name}-${entry}"\n${entry === 'able'
    ? 'house = "greedy"\noptions = {effort = 50}' : 'house = "random"'}\n`);
  return `name = "${name}"\nformat = "${format}"\nrules = "9-ball"\ntable = "bar7"\nphysics = "modern"\nseed = 3\n`
    + `games_per_match = 2\nmax_concurrent_games = 4\n${more}\n[clock]\ngame_seconds = 60\n${entries.join('')}`;
}

/** Watched from before its start to its end, on one page that is never loaded again. */
async function watched(name, toml, look) {
  await asHost('tournaments', toml);
  const page = await browser.newPage({ height: 1400 });
  await page.open(`${server.url}/#/tournaments/${name}`);
  await page.ready(`tournaments/${name}`);
  assert.equal(await page.evaluate(() => document.querySelector('.crumbs .tag').textContent), 'open');
  await asHost(`tournaments/${name}/start`);
  const seen = new Set();
  await until(async () => {
    const { status, progress } = await page.evaluate(() => ({
      status: document.querySelector('.crumbs .tag').textContent, progress: document.querySelector('.progress').textContent,
    }));
    seen.add(progress);
    return status === 'finished';
  }, `${name} is over`, 40_000);
  assert.ok(seen.size > 1, `its progress was seen: ${[...seen].join(', ')}`);
  const data = await api(`/api/tournaments/${name}`);
  const rows = await page.evaluate(() => [...document.querySelectorAll('.data tbody tr')]
    .map((row) => [...row.querySelectorAll('th, td')].map((cell) => cell.textContent)));
  data.standings.forEach((row, i) => assert.deepEqual(rows[i].slice(0, 4), [row.rank, row.agent, row.points, row.games].map(String)));
  await look(page, data);
  assert.deepEqual(page.problems, []);
  await page.close();
}

const textOf = (page, selector) => page.evaluate((which) => [...document.querySelectorAll(which)]
  .map((e) => [...e.children].length > 0 ? [...e.children].map((c) => c.textContent) : e.textContent), selector);

test('a Swiss tournament tells its rounds and all games that it will have', enough, () =>
  watched('swiss', settings('swiss', 'swiss', ['able', 'b', 'c', 'd', 'e'], 'rounds = 3'), async (page, data) => {
    assert.match(await page.evaluate(() => document.querySelector('.card').textContent), /swiss · round 3 of 3[^]*12 of 12 games/);
    assert.deepEqual([data.rounds, data.rounds_drawn, data.games_planned, data.bracket], [3, 3, 12, []]);
  }));

/** What the boxes of a bracket say, held against the matches that the API lists. */
async function checkBracket(page, data) {
  const boxes = await page.evaluate(() => [...document.querySelectorAll('.box:not(.bye)')].map((box) => ({
    names: [...box.querySelectorAll('.name')].map((e) => e.textContent),
    points: [...box.querySelectorAll('.points')].map((e) => Number(e.textContent)),
    through: box.querySelector('.through .name')?.textContent,
  })));
  // As one line each: two may meet twice, on the winners' side and in the final.
  const told = data.bracket.filter((place) => place.played).map(({ agents, winner, matches }) => {
    const games = data.matches.filter(({ match }) => matches.includes(match)).flatMap((match) => match.games);
    return [...[...agents].sort(), winner, games.filter((game) => game.winner !== null).length].join(' ');
  });
  const shown = boxes.map(({ names, points, through }) => [...names.sort(), through, points[0] + points[1]].join(' '));
  assert.deepEqual(shown.sort(), told.sort());
}

test('a single elimination shows its bracket, byes and all', enough, () =>
  watched('knockout', settings('knockout', 'single_elimination', ['able', 'b', 'c', 'd', 'e']), async (page, data) => {
    await checkBracket(page, data);
    assert.equal(data.bracket.filter((place) => place.played).length, 4);
    assert.equal(data.bracket.at(-1).winner, data.standings[0].agent);
    assert.deepEqual(await textOf(page, '.bracket .round > .dim'), ['Round 1', 'Round 2', 'Round 3']);
  }));

/** How far each box of a bracket's second column is from the middle of the boxes of the first that lead to it, px. */
const offMiddle = (page) => page.evaluate(() => {
  const [first, second] = [...document.querySelector('.bracket').querySelectorAll('.round')].map((round) =>
    [...round.querySelectorAll('.box')].map((box) => box.getBoundingClientRect()).map(({ top, bottom }) => (top + bottom) / 2));
  return second.map((y, i) => Math.abs(y - (first[2 * i] + first[2 * i + 1]) / 2));
});

test('a double elimination shows both sides and the final', enough, () =>
  watched('twice', settings('twice', 'double_elimination', ['able', 'b', 'c', 'd']), async (page, data) => {
    assert.deepEqual(await textOf(page, 'h3'), ['Winners’ side', 'Losers’ side', 'Final']);
    assert.equal(data.bracket.at(-1).winner, data.standings[0].agent);
    await checkBracket(page, data);
    assert.ok((await offMiddle(page)).every((off) => off < 1), 'a match stands between those that lead to it');
    const joined = await page.evaluate(() => [...document.querySelectorAll('.boxes')].map((boxes) => boxes.className));
    assert.deepEqual(joined.slice(0, 4), ['boxes pairs', 'boxes ', 'boxes straight', 'boxes ']);
  }));

test('a ladder of eight has all of its crosstable on the screen', enough, () =>
  watched('ladder', settings('ladder', 'ladder', ['able', 'b', 'c', 'd', 'e', 'f', 'g', 'h'], 'rounds = 1'), async (page) => {
    const hidden = await page.evaluate(() => {
      const { parentElement } = document.querySelector('.cross');
      return parentElement.scrollWidth - parentElement.clientWidth;
    });
    assert.ok(hidden <= 0, `${hidden} px are hidden`);
  }));

test('a game that nobody came to play tells who has won it, and how', enough, async () => {
  const absent = '[[entry]]\nagent = "absent"\n';
  await asHost('tournaments', settings('absence', 'round_robin', ['able']) + absent);
  await asHost('tournaments/absence/start');
  await asHost('tournaments/absence/withdraw', JSON.stringify({ agent: 'absent' }));
  const { matches: [{ games: [{ game }] }] } = await until(async () => {
    const data = await api('/api/tournaments/absence');
    return data.status === 'finished' && data;
  }, 'both games are forfeited');
  const page = await browser.newPage();
  await page.open(`${server.url}/#/games/${game}`);
  await page.ready(`games/${game}`);
  assert.match(await page.evaluate(() => document.querySelector('.ruling').textContent), /absence-able wins: forfeit/);
  assert.match(await page.evaluate(() => document.querySelector('.crumbs').textContent), /absence-able won, forfeit/);
  assert.equal(await page.evaluate(() => document.querySelector('.player.winner .name').textContent), 'absence-able');
  await page.close();
});

test('games that came too late to count are told apart from those that were planned', enough, async () => {
  const page = await browser.newPage();
  await page.open(`${server.url}/#/`);
  await page.ready('tournaments/');
  const told = (data) => page.evaluate(async (of) => {
    const { progressBar } = await import('/tournaments_view.js');
    return progressBar(of).textContent;
  }, data);
  assert.equal(await told({ games_over: 50, games_planned: 48, games_running: 0 }), '48 of 48 games, 2 too late to count');
  assert.equal(await told({ games_over: 3, games_planned: 48, games_running: 2 }), '3 of 48 games, 2 running');
  await page.close();
});

test('an SPRT shows where it stands between its bounds', enough, () =>
  watched('test', settings('test', 'sprt', ['able', 'b'], 'rounds = 40\n[sprt]\nelo0 = 0\nelo1 = 100'), async (page, data) => {
    assert.equal(data.sprt.verdict, 'h1');
    const label = await page.evaluate(() => document.querySelector('.gauge').getAttribute('aria-label'));
    assert.equal(label, `Log likelihood ratio ${data.sprt.log_likelihood_ratio.toFixed(2)} after ${data.sprt.pairs} pairs`);
    assert.match(await page.evaluate(() => document.querySelector('.card').textContent), /SPRT[^]*H1 accepted/);
  }));
