// The program under test, run as a user would: `poolhall simulate` for the truth, `poolhall serve`
// for a real server with a database of its own.
//
//   const server = await startServer(directory);
//   await fetch(`${server.url}/healthz`);
//   await server.stop();
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const program = process.env.POOLHALL_PROGRAM ?? join(root, 'build/release/poolhall');

/** What `poolhall simulate` prints of a scene. */
export const simulateText = (scene) =>
  execFileSync(program, ['simulate', '-'], { input: JSON.stringify(scene), encoding: 'utf8' });

/** Many scenes in one process. */
export const simulateAll = (scenes) =>
  execFileSync(program, ['simulate', '--lines', '-'], {
    input: scenes.map((scene) => JSON.stringify(scene)).join('\n'), encoding: 'utf8', maxBuffer: 1 << 28,
  }).trim().split('\n').map((line) => JSON.parse(line));

export function temporaryDirectory() {
  const path = mkdtempSync(join(tmpdir(), 'poolhall-page-'));
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}

/** Polls until `look` gives something; the test's own deadline bounds it. */
export async function until(look, what, milliseconds = 10_000) {
  const end = Date.now() + milliseconds;
  for (;;) {
    const found = await look();
    if (found) {
      return found;
    }
    if (Date.now() > end) {
      throw new Error(`not within ${milliseconds} ms: ${what}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** @param {string} directory @param {{http?: string, listen?: string, args?: string[]}} options */
export async function startServer(directory, { http = '127.0.0.1:0', listen = '127.0.0.1:0', args = [] } = {}) {
  const ready = join(directory, 'ready.json');
  rmSync(ready, { force: true });
  const child = spawn(program, ['serve', '--listen', listen, '--http', http, '--db', join(directory, 'page.db'),
    '--ready-file', ready, ...args], { stdio: ['ignore', 'ignore', 'pipe'] });
  let log = '';
  child.stderr.on('data', (text) => { log += text; });
  const gone = new Promise((resolve) => child.on('exit', resolve));
  await until(() => existsSync(ready) || child.exitCode !== null, 'the server listens');
  if (child.exitCode !== null) {
    throw new Error(`the server has ended: ${log}`);
  }
  const { agents, http: page } = JSON.parse(readFileSync(ready, 'utf8'));
  return {
    agents,
    http: page,
    url: `http://${page}`,
    log: () => log,
    async stop(signal = 'SIGTERM') {
      child.kill(signal);
      await gone;
    },
  };
}
