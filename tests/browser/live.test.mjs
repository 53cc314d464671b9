// What spectators are told, held against the API and against the clock.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { playingPair } from './bot.mjs';
import { startServer, temporaryDirectory, until } from './program.mjs';
import { Spectator } from './socket.mjs';

const enough = { timeout: 50_000 };
const served = [];

// They play one game after the other; whichever goes on now.
const current = (api) => until(async () => (await api('/api/live')).games[0]?.game, 'a game goes on');

async function playedOn(args = [], settings = '') {
  const directory = temporaryDirectory();
  if (settings) {
    const file = join(directory.path, 'server.toml');
    writeFileSync(file, settings);
    args.push('--config', file);
  }
  const server = await startServer(directory.path, { args });
  const pair = await playingPair(server, 60);
  await pair.begin();
  const api = async (path) => (await fetch(server.url + path)).json();
  const game = await current(api);
  const play = { directory, server, pair, game, api };
  served.push(play);
  return play;
}

let play;
before(async () => {
  play = await playedOn();
}, enough);

after(async () => {
  for (const { pair, server, directory } of served) {
    pair.leave();
    await server.stop();
    directory.remove();
  }
});

test('a spectator gets a snapshot, then every turn, as the API has it', enough, async () => {
  const { server, api } = play;
  const game = await until(async () => {
    const one = await current(api);
    return (await api(`/api/games/${one}`)).turns.length > 0 && one;
  }, 'a turn is stored');
  const spectator = await Spectator.watch(server.http, `/ws/games/${game}`);
  const snapshot = await spectator.next(() => true);
  assert.equal(snapshot.type, 'snapshot');
  assert.ok(snapshot.last.events.length > 0, 'the shot that may still roll');
  let expected = snapshot.last.turn;
  let { live } = snapshot;
  for (let i = 0; i < 5 && live; ++i) {
    const message = await spectator.next(() => true);
    assert.equal(message.type, 'turn');
    assert.equal(message.turn.turn, ++expected, 'none is missed');
    assert.deepEqual(message.turn, await api(`/api/games/${game}/shots/${expected}`));
    live = !message.over;
  }
  assert.ok(!/"key"|token/.test(JSON.stringify(snapshot)));
  spectator.leave();
});

test('the lobby tells which games go on', enough, async () => {
  const before = await current(play.api);
  const spectator = await Spectator.watch(play.server.http, '/ws/lobby');
  const { live } = await spectator.next((m) => m.type === 'lobby' && m.live.games.length === 1);
  assert.ok(live.games[0].game >= before);
  spectator.leave();
});

test('other sites, other hosts and other topics are refused', enough, async () => {
  const { http } = play.server;
  for (const [path, options, status] of [
    ['/ws/lobby', { origin: 'http://evil.example' }, 403],
    ['/ws/lobby', { host: 'evil.example' }, 421],
    ['/ws/games/x', {}, 404],
    ['/ws/other', {}, 404],
    ['/ws/lobby', { origin: `http://${http}` }, 101],
  ]) {
    const spectator = await Spectator.watch(http, path, options);
    assert.equal(spectator.status, status, `${path} ${JSON.stringify(options)}`);
    spectator.leave();
  }
});

test('who does not read for a while sees the newest turn afterwards', enough, async () => {
  const { server, api } = play;
  const game = await current(api);
  const slow = await Spectator.watch(server.http, `/ws/games/${game}`);
  await slow.next((m) => m.type === 'snapshot');
  slow.socket.pause();
  await until(async () => /poolhall_spectators 1\n/.test(await (await fetch(`${server.url}/metrics`)).text()),
    'one spectator, and those of before are gone');
  const count = async () => (await api(`/api/games/${game}`)).turns.length;
  const start = await count();
  await until(async () => await count() >= start + 15 || (await api(`/api/games/${game}`)).over, 'turns', 30_000);
  slow.socket.resume();
  const newest = await count();
  assert.ok(newest > start);
  await slow.next((m) => (m.turn ?? m.last)?.turn >= newest, 'the newest turn');
  slow.leave();
});

test('the workbench is rate-limited for an address and refuses what is no scene', enough, async () => {
  const post = (body) => fetch(`${play.server.url}/api/simulate`, { method: 'POST', body });
  assert.equal((await post('{')).status, 422);
  assert.equal((await post('x'.repeat(70_000))).status, 413);
  const scene = JSON.stringify({ table: 'olympiad', physics: 'olympiad', balls: [] });
  const statuses = await Promise.all([...Array(60)].map(async () => (await post(scene)).status));
  assert.ok(statuses.includes(200) && statuses.includes(429), statuses.join(' '));
  const elsewhere = await fetch(`${play.server.url}/api/simulate`,
    { method: 'POST', body: scene, headers: { Origin: 'http://evil.example' } });
  assert.equal(elsewhere.status, 403);
});

test('with a delay nobody is told before it has passed, by stream or page', enough, async () => {
  const late = await playedOn([], 'spectator_delay_seconds = 1.5\n[log]\nlevel = "warning"\n');
  const began = Date.now();
  const spectator = await Spectator.watch(late.server.http, `/ws/games/${late.game}`);
  await spectator.next((m) => m.type === 'snapshot');
  assert.ok(Date.now() - began >= 1400, `after ${Date.now() - began} ms`);
  const message = await spectator.next((m) => m.type === 'turn');
  assert.ok(Date.now() - message.turn.stored_ms >= 1400);
  const { turns } = await late.api(`/api/games/${late.game}`);
  assert.ok(turns.length > 0);
  assert.ok(Date.now() - turns.at(-1).stored_ms >= 1400);
  const { games } = await late.api('/api/live');
  assert.equal(games[0].state, undefined);
});
