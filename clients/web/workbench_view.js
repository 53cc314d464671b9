// The workbench: lay balls, aim, strike; the server simulates. What is on the table is a scene as
// `poolhall simulate` takes it.

import { getJson, postForText } from './api.js';
import { button, fill, h } from './dom.js';
import { Motion } from './motion.js';
import { Playback } from './playback.js';
import { sceneOf } from './scene.js';
import { TableView } from './table_view.js';
import { TransportBar } from './transport_bar.js';
import { pocketWords } from './words.js';

const ballCount = 16;
const strokeFields = /** @type {const} */ ([
  ['a', 'english, mm (left +)', -28, 28, 0.1], ['b', 'follow or draw, mm (up +)', -28, 28, 0.1],
  ['theta', 'elevation, deg', 0, 90, 0.1], ['phi', 'heading, deg', 0, 360, 0.01], ['v', 'speed, m/s', 0.1, 10, 0.01],
]);
const cushions = {
  '': "the preset's cushion",
  damped: { model: 'damped', normal: 0.6, tangential: 0.9, spin: 0.1 },
  han2005: { model: 'han2005', restitution: 0.85, friction: 0.2 },
  mathavan2010: { model: 'mathavan2010', restitution: 0.85, friction: 0.2 },
  spring: { model: 'spring', damping_ratio: 0.0535, friction: 0.2 },
};

/**
 * @param {string} label
 * @param {string[]} names
 * @param {(value: string) => void} onchange
 */
function select(label, names, onchange) {
  const element = /** @type {HTMLSelectElement} */ (h('select', { 'aria-label': label },
    names.map((name) => h('option', { value: name }, name || '–'))));
  element.onchange = () => onchange(element.value);
  return element;
}

/**
 * The physics of a scene: a preset, with another cushion if one is chosen.
 * @param {string} preset
 * @param {string} cushion
 */
const physicsOf = (preset, cushion) => (cushion
  ? { preset, cushion: cushions[/** @type {keyof typeof cushions} */ (cushion)] } : preset);

export class WorkbenchView {
  /**
   * @param {HTMLElement} root
   * @param {URLSearchParams} parameters
   */
  constructor(root, parameters) {
    this.root = root;
    this.parameters = parameters;
    this.abort = new AbortController();
    /** @type {any} */
    this.scene = {
      table: 'olympiad',
      physics: 'olympiad',
      balls: [{ id: 0, x: 0.4, y: 0.559 }, { id: 1, x: 0.62, y: 1.3 }, { id: 9, x: 0.35, y: 1.62 },
        { id: 8, x: 0.8, y: 1.75 }],
      shot: { a: 0, b: 0, theta: 5, phi: 74, v: 3 },
    };
    this.cushion = '';
    this.compared = '';
    this.noise = 'none';
    /** @type {string | null} what the server answered, as it came */
    this.resultText = null;
    /** @type {Motion | null} */
    this.motion = null;
    /** @type {Motion | null} */
    this.other = null;
    /** @type {{id: number, points: {x: number, y: number}[]}[] | null} */
    this.cloud = null;
    this.playback = new Playback(() => this.frame());
    /** @type {number | null} */
    this.dragged = null;
    this.aiming = false;
    /** @type {number | null} the ball that the arrow keys move */
    this.selected = null;
  }

  async open() {
    this.presets = await getJson('/api/presets', this.abort.signal);
    await this.loadPosition();
    this.build();
    this.lay();
  }

  close() {
    this.abort.abort();
    this.playback.stop();
    this.view?.unwatch();
  }

  /** A position of a game: #/workbench?game=17&turn=3 */
  async loadPosition() {
    const id = this.parameters.get('game');
    if (!id) {
      return;
    }
    const game = await getJson(`/api/games/${encodeURIComponent(id)}`, this.abort.signal);
    const turn = this.parameters.get('turn') ?? game.turns.at(-1)?.turn;
    const shot = await getJson(`/api/games/${encodeURIComponent(id)}/shots/${encodeURIComponent(turn)}`, this.abort.signal);
    this.scene = sceneOf(game, shot, shot.executed ?? this.scene.shot);
  }

  /** The numbers of the table and the balls on it. */
  get numbers() {
    const table = this.presets.tables.find((/** @type {any} */ t) => t.name === this.scene.table);
    const preset = this.scene.physics.preset ?? this.scene.physics;
    const physics = this.presets.physics.find((/** @type {any} */ p) => p.name === preset);
    return { table, physics };
  }

  build() {
    this.canvas = /** @type {HTMLCanvasElement} */ (h('canvas', {
      class: 'table editable', tabindex: 0, 'aria-label': 'The table: drag balls, drag elsewhere to aim',
    }));
    this.bar = new TransportBar(this.playback);
    this.status = h('p', { class: 'notice', role: 'status' });
    this.outcomes = h('div', { class: 'outcomes' });
    this.json = /** @type {HTMLTextAreaElement} */ (h('textarea', {
      rows: 8, spellcheck: 'false', 'aria-label': 'The scene as JSON',
    }));
    this.tray = h('div', { class: 'tray', role: 'group', 'aria-label': 'Balls on the table' });
    fill(this.root, h('h1', {}, 'Workbench'),
      h('div', { class: 'game' },
        h('div', { class: 'stage' }, this.canvas, this.bar.element, this.status, this.outcomes),
        h('aside', { class: 'bench' }, this.tray, this.strokePanel(), this.modelPanel(), this.jsonPanel())));
    this.placeTable();
    this.listenToPointer();
  }

  placeTable() {
    const { table, physics } = this.numbers;
    const canvas = /** @type {HTMLCanvasElement} */ (this.canvas);
    canvas.style.setProperty('--shape', String(table.length / table.width));
    this.view?.unwatch();
    this.view = new TableView(canvas, table, physics.ball_radius);
    this.view.watch(() => this.frame());
  }

  strokePanel() {
    /** @type {Record<string, HTMLInputElement>} */
    this.fields = {};
    const rows = strokeFields.map(([key, label, min, max, step]) => {
      const range = /** @type {HTMLInputElement} */ (h('input', { type: 'range', min, max, step, 'aria-label': label }));
      const field = /** @type {HTMLInputElement} */ (h('input', { type: 'number', min, max, step: 'any', 'aria-label': label }));
      const set = (/** @type {string} */ text) => {
        const value = Number(text);
        if (text !== '' && Number.isFinite(value)) {
          this.scene.shot[key] = value;
          range.value = text;
          this.lay();
        }
      };
      range.oninput = () => {
        field.value = range.value;
        set(range.value);
      };
      field.oninput = () => set(field.value);
      /** @type {Record<string, HTMLInputElement>} */ (this.fields)[key] = field;
      return h('label', { class: 'slider' }, h('span', {}, h('b', {}, key), ' ', label), range, field);
    });
    const strike = button('Strike (s)', 'Strike', () => this.strike());
    strike.classList.add('primary', 'wide');
    return h('fieldset', {}, h('legend', {}, 'Stroke'), rows, strike);
  }

  modelPanel() {
    const names = (/** @type {any[]} */ list) => list.map((p) => p.name);
    const kinds = Object.keys(cushions);
    const tables = select('Table', names(this.presets.tables), (value) => {
      this.scene.table = value;
      this.placeTable();
      this.lay();
    });
    const physics = select('Physics', names(this.presets.physics), (value) => {
      this.scene.physics = physicsOf(value, this.cushion);
      this.placeTable();
      this.lay();
    });
    const cushion = select('Cushion', kinds, (value) => {
      this.cushion = value;
      this.scene.physics = physicsOf(this.scene.physics.preset ?? this.scene.physics, value);
      this.lay();
    });
    this.chooseModels = () => {
      tables.value = this.scene.table;
      physics.value = this.scene.physics.preset ?? this.scene.physics;
      cushion.value = this.cushion;
    };
    this.chooseModels();
    const presets = names(this.presets.physics);
    const compare = select('Compare with', ['', ...presets, ...kinds.slice(1)], (value) => {
      this.compared = value;
      this.strike();
    });
    this.noiseSelect = select('Noise', ['none', ...names(this.presets.noise).filter((n) => n !== 'none')], (value) => {
      this.noise = value;
      this.strike();
    });
    const row = (/** @type {string} */ text, /** @type {Node} */ control) => h('label', { class: 'row' }, h('span', {}, text), control);
    return h('fieldset', {}, h('legend', {}, 'Models'), row('Table', tables), row('Physics', physics),
      row('Cushion', cushion), row('Compare with', compare), row('Cloud of outcomes, noise', this.noiseSelect));
  }

  jsonPanel() {
    const copy = button('Copy the scene', 'Copy', async () => {
      await navigator.clipboard.writeText(this.sceneText).catch(() => this.json?.select());
      this.say('Copied: save it and run poolhall simulate on it.');
    });
    const take = button('Take the scene from the field', 'Use this', () => this.takeJson());
    return h('fieldset', {}, h('legend', {}, 'Scene'), this.json, h('div', { class: 'buttons' }, copy, take));
  }

  takeJson() {
    const former = this.scene;
    try {
      const scene = JSON.parse(this.json?.value ?? '');
      if (!Array.isArray(scene.balls) || typeof scene.table !== 'string') {
        throw new Error('expected balls, and the name of a table');
      }
      const { table, physics = 'olympiad', balls, shot = { a: 0, b: 0, theta: 5, phi: 90, v: 2 }, ...rest } = scene;
      this.scene = { table, physics, balls, shot, ...rest };
      if (!this.numbers.table || !this.numbers.physics) {
        throw new Error('expected the names of presets for table and physics');
      }
      this.chooseModels?.();
      this.placeTable();
      this.lay();
    } catch (error) {
      this.scene = former;
      this.say(`The scene cannot be used: ${error instanceof Error ? error.message : error}.`);
    }
  }

  get sceneText() {
    return JSON.stringify(this.scene);
  }

  /** Shows the scene as it is set up, before any shot. */
  lay() {
    this.cloud = null;
    this.other = null;
    this.resultText = null;
    this.motion = new Motion({ balls: this.scene.balls, events: [], physics: this.numbers.physics });
    for (const [key] of strokeFields) {
      const field = this.fields?.[key];
      if (field && document.activeElement !== field) {
        field.value = String(this.scene.shot[key]);
        const range = field.previousElementSibling;
        if (range instanceof HTMLInputElement) {
          range.value = field.value;
        }
      }
    }
    if (this.json && document.activeElement !== this.json) {
      this.json.value = this.sceneText;
    }
    if (this.outcomes) {
      fill(this.outcomes);
    }
    this.paintTray();
    this.playback.load(0, [], 0);
    this.bar?.show([]);
  }

  paintTray() {
    const on = new Set(this.scene.balls.map((/** @type {any} */ b) => b.id));
    fill(this.tray ?? this.root, [...Array(ballCount).keys()].map((id) => {
      const label = id === 0 ? 'Cue' : String(id);
      const item = button(on.has(id) ? `Take away ${label}` : `Put down ${label}`, label, () => this.toggleBall(id));
      item.setAttribute('aria-pressed', String(on.has(id)));
      return item;
    }));
  }

  /** @param {number} id */
  toggleBall(id) {
    const at = this.scene.balls.findIndex((/** @type {any} */ b) => b.id === id);
    if (at >= 0) {
      this.scene.balls.splice(at, 1);
    } else {
      const { table } = this.numbers;
      const place = this.freePlace(table);
      this.scene.balls.push({ id, ...place });
    }
    this.lay();
  }

  /** @param {any} table */
  freePlace(table) {
    const reach = 2.2 * this.numbers.physics.ball_radius;
    for (let y = reach; y < table.length - reach; y += reach) {
      for (let x = table.width / 2; x < table.width - reach; x += reach) {
        if (this.scene.balls.every((/** @type {any} */ b) => Math.hypot(b.x - x, b.y - y) > reach)) {
          return { x: Number(x.toFixed(4)), y: Number(y.toFixed(4)) };
        }
      }
    }
    return { x: table.width / 2, y: table.length / 2 };
  }

  listenToPointer() {
    const canvas = /** @type {HTMLCanvasElement} */ (this.canvas);
    canvas.onpointerdown = (event) => {
      const point = this.view?.tablePoint(event.clientX, event.clientY);
      if (!point) {
        return;
      }
      canvas.setPointerCapture(event.pointerId);
      const grab = 1.6 * this.numbers.physics.ball_radius;
      const near = this.scene.balls.find((/** @type {any} */ b) => Math.hypot(b.x - point.x, b.y - point.y) < grab);
      this.dragged = near ? near.id : null;
      this.aiming = !near;
      this.point(point);
    };
    canvas.onpointermove = (event) => {
      const point = this.view?.tablePoint(event.clientX, event.clientY);
      if (point && (this.aiming || this.dragged !== null)) {
        this.point(point);
      }
    };
    canvas.onpointerup = canvas.onpointercancel = () => {
      this.aiming = false;
      this.dragged = null;
    };
  }

  /**
   * A ball to this place, or the cue towards it.
   * @param {{x: number, y: number}} point
   */
  point({ x, y }) {
    const cue = this.scene.balls.find((/** @type {any} */ b) => b.id === 0);
    if (this.aiming && cue) {
      const phi = (Math.atan2(y - cue.y, x - cue.x) * 180) / Math.PI;
      this.scene.shot.phi = Number(((phi + 360) % 360).toFixed(2));
    } else if (this.dragged !== null) {
      this.place(this.scene.balls.find((/** @type {any} */ b) => b.id === this.dragged), x, y);
    }
    this.lay();
  }

  /**
   * As near to there as the cushions allow.
   * @param {any} ball
   * @param {number} x
   * @param {number} y
   */
  place(ball, x, y) {
    const { table, physics } = this.numbers;
    const R = physics.ball_radius;
    ball.x = Number(Math.min(table.width - R, Math.max(R, x)).toFixed(4));
    ball.y = Number(Math.min(table.length - R, Math.max(R, y)).toFixed(4));
  }

  /** The next ball is the one that arrow keys move. */
  selectNext() {
    const ids = this.scene.balls.map((/** @type {any} */ b) => b.id).sort((/** @type {number} */ a, /** @type {number} */ b) => a - b);
    this.selected = ids.find((/** @type {number} */ id) => id > (this.selected ?? -1)) ?? null;
    this.say(this.selected === null ? 'No ball is selected.'
      : `${this.selected === 0 ? 'The cue ball' : `Ball ${this.selected}`}: arrow keys move it, with shift by less.`);
    this.frame();
  }

  /**
   * @param {KeyboardEvent} event
   * @returns {boolean} whether a ball was moved
   */
  nudge(event) {
    const ball = this.scene.balls.find((/** @type {any} */ b) => b.id === this.selected);
    const by = event.shiftKey ? 0.0005 : 0.01;
    const [right, up] = { ArrowRight: [by, 0], ArrowLeft: [-by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] }[event.key] ?? [0, 0];
    if (!ball || (right === 0 && up === 0)) {
      return false;
    }
    const lies = this.view?.lies;
    this.place(ball, ball.x + (lies ? -up : right), ball.y + (lies ? right : up));
    this.lay();
    return true;
  }

  /** @param {string} text */
  say(text) {
    if (this.status) {
      this.status.textContent = text;
    }
  }

  async strike() {
    const scene = structuredClone(this.scene);
    try {
      this.resultText = await postForText('/api/simulate', scene);
      const result = JSON.parse(this.resultText);
      const motion = new Motion({
        balls: scene.balls, events: result.events, physics: this.numbers.physics, until: result.duration,
      });
      this.other = await this.otherModel(scene);
      await this.sampleNoise(scene);
      this.motion = motion;
      this.say(`${result.stats.events} events in ${result.duration.toFixed(3)} s on the table.`);
      this.playback.load(motion.duration, result.events, -1);
      this.bar?.show(result.events);
      if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
        this.playback.seek(this.playback.end);
      } else {
        this.playback.play();
      }
    } catch (error) {
      this.say(`The shot cannot be played: ${error instanceof Error ? error.message : error}.`);
    }
  }

  /**
   * @param {any} scene
   * @returns {Promise<Motion | null>}
   */
  async otherModel(scene) {
    if (!this.compared) {
      return null;
    }
    const preset = scene.physics.preset ?? scene.physics;
    const physics = this.compared in cushions ? physicsOf(preset, this.compared) : this.compared;
    const numbers = this.presets.physics.find((/** @type {any} */ p) =>
      p.name === (this.compared in cushions ? preset : this.compared));
    const result = JSON.parse(await postForText('/api/simulate', { ...scene, physics }));
    return new Motion({ balls: scene.balls, events: result.events, physics: numbers, until: result.duration });
  }

  /** @param {any} scene */
  async sampleNoise(scene) {
    this.cloud = null;
    fill(this.outcomes ?? this.root);
    if (this.noise === 'none') {
      return;
    }
    const result = JSON.parse(await postForText('/api/evaluate',
      { scene, noise: this.noise, samples: 300, seed: 1 }));
    this.cloud = result.balls.map((/** @type {any} */ ball) => ({
      id: ball.ball,
      points: ball.x.map((/** @type {number} */ x, /** @type {number} */ i) => ({ x, y: ball.y[i] })),
    }));
    const lines = result.balls.flatMap((/** @type {any} */ ball) =>
      Object.entries(ball.pocketed).map(([pocket, count]) => ({ ball: ball.ball, pocket, share: count / result.samples })));
    lines.sort((/** @type {any} */ a, /** @type {any} */ b) => b.share - a.share);
    fill(this.outcomes ?? this.root, h('h2', {}, `${result.samples} shots with ${this.noise} noise`),
      lines.length > 0 ? h('ul', {}, lines.map((/** @type {any} */ line) => h('li', {},
        `${line.ball === 0 ? 'Cue ball' : line.ball} in the ${pocketWords(line.pocket)}: ${(100 * line.share).toFixed(1)} %`)))
        : h('p', {}, 'Nothing was pocketed.'));
  }

  frame() {
    if (!this.view || !this.motion) {
      return;
    }
    const { t } = this.playback;
    const cue = this.scene.balls.find((/** @type {any} */ b) => b.id === 0);
    const shot = this.scene.shot;
    const struck = this.resultText !== null;
    const phi = (shot.phi * Math.PI) / 180;
    this.view.draw({
      motion: this.motion,
      t,
      paths: true,
      ghost: this.other,
      cloud: this.cloud ?? undefined,
      highlight: this.selected === null ? null : { ball: this.selected },
      cue: cue ? { ...shot, x: cue.x, y: cue.y } : null,
      aim: cue && !struck ? [cue, { x: cue.x + 0.45 * Math.cos(phi), y: cue.y + 0.45 * Math.sin(phi) }] : null,
    });
    this.bar?.update();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.key === 's') {
      this.strike();
      return true;
    }
    if (event.key === 'b') {
      this.selectNext();
      return true;
    }
    if (this.nudge(event)) {
      return true;
    }
    return this.bar?.key(event) ?? false;
  }
}
