// Headless Chromium by its DevTools protocol over a pipe: no library, no port.
//
//   const browser = await Chromium.start();
//   const page = await browser.newPage({ width: 1280, height: 800 });
//   await page.open(url);
//   await page.evaluate(() => document.title);      // a function, run in the page
//   page.problems;                                  // console errors and uncaught exceptions
//   await browser.close();
import { spawn } from 'node:child_process';
import { until, temporaryDirectory } from './program.mjs';

const binary = process.env.CHROMIUM ?? '/usr/bin/chromium';
const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-extensions',
  '--disable-default-apps', '--mute-audio', '--remote-debugging-pipe'];

export class Chromium {
  static async start() {
    const browser = new Chromium();
    browser.profile = temporaryDirectory();
    browser.process = spawn(binary, [...flags, `--user-data-dir=${browser.profile.path}`, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    browser.gone = new Promise((resolve) => browser.process.on('exit', resolve));
    [, , , browser.to, browser.from] = browser.process.stdio;
    browser.to.on('error', () => {});
    browser.listen();
    await browser.send('Browser.getVersion');
    return browser;
  }

  constructor() {
    this.next = 1;
    this.pending = new Map();
    this.sessions = new Map();
  }

  listen() {
    let rest = '';
    this.from.setEncoding('utf8');
    this.from.on('data', (text) => {
      const parts = (rest + text).split('\0');
      rest = parts.pop();
      parts.forEach((part) => this.receive(JSON.parse(part)));
    });
  }

  receive(message) {
    if (message.id !== undefined) {
      const { resolve, reject, method } = this.pending.get(message.id);
      this.pending.delete(message.id);
      if (message.error) {
        reject(new Error(`${method}: ${message.error.message}`));
      } else {
        resolve(message.result);
      }
    } else {
      this.sessions.get(message.sessionId)?.receive(message);
    }
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject, method });
      this.to.write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }

  async newPage({ width = 1280, height = 860, density = 1, touch = false, reducedMotion = false, scheme = 'dark' } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    this.sessions.set(sessionId, page);
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) {
      await page.send(`${domain}.enable`);
    }
    await page.send('Emulation.setDeviceMetricsOverride',
      { width, height, deviceScaleFactor: density, mobile: touch });
    await page.prefer({ reducedMotion, scheme });
    return page;
  }

  async close() {
    this.send('Browser.close').catch(() => {});
    const late = setTimeout(() => this.process.kill('SIGKILL'), 3000);
    await this.gone;
    clearTimeout(late);
    this.profile.remove();
  }
}

class Page {
  constructor(browser, session, target) {
    this.browser = browser;
    this.session = session;
    this.target = target;
    this.problems = [];
    this.bytes = 0;
    this.urls = [];
  }

  send(method, params) {
    return this.browser.send(method, params, this.session);
  }

  receive({ method, params }) {
    if (method === 'Runtime.exceptionThrown') {
      const { text, exception } = params.exceptionDetails;
      this.problems.push(`${text} ${exception?.description ?? ''}`);
    } else if (method === 'Runtime.consoleAPICalled' && params.type === 'error') {
      this.problems.push(params.args.map((a) => a.value ?? a.description).join(' '));
    } else if (method === 'Log.entryAdded' && params.entry.level === 'error') {
      this.problems.push(`${params.entry.text} ${params.entry.url ?? ''}`);
    } else if (method === 'Network.loadingFinished') {
      this.bytes += params.encodedDataLength;
    } else if (method === 'Network.responseReceived') {
      this.urls.push(params.response.url);
    }
  }

  async open(url) {
    await this.send('Page.navigate', { url });
    await this.until(() => document.readyState === 'complete', 'the page is loaded');
  }

  /** What its user asks of pages. */
  prefer({ reducedMotion = false, scheme = 'dark' }) {
    return this.send('Emulation.setEmulatedMedia', {
      features: [{ name: 'prefers-reduced-motion', value: reducedMotion ? 'reduce' : 'no-preference' },
        { name: 'prefers-color-scheme', value: scheme }],
    });
  }

  /** Runs a function in the page with values as its arguments. */
  async evaluate(work, ...values) {
    const expression = `(${work})(${values.map((v) => JSON.stringify(v)).join(',')})`;
    const { result, exceptionDetails } = await this.send('Runtime.evaluate',
      { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) {
      throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    }
    return result.value;
  }

  until(work, what, ...values) {
    return until(() => this.evaluate(work, ...values), what, 15_000);
  }

  /** Another address behind the #, when the view has opened. */
  async go(hash, key) {
    await this.evaluate((to) => { location.hash = to; }, hash);
    await this.ready(key);
  }

  ready(key) {
    return this.until((k) => document.querySelector('main')?.dataset.ready === k, `the view ${key}`, key);
  }

  async press(key, modifiers = 0) {
    const text = key.length === 1 ? key : undefined;
    await this.send('Input.dispatchKeyEvent', { type: 'keyDown', key, text, modifiers });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', key, modifiers });
  }

  async drag(from, to) {
    const mouse = (type, [x, y]) => this.send('Input.dispatchMouseEvent',
      { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1 });
    await mouse('mousePressed', from);
    await mouse('mouseMoved', [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2]);
    await mouse('mouseMoved', to);
    await mouse('mouseReleased', to);
  }

  async screenshot() {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return Buffer.from(data, 'base64');
  }

  async close() {
    await this.browser.send('Target.closeTarget', { targetId: this.target });
  }
}
