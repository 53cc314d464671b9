// What a thousand spectators of one game cost those who play: one server, a game with 2 strokes a
// second that all watch, other games with many strokes a second from `poolhall load`; windows with
// and without spectators in turn, and the ratio of the players' p99.
//
//   node tests/browser/spectators.mjs [--spectators 1000] [--rate 1000] [--windows 4] [--seconds 8]
import { spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';
import { playingPair } from './bot.mjs';
import { program, startServer, temporaryDirectory, until } from './program.mjs';

const option = (name, fallback) => {
  const at = process.argv.indexOf(`--${name}`);
  return at > 0 ? Number(process.argv[at + 1]) : fallback;
};
const spectators = option('spectators', 1000);
const rate = option('rate', 1000);
const games = option('games', 64);
const windows = option('windows', 4);
const seconds = option('seconds', 8);

/** One who watches: a WebSocket that reads and forgets. */
function watch(address, path) {
  const [host, port] = address.split(':');
  const socket = connect(Number(port), host);
  const spectator = { socket, bytes: 0, open: false };
  socket.on('error', () => {});
  socket.on('data', (data) => {
    spectator.bytes += data.length;
    spectator.open = true;
  });
  socket.write(`GET ${path} HTTP/1.1\r\nHost: ${address}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n`
    + `Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: ${randomBytes(16).toString('base64')}\r\n\r\n`);
  return spectator;
}

/** A window of `poolhall load`: what it measured, as JSON. */
function load(agents) {
  const child = spawn(program, ['load', '--connect', agents, '--games', games, '--rate', rate,
    '--seconds', seconds, '--warm-up', 2, '--json'].map(String), { stdio: ['ignore', 'pipe', 'inherit'] });
  let out = '';
  child.stdout.on('data', (text) => { out += text; });
  return new Promise((resolve) => child.on('exit', () => resolve(JSON.parse(out))));
}

const directory = temporaryDirectory();
const config = `${directory.path}/server.toml`;
const { writeFileSync } = await import('node:fs');
writeFileSync(config, '[limits]\nconnections_per_address = 10000\n[log]\nlevel = "warning"\n');
const server = await startServer(directory.path, { args: ['--config', config] });
const pair = await playingPair(server, 500);
await pair.begin();

const live = async () => (await fetch(`${server.url}/api/live`)).json();
const watched = async () => (await live()).games.find((g) => g.agents.includes('anna'));
const results = { without: [], with: [] };
try {
  for (let i = 0; i < windows; ++i) {
    for (const kind of i % 2 === 0 ? ['without', 'with'] : ['with', 'without']) {
      const { game } = await until(watched, 'the watched game goes on');
      const audience = kind === 'with'
        ? [...Array(spectators)].map(() => watch(server.http, `/ws/games/${game}`)) : [];
      await until(() => audience.every((s) => s.open), 'all spectators watch', 30_000);
      const report = await load(server.agents);
      const told = audience.reduce((sum, s) => sum + s.bytes, 0);
      audience.forEach((s) => s.socket.destroy());
      results[kind].push(report);
      console.log(`${kind.padEnd(7)} spectators: ${JSON.stringify(report).slice(0, 400)} ${
        kind === 'with' ? `told ${(told / 1e6).toFixed(0)} MB` : ''}`);
    }
  }
} finally {
  pair.leave();
  await server.stop();
  directory.remove();
}
const p99 = (reports) => reports.map((r) => r.latency_ms?.p99 ?? NaN).sort((a, b) => a - b);
const median = (list) => (list[Math.floor((list.length - 1) / 2)] + list[Math.ceil((list.length - 1) / 2)]) / 2;
const [without, withThem] = [median(p99(results.without)), median(p99(results.with))];
console.log(`players' p99, median of ${windows} windows of ${seconds} s at ${rate} answers/s: without ${
  without.toFixed(2)} ms, with ${spectators} spectators ${withThem.toFixed(2)} ms, ratio ${(withThem / without).toFixed(3)}`);
