// Pictures of every view for the README, taken of the real page:
//
//   node tests/browser/screenshots.mjs [FOLDER]      # docs/screenshots by default
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Chromium } from './chromium.mjs';
import { coarser } from './png.mjs';
import { program, root, startServer, temporaryDirectory } from './program.mjs';

const folder = process.argv[2] ?? join(root, 'docs/screenshots');
const directory = temporaryDirectory();
mkdirSync(folder, { recursive: true });
execFileSync(program, ['tournament', 'run', join(root, 'config/tournaments/demo.toml'),
  '--db', join(directory.path, 'page.db')], { stdio: 'ignore' });
const [server, browser] = await Promise.all([startServer(directory.path), Chromium.start()]);

/** A game of the two that can play, with the most turns: there is something to see in it. */
async function longGame() {
  const { matches } = await (await fetch(`${server.url}/api/tournaments/demo`)).json();
  const games = matches.flatMap((match) => match.games).filter((game) => !game.agents.includes('random'));
  return games.sort((a, b) => b.turns - a.turns)[0].game;
}

async function picture(name, hash, key, size, prepare = async () => {}) {
  const page = await browser.newPage(size);
  await page.open(`${server.url}/#${hash}`);
  await page.ready(key);
  await prepare(page);
  await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 500); }));
  writeFileSync(join(folder, `${name}.png`), coarser(await page.screenshot(), 8));
  if (page.problems.length > 0) {
    throw new Error(`${name}: ${page.problems.join('; ')}`);
  }
  await page.close();
}

try {
  const game = await longGame();
  const wide = { width: 1280, height: 800 };
  await picture('tournaments', '/', 'tournaments/', { width: 1280, height: 420 });
  await picture('tournament', '/tournaments/demo', 'tournaments/demo', { width: 1280, height: 1000 });
  await picture('game', `/games/${game}/shots/1?t=0.55`, `games/${game}`, wide);
  await picture('phone', `/games/${game}/shots/2?t=0.5`, `games/${game}`, { width: 390, height: 800, touch: true });
  await picture('agents', '/agents', 'agents/', { width: 1280, height: 560 });
  await picture('workbench', '/workbench', 'workbench/', { width: 1280, height: 900 }, (page) => page.evaluate(async () => {
    const { view } = window.poolhall;
    view.json.value = JSON.stringify({
      table: 'wpa9', physics: 'modern',
      balls: [{ id: 0, x: 0.42, y: 0.7 }, { id: 3, x: 0.86, y: 1.62 }, { id: 12, x: 0.3, y: 1.95 },
        { id: 8, x: 1.0, y: 2.2 }, { id: 6, x: 1.08, y: 0.9 }],
      shot: { a: 6, b: 8, theta: 5, phi: 63.2, v: 3.4 },
    });
    view.takeJson();
    view.noise = 'low';
    view.noiseSelect.value = 'low';
    await view.strike();
    view.playback.pause();
    view.playback.seek(view.playback.end);
  }));
} finally {
  await browser.close();
  await server.stop();
  directory.remove();
}
