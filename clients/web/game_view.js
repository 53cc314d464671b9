// A game: the table, who plays, clocks, what was called, what was ruled, all shots; live while it
// goes on. #/games/17/shots/3?t=1.25 opens that instant.

import { colourOf } from './ball_art.js';
import { getJson, postForText, watch } from './api.js';
import { button, fill, h } from './dom.js';
import { Motion } from './motion.js';
import { Playback } from './playback.js';
import { TableView } from './table_view.js';
import { TransportBar } from './transport_bar.js';
import { callWords, capital, clockText, endingWords, rulingWords, turnWords } from './words.js';

const stillFrame = matchMedia('(prefers-reduced-motion: reduce)');
/** Shots that wait to be shown live; beyond, the oldest are skipped. */
const mostWaiting = 2;
const frameTimesKept = 600;

/**
 * The balls before a turn's first event.
 * @param {any} state
 */
const ballsOf = (state) => state.balls
  .filter((/** @type {any} */ b) => b.pocket === undefined && !b.off_table);

/**
 * The ball that must be struck first in nine-ball.
 * @param {any} state
 */
const lowestOf = (state) => Math.min(...ballsOf(state).map((/** @type {any} */ b) => b.id).filter((/** @type {number} */ id) => id > 0));

/**
 * The scene of a shot as `poolhall simulate` takes it.
 * @param {any} game
 * @param {any} turn
 * @param {any} shot
 */
export function sceneOf(game, turn, shot) {
  const placed = turn.cue_ball;
  const balls = ballsOf(turn.state_before)
    .map((/** @type {any} */ b) => (b.id === 0 && placed ? { id: 0, ...placed } : { id: b.id, x: b.x, y: b.y }));
  if (placed && !balls.some((/** @type {any} */ b) => b.id === 0)) {
    balls.unshift({ id: 0, ...placed });
  }
  return { table: game.table, physics: game.physics, balls, shot };
}

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
    } else {
      this.showState(this.game.initial_state);
    }
    if (!this.game.over) {
      this.listen();
    }
    this.ticker = setInterval(() => this.paintClocks(), 100);
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
    this.players = [0, 1].map(() => h('div', { class: 'player' }));
    this.ruling = h('div', { class: 'ruling' });
    this.list = h('ol', { class: 'shots' });
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
        h('aside', {}, h('div', { class: 'players' }, this.players), this.ruling,
          h('h2', {}, 'Turns'), this.list)));
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
    ];
  }

  paintList() {
    const { game } = this;
    const items = game.turns.map((/** @type {any} */ turn) => {
      const foul = (turn.ruling?.fouls ?? []).length > 0;
      return h('li', {
        class: `${foul ? 'foul' : ''} ${turn.turn === this.turn?.turn ? 'current' : ''}`,
        'data-turn': turn.turn,
      }, h('a', { href: `#/games/${this.id}/shots/${turn.turn}` },
        h('span', { class: 'n' }, turn.turn),
        h('span', { class: `seat seat${turn.by}` }, game.agents[turn.by]),
        h('span', { class: 'what' }, turnWords(turn), foul ? ' (foul)' : '')));
    });
    fill(/** @type {HTMLElement} */ (this.list), items);
    this.scrollToCurrent();
  }

  /** Within the list alone: the page stays where it is. */
  scrollToCurrent() {
    const item = this.list?.querySelector('.current');
    if (this.list && item instanceof HTMLElement) {
      const above = item.offsetTop - this.list.offsetTop;
      const hidden = above < this.list.scrollTop
        || above + item.offsetHeight > this.list.scrollTop + this.list.clientHeight;
      if (hidden) {
        this.list.scrollTop = above - this.list.clientHeight / 2;
      }
    }
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
    this.paintTurn();
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

  paintTurn() {
    const { turn, game } = this;
    const { intended: i, executed: e } = turn;
    const rows = turn.action === 'shot' ? ['a', 'b', 'theta', 'phi', 'v'].map((key) =>
      h('tr', {}, h('th', { scope: 'row' }, key), h('td', {}, i[key].toFixed(3)), h('td', {}, e[key].toFixed(3)))) : [];
    fill(/** @type {HTMLElement} */ (this.ruling),
      h('h2', {}, `Turn ${turn.turn}: ${game.agents[turn.by]}`),
      turn.action === 'shot' ? h('p', { class: 'call' }, turn.state_before.kind === 'break' ? 'Break' : `Called: ${callWords(turn.call)}`)
        : h('p', { class: 'call' }, capital(turnWords(turn))),
      h('ul', { class: 'clauses' }, rulingWords(turn.ruling).map(({ text, kind }) => h('li', { class: kind }, text))),
      this.resultLine(turn.state_after?.result),
      rows.length > 0 && h('details', {}, h('summary', {}, 'Stroke'),
        h('table', { class: 'numbers' }, h('tr', {}, h('td'), h('th', {}, 'intended'), h('th', {}, 'executed')), rows),
        turn.moved && h('p', {}, 'Noise had made it impossible: the nearest possible shot was played.')));
  }

  /** @param {any} result */
  resultLine(result) {
    if (!result) {
      return null;
    }
    const who = result.winner === null ? 'Nobody wins' : `${this.game.agents[result.winner]} wins`;
    return h('p', { class: 'result' }, `${who}: ${endingWords(result.reason)}.`);
  }

  /** The state that belongs to the instant on the screen. */
  get stateNow() {
    const ended = this.turn && this.playback.t >= this.playback.end;
    return ended ? this.turn.state_after : this.state;
  }

  paintPlayers() {
    const { game } = this;
    const state = this.stateNow;
    this.players?.forEach((element, seat) => {
      const group = state.groups?.[seat];
      const fouls = state.fouls_in_a_row?.[seat];
      element.classList.toggle('to-move', state.to_move === seat && !state.result);
      element.classList.toggle('winner', state.result?.winner === seat);
      fill(element,
        h('div', { class: 'name' }, h('span', { class: `seat seat${seat}`, title: game.agents[seat] }, game.agents[seat])),
        h('div', { class: 'line' }, h('span', { class: 'clock' }, this.clockOf(seat)),
          h('span', { class: 'score', title: 'games won in this match' }, game.match_score[seat])),
        h('div', { class: 'line' }, this.standing(state, seat, group, fouls)),
        h('div', { class: 'balls' }, this.ballsLeft(state, group)));
    });
  }

  /**
   * What a player has to do, or has done, in words.
   * @param {any} state
   * @param {number} seat
   * @param {string | undefined} group
   * @param {number | undefined} fouls
   */
  standing(state, seat, group, fouls) {
    if (state.result) {
      return state.result.winner === seat ? 'won' : state.result.winner === null ? 'drawn' : 'lost';
    }
    const aim = group ?? (this.game.rules === '8-ball' ? 'open table' : `on the ${lowestOf(state)}`);
    return fouls ? `${fouls} foul${fouls > 1 ? 's' : ''} in a row` : aim;
  }

  /**
   * @param {any} state
   * @param {string | undefined} group
   */
  ballsLeft(state, group) {
    if (!group) {
      return [];
    }
    const own = (/** @type {number} */ id) => (group === 'solids' ? id > 0 && id < 8 : id > 8);
    return state.balls.filter((/** @type {any} */ b) => own(b.id) && b.pocket === undefined && !b.off_table)
      .map((/** @type {any} */ b) => {
        const dot = h('span', { class: `dot ${b.id > 8 ? 'stripe' : ''}` }, b.id);
        dot.style.setProperty('--ball', colourOf(b.id));
        return dot;
      });
  }

  /** @param {number} seat */
  clockOf(seat) {
    if (this.clock && this.isNewest) {
      const { left_ms, running, since } = this.clock;
      const gone = running === seat ? performance.now() - since : 0;
      return clockText(left_ms[seat] - gone);
    }
    const left = this.turn?.left_ms?.[seat] ?? this.game.clock_ms;
    return clockText(left);
  }

  get isNewest() {
    return this.turn === null || this.turn.turn === this.game.turns.at(-1)?.turn;
  }

  paintClocks() {
    this.players?.forEach((element, seat) => {
      const clock = element.querySelector('.clock');
      if (clock) {
        clock.textContent = this.clockOf(seat);
      }
    });
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
    const newest = message.last?.turn ?? 0;
    if (!message.live || newest !== (this.game.turns.at(-1)?.turn ?? 0)) {
      this.game = await getJson(`/api/games/${this.id}`, this.abort.signal).catch(() => this.game);
      this.paintList();
      this.paintPlayers();
      this.root.dataset.over = String(this.game.over);
    }
    if (this.following && message.last) {
      this.waiting = [];
      // In the middle of a shot: from where it is by now.
      const age = (message.time_ms - message.last.stored_ms) / 1000;
      this.present(message.last, age, true);
    } else if (this.following && message.state) {
      this.showState(message.state);
    }
  }

  /** @param {any} turn */
  receiveTurn(turn) {
    if (!this.game.turns.some((/** @type {any} */ t) => t.turn === turn.turn)) {
      const { state_before, state_after, events, ...head } = turn;
      this.game.turns.push(head);
    }
    if (turn.state_after.result) {
      this.game.over = true;
      this.root.dataset.over = 'true';
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

  /** The address of what is on the screen. */
  remember() {
    if (!this.turn || this.following) {
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
