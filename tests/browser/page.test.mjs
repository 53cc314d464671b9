// The page in a real browser against the real server.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { playingPair } from './bot.mjs';
import { Chromium } from './chromium.mjs';
import { simulateText, startServer, temporaryDirectory, until } from './program.mjs';
import { scenes } from './scenes.mjs';

const enough = { timeout: 50_000 };
const strokePause = 120;

let directory;
let server;
let browser;
let pair;
let game;

const api = async (path) => (await fetch(server.url + path)).json();
const at = (hash) => `${server.url}/#${hash}`;

before(async () => {
  directory = temporaryDirectory();
  [server, browser] = await Promise.all([startServer(directory.path), Chromium.start()]);
  pair = await playingPair(server, strokePause);
  await pair.begin();
  game = await until(async () => (await api('/api/live')).games[0]?.game, 'a game goes on');
  await until(async () => (await api(`/api/games/${game}`)).turns.length >= 3, 'three turns are stored');
}, enough);

after(async () => {
  pair?.leave();
  await browser?.close();
  await server?.stop();
  directory?.remove();
});

/** A page that must not complain while `work` uses it. */
async function withPage(options, work) {
  const page = await browser.newPage(options);
  try {
    await work(page);
    assert.deepEqual(page.problems, []);
  } finally {
    await page.close();
  }
}

/** A game that goes on, with its stream open: the next one, if it has ended meanwhile. */
async function openLive(page) {
  await until(async () => {
    const { games: [live] } = await api('/api/live');
    if (!live) {
      return false;
    }
    await page.open(at(`/games/${live.game}`));
    await page.ready(`games/${live.game}`);
    const over = await page.evaluate(() => window.poolhall.view.game.over);
    return !over && until(() => page.evaluate(() => document.querySelector('main').dataset.live === 'open'), 'the stream', 3000)
      .catch(() => false);
  }, 'a live game is open', 30_000);
}

const ballsOnScreen = () => {
  const { view } = window.poolhall;
  return view.motion.ballsAt(view.playback.t).map(({ id, x, y }) => ({ id, x, y }));
};

test('a live game is seen to move', enough, () => withPage({}, async (page) => {
  await openLive(page);
  const turns = await page.evaluate(() => window.poolhall.view.game.turns.length);
  await page.until((n) => window.poolhall.view.game.turns.length >= n + 3, 'three more turns are told', turns);
  const pixels = () => page.evaluate(() => {
    const { canvas } = window.poolhall.view;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i += 16) {
      sum = (sum * 31 + data[i]) % 1_000_000_007;
    }
    return sum;
  });
  const first = await pixels();
  await until(async () => await pixels() !== first, 'the picture changes');
}));

test('scrubbing to an instant gives the positions of the event log', enough, () => withPage({}, async (page) => {
  await page.open(at(`/games/${game}/shots/1?t=0`));
  await page.ready(`games/${game}`);
  const shot = await api(`/api/games/${game}/shots/1`);
  const { table, physics } = await api(`/api/games/${game}`);
  const balls = shot.state_before.balls.map((b) => (b.id === 0 ? { id: 0, ...shot.cue_ball } : b));
  const end = shot.events.at(-1).t;
  for (const share of [0.05, 0.2, 0.5, 0.8, 1]) {
    const t = share * end;
    await page.evaluate((value) => {
      const range = document.querySelector('.scrub input');
      range.value = String(value);
      range.dispatchEvent(new Event('input'));
    }, t);
    const drawn = await page.evaluate(ballsOnScreen);
    const truth = JSON.parse(simulateText({ table, physics, balls, shot: shot.executed, t_max: t })).final;
    for (const ball of truth.filter((b) => b.state !== 'pocketed')) {
      const seen = drawn.find((b) => b.id === ball.id);
      assert.ok(Math.hypot(seen.x - ball.x, seen.y - ball.y) < 1e-8, `ball ${ball.id} at ${t}`);
    }
  }
}));

test('a deep link opens its shot at its instant', enough, () => withPage({}, async (page) => {
  const { turns } = await api(`/api/games/${game}`);
  const wanted = turns.filter((each) => each.action === 'shot').at(-1).turn;
  const instant = (await api(`/api/games/${game}/shots/${wanted}`)).events.at(-1).t / 2;
  await page.open(at(`/games/${game}/shots/${wanted}?t=${instant}`));
  await page.ready(`games/${game}`);
  const { t, turn, playing } = await page.evaluate(() => {
    const { view } = window.poolhall;
    return { t: view.playback.t, turn: view.turn.turn, playing: view.playback.playing };
  });
  assert.deepEqual({ t, turn, playing }, { t: instant, turn: wanted, playing: false });
  assert.equal(await page.evaluate(() => document.querySelector('.shots .current').dataset.turn), String(wanted));
}));

test('keys play, pause, step from event to event and from shot to shot', enough, () => withPage({}, async (page) => {
  await page.open(at(`/games/${game}/shots/1?t=0`));
  await page.ready(`games/${game}`);
  const shot = await api(`/api/games/${game}/shots/1`);
  const time = () => page.evaluate(() => window.poolhall.view.playback.t);
  await page.press('ArrowRight');
  assert.equal(await time(), [...new Set(shot.events.map((e) => e.t))][1]);
  await page.press('ArrowLeft');
  assert.equal(await time(), 0);
  for (let i = 0; i < 3; ++i) {
    await page.press('[');  // slowly, so that it is not over before it is paused
  }
  assert.equal(await page.evaluate(() => window.poolhall.view.playback.speed), 0.1);
  await page.press(' ');
  await page.until(() => window.poolhall.view.playback.t > 0.005, 'it plays');
  await page.press(' ');
  assert.equal(await page.evaluate(() => window.poolhall.view.playback.playing), false);
  await page.press('ArrowRight', 8);
  await page.until(() => window.poolhall.view.turn.turn === 2, 'the next shot');
}));

test('a restart of the server is survived', enough, () => withPage({}, async (page) => {
  await openLive(page);
  const { http, agents } = server;
  const { tokens } = pair;
  await server.stop('SIGKILL');
  pair.leave();
  await page.until(() => document.querySelector('main').dataset.live === 'lost', 'the loss is noticed');
  server = await startServer(directory.path, { http, listen: agents });
  pair = await playingPair(server, strokePause, tokens);
  await page.until(() => document.querySelector('main').dataset.live === 'open', 'it is back');
  const turns = await page.evaluate(() => window.poolhall.view.game.turns.length);
  await page.until((n) => window.poolhall.view.game.turns.length > n || window.poolhall.view.game.over,
    'the game goes on', turns);
  // The browser itself notes the connection that was refused meanwhile.
  page.problems = page.problems.filter((p) => !/WebSocket|ERR_CONNECTION|ERR_EMPTY/.test(p));
}));

test("the workbench's result is what poolhall simulate prints", enough, () => withPage({}, async (page) => {
  await page.open(at('/workbench'));
  await page.ready('workbench/');
  for (const [name, scene] of Object.entries(scenes)) {
    if (!scene.shot) {
      continue;
    }
    await page.evaluate((text) => {
      const { view } = window.poolhall;
      view.json.value = text;
      view.takeJson();
    }, JSON.stringify(scene));
    await page.evaluate(() => window.poolhall.view.strike());
    const { resultText, sceneText } = await page.evaluate(() => {
      const { view } = window.poolhall;
      return { resultText: view.resultText, sceneText: view.sceneText };
    });
    assert.equal(resultText, simulateText(JSON.parse(sceneText)), name);
    await page.evaluate(() => new Promise((resolve) => { setTimeout(resolve, 60); }));
  }
}));

test('a scene that cannot be used leaves the one on the table', enough, () => withPage({}, async (page) => {
  await page.open(at('/workbench'));
  await page.ready('workbench/');
  const before = await page.evaluate(() => window.poolhall.view.sceneText);
  for (const text of ['{', '{"table": "nowhere", "physics": "olympiad", "balls": []}', '{"table": "wpa9", "physics": {}, "balls": []}']) {
    const { scene, said } = await page.evaluate((json) => {
      const { view } = window.poolhall;
      view.json.value = json;
      view.takeJson();
      return { scene: view.sceneText, said: view.status.textContent };
    }, text);
    assert.equal(scene, before);
    assert.match(said, /cannot be used/);
  }
  await page.evaluate(() => window.poolhall.view.strike());
  assert.match(await page.evaluate(() => window.poolhall.view.status.textContent), /events in/);
}));

test('a ball is dragged, the cue is aimed, noise gives a cloud', enough, () => withPage({}, async (page) => {
  await page.open(at('/workbench'));
  await page.ready('workbench/');
  const screen = (x, y) => page.evaluate((tx, ty) => {
    const { view } = window.poolhall;
    const box = view.canvas.getBoundingClientRect();
    const [px, py] = view.view.pixel(tx, ty);
    return [box.left + px * box.width / view.canvas.width, box.top + py * box.height / view.canvas.height];
  }, x, y);
  const balls = () => page.evaluate(() => window.poolhall.view.scene.balls);
  const [before] = (await balls()).filter((b) => b.id === 8);
  await page.drag(await screen(before.x, before.y), await screen(0.6, 1.1));
  const [ball] = (await balls()).filter((b) => b.id === 8);
  assert.ok(Math.hypot(ball.x - 0.6, ball.y - 1.1) < 0.005, JSON.stringify(ball));
  const [cue] = (await balls()).filter((b) => b.id === 0);
  await page.drag(await screen(cue.x, cue.y + 0.3), await screen(0.6, 1.1));
  const phi = await page.evaluate(() => window.poolhall.view.scene.shot.phi);
  const wanted = (Math.atan2(1.1 - cue.y, 0.6 - cue.x) * 180) / Math.PI;
  assert.ok(Math.abs(phi - wanted) < 0.5, `${phi}, not ${wanted}`);
  await page.evaluate(() => {
    window.poolhall.view.noise = 'olympiad';
    return window.poolhall.view.strike();
  });
  const cloud = await page.evaluate(() => window.poolhall.view.cloud);
  assert.ok(cloud.find((c) => c.id === 0).points.length > 100);
}));

test('a position of a game is taken to the workbench', enough, () => withPage({}, async (page) => {
  await page.open(at(`/workbench?game=${game}&turn=2`));
  await page.ready('workbench/');
  const { state_before } = await api(`/api/games/${game}/shots/2`);
  const balls = await page.evaluate(() => window.poolhall.view.scene.balls);
  for (const ball of state_before.balls.filter((b) => b.pocket === undefined && b.id !== 0)) {
    const taken = balls.find((b) => b.id === ball.id);
    assert.deepEqual([taken.x, taken.y], [ball.x, ball.y]);
  }
}));

test('HTML in names and reasons is shown as text', enough, () => withPage({}, async (page) => {
  const evil = '<img src=x onerror="window.hacked=1"><script>window.hacked=1</script>';
  await page.open(at('/'));
  await page.ready('tournaments/');
  // What the server would have to say for this to matter: the page's own fetch is answered so.
  const shown = await page.evaluate(async (text) => {
    const real = window.fetch;
    const entry = { agent: text, withdrawn: false };
    const row = { rank: 1, agent: text, points: 1, games: 1, wins: 1, losses: 0, draws: 0, tie_breaks: [],
      rating: 'rated', estimate: { elo: 1, margin: 2 }, group: 0 };
    const answer = { tournament: text, title: text, status: 'running', created_ms: 0, rules: text, format: text,
      games_over: 1, games_running: 0, games_planned: 1, entries: [entry], standings: [row], crosstable: [[null]],
      break_advantage: null, endings: { [text]: 1 }, rounds_drawn: 1, rounds: 1, sprt: null, remarks: [text],
      bracket: [{ round: 1, side: 'winners', played: true, agents: [text, text], winner: text, matches: [1] }],
      matches: [{ match: 1, over: true, agents: [text, text], games: [{ game: 1, number: 0, agents: [text, text],
        over: true, winner: 0, reason: text }] }] };
    window.fetch = async () => new Response(JSON.stringify({ ...answer, tournaments: [answer] }));
    location.hash = '#/tournaments/x';
    await new Promise((resolve) => { setTimeout(resolve, 300); });
    window.fetch = real;
    const main = document.querySelector('main');
    return { text: main.textContent, images: main.querySelectorAll('img, script').length, hacked: window.hacked };
  }, evil);
  assert.ok(shown.text.includes(evil));
  assert.equal(shown.images, 0);
  assert.equal(shown.hacked, undefined);
}));

test('the first view is small, its scripts are its own, and its headers are strict', enough, () =>
  withPage({}, async (page) => {
    await page.open(at(`/games/${game}`));
    await page.ready(`games/${game}`);
    const own = page.urls.every((url) => url.startsWith(server.url));
    assert.ok(own, page.urls.join(' '));
    console.log(`# first view of a game: ${page.bytes} bytes`);
    assert.ok(page.bytes < 100_000, `${page.bytes} bytes`);
    const response = await fetch(`${server.url}/`);
    const policy = response.headers.get('content-security-policy');
    assert.match(policy, /script-src 'self'/);
    assert.doesNotMatch(policy, /unsafe/);
    assert.equal(response.headers.get('content-type'), 'text/html; charset=utf-8');
    const inline = await page.evaluate(() => {
      const script = document.createElement('script');
      script.textContent = 'window.inlined = 1';
      document.body.append(script);
      return window.inlined ?? null;
    });
    assert.equal(inline, null);
    page.problems = page.problems.filter((p) => !/inline script/.test(p));
  }));

test('files have their types, an ETag that is honoured, and HEAD; other paths a page of their own', enough, async () => {
  for (const [path, type] of [['/main.js', 'text/javascript'], ['/style.css', 'text/css'], ['/icon.svg', 'image/svg+xml']]) {
    const first = await fetch(server.url + path);
    assert.ok(first.headers.get('content-type').startsWith(type), path);
    const body = await first.text();
    const again = await fetch(server.url + path, { headers: { 'If-None-Match': first.headers.get('etag') } });
    assert.equal(again.status, 304);
    assert.equal(await again.text(), '');
    const head = await fetch(server.url + path, { method: 'HEAD', headers: { 'Accept-Encoding': 'identity' } });
    assert.equal(Number(head.headers.get('content-length')), Buffer.byteLength(body));
    assert.equal(head.headers.get('content-encoding'), null);
    if (first.headers.get('content-encoding') === 'gzip') {
      assert.notEqual(head.headers.get('etag'), first.headers.get('etag'), 'another form has another tag');
    }
  }
  const missing = await fetch(`${server.url}/no/such/page`);
  assert.equal(missing.status, 404);
  assert.match(await missing.text(), /no such page/);
});

test('a frame with 16 moving balls takes some milliseconds', enough, () => withPage({ density: 2 }, async (page) => {
  await page.open(at('/workbench'));
  await page.ready('workbench/');
  await page.evaluate((text) => {
    window.poolhall.view.json.value = text;
    window.poolhall.view.takeJson();
  }, JSON.stringify(scenes['a break']));
  const instants = await page.evaluate(async () => {
    const { view } = window.poolhall;
    await view.strike();
    view.playback.pause();
    const moving = (t) => view.motion.ballsAt(t).filter((b) => /sliding|rolling/.test(b.state)).length;
    const found = [];
    for (let t = 0; t < view.playback.end; t += 0.005) {
      if (moving(t) === 16) {
        found.push(t);
      }
    }
    return found;
  });
  assert.ok(instants.length > 10, `${instants.length} instants have 16 moving balls`);
  // Processor time of the page's thread, which draws: other programs do not count.
  await page.send('Performance.enable', { timeDomain: 'threadTicks' });
  const spent = async () => (await page.send('Performance.getMetrics')).metrics
    .find((metric) => metric.name === 'TaskDuration').value;
  const draw = (list) => page.evaluate(async (times) => {
    const { view } = window.poolhall;
    for (const t of times) {
      await new Promise((resolve) => { requestAnimationFrame(resolve); });
      view.playback.seek(t);
      view.canvas.getContext('2d').getImageData(0, 0, 1, 1);  // waits for what was drawn
    }
    return view.frameTimes ?? [];
  }, list);
  const frames = [...instants, ...instants].slice(0, 120);
  await draw(frames);
  const before = await spent();
  await draw(frames);
  const each = ((await spent()) - before) * 1000 / frames.length;
  console.log(`# frame with 16 moving balls: ${each.toFixed(2)} ms`);
  assert.ok(each < 25, `${each} ms`);  // 5 to 8 ms where it was measured; no timed test
}));

test('a phone in portrait sees all of the table and nothing is cut off', enough, () =>
  withPage({ width: 390, height: 780, density: 3, touch: true }, async (page) => {
    await page.open(at(`/games/${game}/shots/1?t=1`));
    await page.ready(`games/${game}`);
    const { wide, stands } = await page.evaluate(() => ({
      wide: document.documentElement.scrollWidth - window.innerWidth, stands: !window.poolhall.view.view.lies,
    }));
    assert.ok(wide <= 0, `${wide} px too wide`);
    assert.ok(stands);
  }));

test('reduced motion shows a shot at its end instead of playing it', enough, () =>
  withPage({ reducedMotion: true }, async (page) => {
    await page.open(at('/workbench'));
    await page.ready('workbench/');
    await page.evaluate(() => window.poolhall.view.strike());
    const { t, end, playing } = await page.evaluate(() => window.poolhall.view.playback);
    assert.ok(!playing && t === end);
  }));
