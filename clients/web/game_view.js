// A game: the table, who plays, clocks, what was called, what was ruled, all shots; live while it
// goes on. #/games/17/shots/3?t=1.25 opens that instant.

import { getJson, postForText, watch } from './api.js';
import { button, fill, h } from './dom.js';
import { PlayersPanel, turnPanel } from './game_panels.js';
import { Motion } from './motion.js';
import { Playback } from './playback.js';
import { ballsOf, sceneOf } from './scene.js';
import { ShotList } from './shot_list.js';
import { TableView } from './table_view.js';
import { TransportBar } from './transport_bar.js';
import { resultWords } from './words.js';

const stillFrame = matchMedia('(prefers-reduced-motion: reduce)');
/** Shots that wait to be shown live; beyond, the oldest are skipped. */
const mostWaiting = 2;
const frameTimesKept = 600;

export class GameView {
  /**
   * @param {HTMLElement} root
   * @param {{id: number, shot?: number, t?: number}} where
   */
  constructor(root, where) {
    this.root = root;
    this.id = where.id;
    this.where = where;
    /** @type {any} */
    this.game = null;
    /** @type {any} */
    this.turn = null;
    /** @type {Motion | null} */
    this.motion = null;
    /** @type {Motion | null} */
    this.ghost = null;
    this.showGhost = true;
    this.showPaths = true;
    this.following = where.shot === undefined;
    /** @type {any[]} */
    this.waiting = [];
    /** @type {any} */
    this.clock = null;
    this.playback = new Playback(() => this.frame(), () => this.shown());
    this.abort = new AbortController();
    /** @type {number[]} ms spent on each of the last frames */
    this.frameTimes = [];
    this.frames = 0;
  }

  async open() {
    this.game = await getJson(`/api/games/${this.id}`, this.abort.signal);
    this.build();
    const { shot, t } = this.where;
    if (shot !== undefined) {
      await this.showTurn(shot, t ?? -1, false);
    } else if (this.shots.length > 0) {
      await this.showTurn(this.game.over ? this.shots[0].turn : this.shots.at(-1).turn, -1, false);
    } else if (this.game.over) {
      await this.showTurn(this.game.turns.at(-1).turn, 0, false);  // nobody came to play
    } else {
      this.showState(this.game.initial_state);
    }
    if (!this.game.over) {
      this.listen();
    }
    this.ticker = setInterval(() => this.players?.paintClocks(), 100);
  }

  /** @returns {any[]} */
  get shots() {
    return this.game.turns.filter((/** @type {any} */ t) => t.action === 'shot');
  }

  close() {
    this.abort.abort();
    this.playback.stop();
    this.live?.close();
    clearInterval(this.ticker);
    clearTimeout(this.remembering);
    this.view?.unwatch();
  }

  build() {
    const { game } = this;
    const canvas = /** @type {HTMLCanvasElement} */ (h('canvas', {
      class: 'table', tabindex: 0, role: 'img', 'aria-label': 'The table, seen from above',
    }));
    const lies = game.board.table.length / game.board.table.width;
    canvas.style.setProperty('--shape', String(lies));
    this.canvas = canvas;
    this.bar = new TransportBar(this.playback, { onShot: (by) => this.goShot(by) });
    this.notice = h('p', { class: 'notice', role: 'status' });
    this.players = new PlayersPanel((seat) => this.timeLeft(seat));
    this.ruling = h('div', { class: 'ruling' });
    this.list = new ShotList();
    const toggle = (/** @type {string} */ label, /** @type {'showGhost' | 'showPaths'} */ key) => {
      const box = /** @type {HTMLInputElement} */ (h('input', { type: 'checkbox' }));
      box.checked = this[key];
      box.onchange = () => {
        this[key] = box.checked;
        this.loadGhost();
        this.frame();
      };
      return h('label', {}, box, label);
    };
    this.liveButton = button('Follow the game', '● Live', () => this.follow());
    fill(this.root,
      h('nav', { class: 'crumbs' }, this.crumbs()),
      h('div', { class: 'game' },
        h('div', { class: 'stage' }, canvas, this.bar.element,
          h('div', { class: 'options' }, toggle('Paths', 'showPaths'), toggle('Intended shot', 'showGhost'),
            h('a', { class: 'button', id: 'to-workbench', href: '#/workbench' }, 'Open in workbench'),
            this.liveButton), this.notice),
        h('aside', {}, this.players.element, this.ruling,
          h('h2', {}, 'Turns'), this.list.element)));
    this.view = new TableView(canvas, game.board.table, game.board.physics.ball_radius);
    this.view.watch(() => this.frame());
    this.paintList();
  }

  crumbs() {
    const { game } = this;
    return [
      h('a', { href: '#/' }, 'Tournaments'),
      game.tournament ? h('a', { href: `#/tournaments/${encodeURIComponent(game.tournament)}` }, game.tournament)
        : 'Challenge',
      h('span', { 'aria-current': 'page' }, `Game ${game.game}`),
      h('span', { class: 'tag' }, game.rules),
      h('span', { class: 'tag' }, `table ${game.table}`),
      game.noise === 'hidden' && h('span', { class: 'tag' }, 'noise hidden'),
      game.over && h('span', { class: 'tag' }, resultWords(game)),
    ];
  }

  paintList() {
    this.list?.show(this.game);
    this.list?.mark(this.turn?.turn);
  }

  /**
   * The balls without a shot.
   * @param {any} state
   */
  showState(state) {
    this.state = state;
    this.motion = new Motion({ balls: ballsOf(state), events: [], physics: this.game.board.physics });
    this.playback.load(0, [], 0);
    this.bar?.show([]);
    this.paintPlayers();
  }

  /**
   * @param {number} number
   * @param {number} t
   * @param {boolean} play
   */
  async showTurn(number, t, play) {
    const turn = await getJson(`/api/games/${this.id}/shots/${number}`, this.abort.signal);
    this.present(turn, t, play);
  }

  /**
   * @param {any} turn
   * @param {number} t before the strike if negative
   * @param {boolean} play
   */
  present(turn, t, play) {
    const next = turn.turn === (this.turn?.turn ?? -1) + 1;
    const orientations = next ? this.motion?.finalOrientations() : undefined;
    this.turn = turn;
    this.state = turn.state_before;
    this.ghost = null;
    this.motion = new Motion({
      balls: ballsOf(turn.state_before), events: turn.events, physics: this.game.board.physics, orientations,
    });
    this.playback.load(this.motion.duration, turn.events, t);
    this.bar?.show(turn.events);
    fill(/** @type {HTMLElement} */ (this.ruling), ...turnPanel(this.game, turn));
    this.paintPlayers();
    this.paintList();
    this.loadGhost();
    const link = /** @type {HTMLAnchorElement | null} */ (this.root.querySelector('#to-workbench'));
    if (link) {
      link.href = `#/workbench?game=${this.id}&turn=${turn.turn}`;
    }
    if (play && !stillFrame.matches && t < this.motion.duration) {
      this.playback.play();
    } else if (play) {
      this.playback.seek(this.playback.end);
      this.shown();
    }
  }

  /** What would have happened without noise; the server works it out. */
  async loadGhost() {
    const { turn } = this;
    if (!this.showGhost || this.ghost || !turn || turn.action !== 'shot'
        || JSON.stringify(turn.intended) === JSON.stringify(turn.executed)) {
      return;
    }
    try {
      const text = await postForText('/api/simulate', sceneOf(this.game, turn, turn.intended));
      if (this.turn === turn) {
        this.ghost = new Motion({
          balls: ballsOf(turn.state_before), events: JSON.parse(text).events, physics: this.game.board.physics,
        });
        this.frame();
      }
    } catch {
      this.ghost = null;  // the shot is shown without it
    }
  }

  /** The state that belongs to the instant on the screen. */
  get stateNow() {
    const ended = this.turn && this.playback.t >= this.playback.end;
    return ended ? this.turn.state_after : this.state;
  }

  paintPlayers() {
    this.players?.paint(this.game, this.stateNow);
  }

  /**
   * On a clock, ms.
   * @param {number} seat
   */
  timeLeft(seat) {
    if (this.clock && this.isNewest) {
      const { left_ms, running, since } = this.clock;
      return left_ms[seat] - (running === seat ? performance.now() - since : 0);
    }
    return this.turn?.left_ms?.[seat] ?? this.game.clock_ms;
  }

  get isNewest() {
    return this.turn === null || this.turn.turn === this.game.turns.at(-1)?.turn;
  }

  listen() {
    this.live = watch(`/ws/games/${this.id}`, (message) => this.receive(message), (state) => {
      if (this.notice) {
        this.notice.textContent = state === 'lost' ? 'Connection lost; trying again.' : '';
      }
      this.root.dataset.live = state;
    });
  }

  /** @param {any} message */
  receive(message) {
    if (message.clock) {
      this.clock = { ...message.clock, since: performance.now() };
    }
    if (message.type === 'snapshot') {
      this.receiveSnapshot(message);
    } else if (message.type === 'turn') {
      // The next player's clock starts as soon as this is told.
      const next = message.turn.state_after;
      this.clock = { left_ms: message.turn.left_ms, running: next.result ? null : next.to_move, since: performance.now() };
      this.receiveTurn(message.turn);
    }
  }

  /**
   * A game seen for the first time, or again after a gap.
   * @param {any} message
   */
  async receiveSnapshot(message) {
    const came = performance.now();
    const newest = message.last?.turn ?? 0;
    if (!message.live || newest !== (this.game.turns.at(-1)?.turn ?? 0)) {
      this.game = await getJson(`/api/games/${this.id}`, this.abort.signal).catch(() => this.game);
      this.paintList();
      this.paintPlayers();
      this.root.dataset.over = String(this.game.over);
    }
    if (!this.following) {
      return;
    }
    const last = this.game.turns.at(-1)?.turn;
    if (message.last) {
      this.waiting = [];
      // In the middle of a shot: from where it is by now.
      const age = message.time_ms - message.last.stored_ms + performance.now() - came;
      this.present(message.last, age / 1000, true);
    } else if (message.state) {
      this.showState(message.state);
    } else if (last !== undefined && last !== this.turn?.turn) {
      await this.showTurn(last, -0.2, true);  // how it ended while nobody told
    }
  }

  /** @param {any} turn */
  receiveTurn(turn) {
    if (!this.game.turns.some((/** @type {any} */ t) => t.turn === turn.turn)) {
      const { state_before, state_after, events, ...head } = turn;
      this.game.turns.push(head);
      this.noteResult(state_after.result);
    }
    this.paintList();
    if (!this.following) {
      return;
    }
    this.waiting.push(turn);
    if (!this.playback.playing || this.waiting.length > mostWaiting) {
      this.nextWaiting();
    } else {
      this.playback.speed = 4;
    }
  }

  /** @param {any} result of a turn that was told just now */
  noteResult(result) {
    if (result) {
      this.game.over = true;
      this.root.dataset.over = 'true';
      if (result.winner !== null) {
        this.game.match_score[result.winner] += 1;
      }
    }
  }

  nextWaiting() {
    this.waiting = this.waiting.slice(-mostWaiting);
    const turn = this.waiting.shift();
    if (turn) {
      this.playback.speed = this.waiting.length > 0 ? 4 : 1;
      this.present(turn, -0.2, true);
    }
  }

  /** A shot has been shown to its end. */
  shown() {
    this.paintPlayers();
    if (this.following && this.waiting.length > 0) {
      this.nextWaiting();
    }
  }

  follow() {
    this.following = true;
    const last = this.game.turns.at(-1);
    history.replaceState(null, '', `#/games/${this.id}`);
    if (last) {
      this.showTurn(last.turn, 0, true);
    }
  }

  /** @param {1 | -1} by */
  goShot(by) {
    const numbers = this.game.turns.map((/** @type {any} */ t) => t.turn);
    const at = numbers.indexOf(this.turn?.turn);
    const next = numbers[Math.min(numbers.length - 1, Math.max(0, at + by))];
    if (next !== undefined && next !== this.turn?.turn) {
      this.goTo({ shot: next });
    }
  }

  /**
   * Another shot of this game, without building the page again.
   * @param {{shot?: number, t?: number}} where
   */
  async goTo({ shot, t }) {
    if (shot === undefined) {
      this.follow();
      return;
    }
    this.following = false;
    this.waiting = [];
    this.playback.speed = 1;
    if (this.turn?.turn !== shot) {
      await this.showTurn(shot, t ?? -1, t === undefined);
    } else if (t !== undefined) {
      this.playback.seek(t);
    }
    this.remember();
  }

  /** The address of what is on the screen; not once another one was asked for. */
  remember() {
    const [, page, id] = location.hash.split(/[/?]/);
    if (!this.turn || this.following || page !== 'games' || id !== String(this.id)) {
      return;
    }
    const { t, playing } = this.playback;
    const at = playing || t < 0 ? '' : `?t=${Number(t.toFixed(4))}`;
    history.replaceState(null, '', `#/games/${this.id}/shots/${this.turn.turn}${at}`);
  }

  frame() {
    if (!this.view || !this.motion) {
      return;
    }
    const began = performance.now();
    const { t, playing } = this.playback;
    const { turn } = this;
    const struck = turn?.action === 'shot' ? turn.events[0]?.after[0] : null;
    this.view.draw({
      motion: this.motion,
      t,
      paths: this.showPaths,
      ghost: this.showGhost ? this.ghost : null,
      cue: struck ? { ...turn.executed, x: struck.x, y: struck.y } : null,
      highlight: turn?.call?.pocket ? turn.call : null,
    });
    this.bar?.update();
    this.frameTimes[this.frames++ % frameTimesKept] = performance.now() - began;
    this.liveButton?.classList.toggle('on', this.following && !this.game.over);
    this.liveButton?.toggleAttribute('hidden', this.game.over);
    if (!playing) {
      clearTimeout(this.remembering);
      this.remembering = setTimeout(() => this.remember(), 200);
    }
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.shiftKey && (event.key === 'ArrowLeft' || event.key === 'ArrowRight')) {
      this.goShot(event.key === 'ArrowLeft' ? -1 : 1);
      return true;
    }
    return this.bar?.key(event) ?? false;
  }
}
