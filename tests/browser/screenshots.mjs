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
const play = (file) => execFileSync(program, ['tournament', 'run', file, '--http', '127.0.0.1:0',
  '--db', join(directory.path, 'page.db')], { stdio: 'ignore' });
play(join(root, 'config/tournaments/demo.toml'));
play(join(root, 'config/tournaments/sprt.toml'));
play(cup());
const [server, browser] = await Promise.all([startServer(directory.path), Chromium.start()]);

/** A double elimination of eight of different effort. */
function cup() {
  const entries = [1200, 800, 400, 200, 100, 50, 25].map((effort) =>
    `[[entry]]\nname = "greedy-${effort}"\nhouse = "greedy"\noptions = {effort = ${effort}}\n`);
  const file = join(directory.path, 'cup.toml');
  writeFileSync(file, `name = "double"\nformat = "double_elimination"\ngames_per_match = 4\nseed = 11\n`
    + `max_concurrent_games_per_entry = 2\n${entries.join('')}[[entry]]\nhouse = "random"\n`);
  return file;
}

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
  const phone = { width: 390, height: 844, touch: true };
  await picture('phone', `/games/${game}/shots/2?t=0.5`, `games/${game}`, phone);
  await picture('phone-bracket', '/tournaments/double', 'tournaments/double', phone);
  await picture('bracket', '/tournaments/double', 'tournaments/double', { width: 1280, height: 1000, scheme: 'light' });
  await picture('sprt', '/tournaments/sprt', 'tournaments/sprt', { width: 1280, height: 700 });
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
