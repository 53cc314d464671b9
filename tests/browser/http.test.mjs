// The page's port as strangers use it: documented answers, strict formats, floods, slow and giant
// requests, bad WebSocket frames, path tricks. What they do to it must stay theirs.
import assert from 'node:assert/strict';
import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';
import { after, before, test } from 'node:test';
import { startServer, temporaryDirectory, until } from './program.mjs';
import { Spectator } from './socket.mjs';

const enough = { timeout: 50_000 };
let directory;
let server;

before(async () => {
  directory = temporaryDirectory();
  server = await startServer(directory.path);
}, enough);

after(async () => {
  await server.stop();
  directory.remove();
});

/** A socket to the page's port that keeps what it hears. */
function dial() {
  const [host, port] = server.http.split(':');
  const socket = connect(Number(port), host);
  const line = { socket, heard: '', ended: false };
  socket.setEncoding('latin1');
  socket.on('data', (text) => { line.heard += text; });
  socket.on('error', () => { line.ended = true; });
  socket.on('close', () => { line.ended = true; });
  return line;
}

/** What is answered to these bytes, when the server has ended the connection. */
async function answered(bytes) {
  const line = dial();
  line.socket.write(bytes);
  await until(() => line.ended, `the end after ${String(bytes).slice(0, 40)}`);
  return line.heard;
}

const statusOf = (text) => Number(text.split(' ')[1]);
const get = (target, more = '') => `GET ${target} HTTP/1.1\r\nHost: ${server.http}\r\nConnection: close\r\n${more}\r\n`;
const works = async () => assert.equal((await fetch(`${server.url}/healthz`)).status, 200);

test('the OpenAPI document is whole and everything in it answers as it says', enough, async () => {
  const document = await (await fetch(`${server.url}/api/openapi.json`)).json();
  assert.match(document.openapi, /^3\.1\.\d+$/);
  assert.ok(document.info.title && document.info.version);
  const ids = new Set();
  for (const [path, item] of Object.entries(document.paths)) {
    assert.match(path, /^(\/([a-z._]+|\{[a-z]+\}))+$/, path);
    const named = [...path.matchAll(/\{([a-z]+)\}/g)].map((m) => m[1]);
    for (const [method, operation] of Object.entries(item)) {
      const here = `${method} ${path}`;
      assert.ok(['get', 'post'].includes(method), here);
      assert.ok(operation.summary, here);
      assert.ok(operation.operationId && !ids.has(operation.operationId), `${here}: an id of its own`);
      ids.add(operation.operationId);
      assert.deepEqual(operation.parameters.filter((p) => p.in === 'path').map((p) => p.name), named, here);
      operation.parameters.forEach((p) => assert.ok(p.required && p.schema.type, here));
      const statuses = Object.keys(operation.responses);
      assert.ok(statuses.some((s) => /^20\d$/.test(s)) && statuses.includes('default'), here);
      for (const response of Object.values(operation.responses)) {
        assert.ok(response.description && Object.keys(response.content).every((t) => /^[a-z]+\/[a-z0-9.+*-]+$/.test(t)), here);
      }
      for (const scheme of (operation.security ?? []).flatMap((s) => Object.keys(s))) {
        assert.ok(document.components.securitySchemes[scheme], here);
      }
      assert.equal(Boolean(operation.security), path.startsWith('/api/admin/'), here);
      const target = path.replace(/\{[a-z]+\}/g, '1');
      const response = await fetch(server.url + target, { method: method.toUpperCase(), body: method === 'post' ? '{}' : undefined });
      const text = await response.text();
      const kinds = (operation.responses[String(response.status)] ?? operation.responses.default).content;
      assert.ok(response.headers.get('content-type').split(';')[0] in kinds, `${here}: ${response.headers.get('content-type')}`);
      if (response.headers.get('content-type').startsWith('application/json')) {
        const body = JSON.parse(text);
        assert.equal(Boolean(body.error), response.status >= 400, `${here}: ${text.slice(0, 80)}`);
      }
    }
  }
});

/** Prometheus' text format, strictly: families in one piece, typed before their samples, nothing twice. */
function metricsIn(text) {
  assert.ok(text.endsWith('\n'), 'ends with a line');
  const families = new Map();
  const seen = new Set();
  let current = null;
  for (const line of text.split('\n').slice(0, -1)) {
    const comment = /^# (HELP|TYPE) ([a-zA-Z_:][a-zA-Z0-9_:]*) (.+)$/.exec(line);
    if (comment) {
      const [, what, name, rest] = comment;
      if (name !== current) {
        assert.ok(!families.has(name), `${name} comes in two pieces`);
        families.set(name, { help: null, type: null, samples: [] });
        current = name;
      }
      const family = families.get(name);
      assert.equal(family[what.toLowerCase()], null, line);
      assert.equal(family.samples.length, 0, `${line} after samples`);
      assert.ok(what === 'HELP' || /^(counter|gauge|histogram|summary|untyped)$/.test(rest), line);
      family[what.toLowerCase()] = rest;
      continue;
    }
    const sample = /^([a-zA-Z_:][a-zA-Z0-9_:]*)(\{([a-zA-Z_][a-zA-Z0-9_]*="(?:[^"\\\n]|\\["\\n])*",?)*\})? (\S+)$/.exec(line);
    assert.ok(sample, `no sample: ${line}`);
    assert.equal(sample[1], current, `${line} in the family ${current}`);
    assert.ok(Number.isFinite(Number(sample[4])), line);
    const key = sample[1] + (sample[2] ?? '');
    assert.ok(!seen.has(key), `${key} twice`);
    seen.add(key);
    families.get(current).samples.push(Number(sample[4]));
  }
  for (const [name, { help, type, samples }] of families) {
    assert.ok(help && type && samples.length > 0, name);
    assert.equal(name.endsWith('_total'), type === 'counter', `${name} is a ${type}`);
    assert.ok(type !== 'counter' || samples.every((s) => s >= 0), name);
  }
  return families;
}

test('the metrics are well-formed', enough, async () => {
  const response = await fetch(`${server.url}/metrics`);
  assert.equal(response.headers.get('content-type'), 'text/plain; version=0.0.4');
  assert.ok(metricsIn(await response.text()).size > 10);
});

test('what is no HTTP, too long or nowhere is refused with a reason, and ends', enough, async () => {
  for (const [bytes, status] of [
    ['no http at all\r\n\r\n', 400],
    [`GET / HTTP/9.9\r\nHost: ${server.http}\r\n\r\n`, 400],
    [`POST /api/simulate HTTP/1.1\r\nHost: ${server.http}\r\nContent-Length: x\r\n\r\n`, 400],
    [`GET / HTTP/1.1\r\nHost: ${server.http}\r\nX: ${'x'.repeat(9000)}\r\n\r\n`, 431],
    [`GET /${'x'.repeat(9000)} HTTP/1.1\r\nHost: ${server.http}\r\n\r\n`, 431],
    [`POST /api/simulate HTTP/1.1\r\nHost: ${server.http}\r\nContent-Length: 100000000000\r\n\r\n`, 413],
    [`POST /api/simulate HTTP/1.1\r\nHost: ${server.http}\r\nTransfer-Encoding: chunked\r\n\r\n${
      `2000\r\n${'x'.repeat(0x2000)}\r\n`.repeat(9)}0\r\n\r\n`, 413],
    [get('/../../etc/passwd'), 404],
    [get('/%2e%2e/%2e%2e/etc/passwd'), 404],
    [get('/..%2f..%2fetc%2fpasswd'), 404],
    [get('//etc/passwd'), 404],
    [get('/main.js/'), 404],
    [get('/MAIN.JS'), 404],
    [get('/main.js%00.html'), 404],
    [get('/api/games/1/../../admin/agents'), 404],
    [get('/api/games/-1'), 404],
    [get('/api/games/99999999999999999999'), 404],
    [get('/api/games/1e3'), 404],
    [get('/api/games/1/shots/%31'), 404],
    [get('/api/agents/%ff%fe'), 404],
    [get('/api/tournaments/%00'), 404],
    [get(`/api/tournaments/${'%41'.repeat(2000)}`), 404],
    [get('/api/'), 404],
    [get('http://evil.example/'), 404],
    [`GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n`, 421],
    [`GET / HTTP/1.1\r\nConnection: close\r\n\r\n`, 421],
    [`DELETE /api/games/1 HTTP/1.1\r\nHost: ${server.http}\r\nConnection: close\r\n\r\n`, 405],
    [`BREW / HTTP/1.1\r\nHost: ${server.http}\r\nConnection: close\r\n\r\n`, 404],
  ]) {
    const heard = await answered(bytes);
    assert.equal(statusOf(heard), status, `${JSON.stringify(bytes.slice(0, 60))}: ${heard.slice(0, 200)}`);
    if (status !== 404 || bytes.includes('/api/')) {
      assert.ok(JSON.parse(heard.slice(heard.indexOf('\r\n\r\n') + 4)).error.reason, heard);
    }
  }
  await works();
});

test('pipelined requests are answered in their order, and a large body after asking for it', enough, async () => {
  const both = await answered(`GET /api/presets HTTP/1.1\r\nHost: ${server.http}\r\n\r\n${get('/healthz')}`);
  assert.equal(both.match(/HTTP\/1\.1 200 OK/g).length, 2);
  assert.ok(both.indexOf('"tables"') < both.lastIndexOf('HTTP/1.1'));
  const scene = JSON.stringify({ table: 'olympiad', physics: 'olympiad', balls: [{ id: 1, x: 0.5, y: 0.5 }] });
  const line = dial();
  line.socket.write(`POST /api/simulate HTTP/1.1\r\nHost: ${server.http}\r\nConnection: close\r\nExpect: 100-continue\r\nContent-Length: ${scene.length}\r\n\r\n`);
  await until(() => line.heard.startsWith('HTTP/1.1 100'), 'it is told to go on');
  line.socket.write(scene);
  await until(() => line.ended, 'the answer');
  assert.match(line.heard, /HTTP\/1\.1 200 OK/);
});

test('bad WebSocket frames end their own connection', enough, async () => {
  const good = await Spectator.watch(server.http, '/ws/lobby');
  await good.next((m) => m.type === 'lobby');
  const frames = {
    'no mask': Buffer.from([0x81, 0x02, 0x68, 0x69]),
    'an unknown opcode': Buffer.from([0x83, 0x80, 0, 0, 0, 0]),
    'reserved bits': Buffer.from([0xf1, 0x80, 0, 0, 0, 0]),
    'a giant': Buffer.from([0x82, 0xff, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1, 2, 3, 4]),
    'a long ping': Buffer.from([0x89, 0xfe, 0x01, 0x00, 1, 2, 3, 4]),
    'a continuation of nothing': Buffer.from([0x80, 0x80, 0, 0, 0, 0]),
    'no UTF-8': Buffer.from([0x81, 0x81, 0, 0, 0, 0, 0xff]),
    noise: randomBytes(3000),
  };
  for (const [what, bytes] of Object.entries(frames)) {
    const bad = await Spectator.watch(server.http, '/ws/lobby');
    let ended = false;
    bad.socket.on('close', () => { ended = true; });
    bad.socket.write(bytes);
    await until(() => ended, `the end after ${what}`);
  }
  await until(async () => /poolhall_spectators 1\n/.test(await (await fetch(`${server.url}/metrics`)).text()),
    'the good one alone watches');
  good.leave();
  await works();
});

test('a flood of connections from one address is bounded, told so, and over when it is over', enough, async () => {
  const flood = [];
  for (let i = 0; i < 2100; ++i) {
    flood.push(dial());
    if (i % 100 === 99) {
      await new Promise((resolve) => { setImmediate(resolve); });
    }
  }
  await until(() => flood.some((line) => line.heard.includes('503')), 'some are turned away');
  await until(() => flood.filter((line) => line.ended).length >= 40, 'those are ended');
  const refused = flood.find((line) => line.heard.includes('503'));
  assert.match(refused.heard, /"code":"server_full"/);
  flood.forEach((line) => line.socket.destroy());
  await until(async () => (await fetch(`${server.url}/healthz`).catch(() => null))?.status === 200, 'there is room again');
});

test('half a request holds nobody else up', enough, async () => {
  const slow = [...Array(200)].map(() => {
    const line = dial();
    line.socket.write(`GET / HTTP/1.1\r\nHost: ${server.http}\r\nX-Slow: `);
    return line;
  });
  const deaf = [...Array(50)].map(() => {
    const line = dial();
    line.socket.pause();
    line.socket.write(get('/game_view.js').replace('close', 'keep-alive').repeat(50));
    return line;
  });
  const began = Date.now();
  for (let i = 0; i < 20; ++i) {
    await works();
  }
  assert.ok(Date.now() - began < 10_000);
  [...slow, ...deaf].forEach((line) => line.socket.destroy());
});
