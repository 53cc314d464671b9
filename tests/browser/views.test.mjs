// Every view as people meet it who did not write it: an empty database, addresses of nothing, names
// with HTML in them, contrast, focus, small screens.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Chromium } from './chromium.mjs';
import { program, root, startServer, temporaryDirectory, until } from './program.mjs';
import { problems } from './schema.mjs';

const enough = { timeout: 100_000 };
let directory;
let empty;
let server;
let nothing;
let browser;
let tournament;

/** Runs SQL on a database that no server has open. */
const sql = (database, text) => execFileSync('/usr/bin/python3',
  ['-c', 'import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); c.executescript(sys.argv[2]); c.close()', database, text]);

before(async () => {
  [directory, empty] = [temporaryDirectory(), temporaryDirectory()];
  const file = join(root, 'tests/browser/small.toml');
  execFileSync(program, ['tournament', 'run', file, '--db', join(directory.path, 'page.db'), '--http', '127.0.0.1:0'], { stdio: 'ignore' });
  [server, nothing, browser] = await Promise.all(
    [startServer(directory.path), startServer(empty.path), Chromium.start()]);
  tournament = (await (await fetch(`${server.url}/api/tournaments`)).json()).tournaments[0].tournament;
}, enough);

after(async () => {
  await browser?.close();
  await server?.stop();
  await nothing?.stop();
  directory?.remove();
  empty?.remove();
});

const api = async (path) => (await fetch(server.url + path)).json();

/** Opens each address in turn and lets `look` judge what is there. */
async function tour(origin, views, look, options = {}) {
  const page = await browser.newPage(options);
  await page.open(`${origin}/#/`);
  await page.ready('tournaments/');
  for (const [hash, key] of views) {
    await page.go(`#${hash}`, key);
    await look(page, hash);
  }
  assert.deepEqual(page.problems, []);
  await page.close();
}

async function allViews() {
  const page = await api(`/api/tournaments/${encodeURIComponent(tournament)}`);
  const game = page.matches[0].games[0].game;
  const agent = page.entries[0].agent;
  return [
    ['/agents', 'agents/'],
    [`/tournaments/${encodeURIComponent(tournament)}`, `tournaments/${tournament}`],
    [`/games/${game}/shots/1?t=0.5`, `games/${game}`],
    [`/agents/${encodeURIComponent(agent)}`, `agents/${agent}`],
    ['/workbench', 'workbench/'],
    ['/', 'tournaments/'],
  ];
}

test('what the API answers is what its OpenAPI document says', enough, async () => {
  const { paths, components: { schemas } } = await api('/api/openapi.json');
  const { matches, entries } = await api(`/api/tournaments/${tournament}`);
  const game = matches[0].games[0].game;
  const scene = { table: 'bar7', physics: 'modern', balls: [{ id: 0, x: 0.5, y: 0.5 }, { id: 3, x: 0.5, y: 1 }],
    shot: { a: 0, b: 0, theta: 5, phi: 90, v: 2 } };
  const asked = {
    '/healthz': '/healthz',
    '/api/live': '/api/live',
    '/api/agents': '/api/agents',
    '/api/agents/{agent}': `/api/agents/${entries[0].agent}`,
    '/api/tournaments': '/api/tournaments',
    '/api/tournaments/{tournament}': `/api/tournaments/${tournament}`,
    '/api/games/{game}': `/api/games/${game}`,
    '/api/games/{game}/shots/{turn}': `/api/games/${game}/shots/1`,
    '/api/evaluate': ['/api/evaluate', { scene, noise: 'low', samples: 9 }],
  };
  for (const [path, item] of Object.entries(paths)) {
    const [operation] = Object.values(item);
    const [, success] = Object.entries(operation.responses).find(([status]) => status.startsWith('2'));
    const { schema } = success.content['application/json'] ?? {};
    assert.equal(Boolean(schema), path in asked || path.startsWith('/api/admin/'), path);
    const [target, body] = [asked[path] ?? []].flat();
    if (target) {
      const response = await fetch(server.url + target, body ? { method: 'POST', body: JSON.stringify(body) } : {});
      assert.deepEqual(problems(schemas, schema, await response.json()), [], target);
    }
  }
  const refusal = await (await fetch(`${server.url}/api/evaluate`, { method: 'POST', body: '{}' })).json();
  assert.deepEqual(problems(schemas, { $ref: '#/components/schemas/Refusal' }, refusal), []);
});

test('without a single game every view says so', enough, () => tour(nothing.url,
  [['/agents', 'agents/'], ['/workbench', 'workbench/'], ['/', 'tournaments/']], async (page, hash) => {
    const words = { '/agents': 'No game has been scored yet', '/workbench': 'Strike', '/': 'None yet[^]*No game goes on' }[hash];
    await page.until((source) => new RegExp(source).test(document.querySelector('main').textContent), words, words);
  }));

test('what is not there is said, with a way back', enough, async () => {
  const page = await browser.newPage();
  await page.open(`${server.url}/#/`);
  await page.ready('tournaments/');
  for (const [hash, words] of [['/games/999999', /no such game/], ['/tournaments/nope', /no such tournament/],
    ['/agents/nobody', /no such agent/], ['/nowhere', /no such page/], ['/games/x', /no such page/],
    ['/%E0%A4%A', /no such page/], ['/workbench?game=999999', /no such game/], ['/games/1/shots/99999', /no such turn/]]) {
    await page.evaluate((to) => { location.hash = to; }, `#${hash}`);
    await page.until((source) => new RegExp(source, 'i').test(document.querySelector('[role=alert]')?.textContent ?? ''),
      `${hash} is refused`, words.source);
    assert.ok(await page.evaluate(() => Boolean(document.querySelector('main a[href="#/"]'))), hash);
    await page.go('#/', 'tournaments/');
  }
  const unexpected = page.problems.filter((p) => !/404/.test(p));
  assert.deepEqual(unexpected, []);
  await page.close();
});

/** In the page: texts that are hard to read on their ground, with the ratio of their lightness. */
function poorTexts() {
  const parsed = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
  const over = ([r, g, b, a = 1], ground) => [r, g, b].map((c, i) => c * a + ground[i] * (1 - a));
  const groundOf = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      const style = getComputedStyle(e);
      if (style.backgroundImage !== 'none') {
        return null;  // painted: judged by eye
      }
      layers.push(parsed(style.backgroundColor));
    }
    return layers.reverse().reduce((ground, layer) => over(layer, ground), [255, 255, 255]);
  };
  const light = (rgb) => rgb.map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const found = [];
  for (const element of document.querySelectorAll('body *')) {
    const own = [...element.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    const box = element.getBoundingClientRect();
    if (!own || box.width === 0 || element.closest('.dot, noscript, option')) {
      continue;
    }
    const style = getComputedStyle(element);
    const ground = groundOf(element);
    if (!ground) {
      continue;
    }
    const colour = over(parsed(element instanceof SVGElement ? style.fill : style.color), ground);
    const [a, b] = [light(colour), light(ground)].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio < (large ? 3 : 4.5)) {
      found.push(`${element.tagName}.${element.className}: "${element.textContent.slice(0, 30)}" ${ratio.toFixed(2)}`);
    }
  }
  return found;
}

for (const scheme of ['dark', 'light']) {
  test(`all text has enough contrast to its ground, ${scheme}`, enough, async () => tour(server.url, await allViews(),
    async (page, hash) => assert.deepEqual(await page.evaluate(poorTexts), [], hash), { scheme }));
}

test('the colour scheme is the one that the browser asks for, also while the page is open', enough, async () => {
  const [, , [hash, key]] = await allViews();
  await tour(server.url, [[hash, key]], async (page) => {
    const colours = () => page.evaluate(() => {
      const { canvas } = window.poolhall.view;
      const [corner] = [canvas.getContext('2d').getImageData(0, 0, 1, 1).data];
      const page = getComputedStyle(document.documentElement).backgroundColor;
      return { page, corner: `rgb(${corner[0]}, ${corner[1]}, ${corner[2]})` };
    });
    const dark = await colours();
    assert.equal(dark.corner, dark.page, 'the table lies on the page');
    await page.prefer({ scheme: 'light' });
    await until(async () => {
      const light = await colours();
      return light.page !== dark.page && light.corner === light.page;
    }, 'both have become light');
  });
});

test('every control has a name, is reached by Tab and shows that it is', enough, async () => tour(server.url, await allViews(), async (page, hash) => {
  const nameless = await page.evaluate(() => [...document.querySelectorAll('button, a, select, input, textarea, canvas, progress')]
    .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.closest('label')?.textContent.trim()
      || e.getAttribute('title'))).map((e) => e.outerHTML.slice(0, 80)));
  assert.deepEqual(nameless, [], hash);
  await page.evaluate(() => document.body.focus());
  const stops = new Set();
  for (let i = 0; i < 12; ++i) {
    await page.press('Tab');
    const stop = await page.evaluate(() => {
      const e = document.activeElement;
      const style = getComputedStyle(e);
      return { what: e.outerHTML.slice(0, 90), shown: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0 };
    });
    stops.add(stop.what);
    assert.ok(stop.shown || stop.what.startsWith('<body'), `${hash}: ${stop.what} does not show its focus`);
  }
  assert.ok(stops.size >= 4, `${hash}: ${[...stops].join(' ')}`);
}));

test('nothing is wider than a phone', enough, async () => tour(server.url, await allViews(), async (page, hash) => {
  const { over, wide } = await page.evaluate(() => ({
    over: document.documentElement.scrollWidth - window.innerWidth,
    wide: [...document.querySelectorAll('main *')].filter((e) => e.getBoundingClientRect().right > window.innerWidth + 1
      && !e.closest('.scroll, select, svg')).map((e) => e.outerHTML.slice(0, 60)).slice(0, 3),
  }));
  assert.ok(over <= 0, `${hash}: ${over} px, ${wide.join(' ')}`);
}, { width: 360, height: 740, density: 2, touch: true }));

test('the page tells the standings that the program tells', enough, async () => {
  const { standings, break_advantage: advantage } = await api(`/api/tournaments/${tournament}`);
  const table = await api(`/api/tournaments/${tournament}/standings`);
  assert.equal(standings.length, table.standings.length);
  standings.forEach((row, i) => {
    const other = table.standings[i];
    assert.deepEqual([row.rank, row.agent, row.points, row.wins, row.losses, row.draws, row.rating],
      [other.rank, other.entry, other.points, other.wins, other.losses, other.draws, other.rating_status]);
    assert.deepEqual(row.estimate, other.elo === undefined ? null : { elo: other.elo, margin: other.elo_margin });
  });
  assert.deepEqual(advantage, table.break_advantage ?? null);
});

test('HTML in names and titles, all the way from the database, is shown as text', enough, async () => {
  const evil = '<img src=x onerror="window.hacked=1"><script>window.hacked=1</script>&lt;b&gt;"\'';
  const quoted = evil.replaceAll("'", "''");
  await server.stop();
  sql(join(directory.path, 'page.db'), `UPDATE agents SET name = name || '${quoted}'; UPDATE tournaments SET title = '${quoted}';`);
  server = await startServer(directory.path);
  const seen = [];
  await tour(server.url, await allViews(), async (page, hash) => {
    const { text, elements, hacked } = await page.evaluate(() => ({
      text: document.querySelector('main').textContent,
      elements: document.querySelectorAll('main img, main script, main b:not(.slider b, .figures b)').length,
      hacked: window.hacked ?? null,
    }));
    assert.deepEqual([elements, hacked], [0, null], hash);
    if (text.includes(evil)) {
      seen.push(hash);
    }
  });
  assert.equal(seen.length, 5, `all views but the workbench show it: ${seen}`);
});
