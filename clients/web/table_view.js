// The table on a canvas: cloth, cushions, pockets once for each size, balls, paths and cue for each
// frame. True to the table's numbers; crisp at any density of pixels.
//
//   const view = new TableView(canvas, table, physics.ball_radius);
//   view.draw({ motion, t, paths: true, cue: shot });
//   const { x, y } = view.tablePoint(event.clientX, event.clientY);

import { BallArt, lineColourOf } from './ball_art.js';
import { tableGeometry } from './geometry.js';
import { paintGround, tableMargin } from './table_ground.js';

/**
 * @typedef {import('./motion.js').Motion} Motion
 * @typedef {import('./motion.js').Quaternion} Quaternion
 * @typedef {import('./geometry.js').Point} Point
 * @typedef {import('./geometry.js').Table} Table
 * @typedef {{x: number, y: number, a: number, b: number, theta: number, phi: number, v: number}} Cue
 *   `x`, `y`: the cue ball's centre; the rest as on the wire, mm and degrees
 * @typedef {{motion: Motion, t: number, paths?: boolean, ghost?: Motion | null, cue?: Cue | null,
 *   cloud?: {id: number, points: Point[]}[], highlight?: {pocket?: string, ball?: number} | null,
 *   aim?: Point[] | null}} Frame
 */

const fallTime = 0.22;
const cueLength = 1.45;
const backswing = 0.16;
const lightScheme = matchMedia('(prefers-color-scheme: light)');
/** Copied, not blended: a frame begins with a picture of the whole table. */
const opaque = { alpha: false };

/**
 * Where a ball's own axes point.
 * @param {Quaternion} q
 */
function axesOf([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
}

export class TableView {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Table} table
   * @param {number} radius m
   */
  constructor(canvas, table, radius) {
    this.canvas = canvas;
    this.table = table;
    this.radius = radius;
    this.geometry = tableGeometry(table);
    this.ground = document.createElement('canvas');
    this.margin = tableMargin(this.geometry);
    this.scale = 1;
    this.left = 0;
    this.top = 0;
    this.lies = true;
    this.around = '';
    const found = /** @type {CanvasRenderingContext2D | null} */ (canvas.getContext('2d', opaque));
    if (!found) {
      throw new Error('this browser draws no canvas');
    }
    this.ctx = found;
    this.resize();
  }

  /**
   * Calls whenever the picture has to be drawn anew: in another size, in other colours.
   * @param {() => void} onChange
   */
  watch(onChange) {
    this.changed = () => this.resize() && onChange();
    this.observer = new ResizeObserver(this.changed);
    this.observer.observe(this.canvas);
    lightScheme.addEventListener('change', this.changed);
  }

  unwatch() {
    this.observer?.disconnect();
    if (this.changed) {
      lightScheme.removeEventListener('change', this.changed);
    }
  }

  /** Takes the room and the ground that the page gives; true if they have changed. */
  resize() {
    const box = this.canvas.getBoundingClientRect();
    const density = Math.min(3, window.devicePixelRatio || 1);
    const width = Math.max(1, Math.round(box.width * density));
    const height = Math.max(1, Math.round(box.height * density));
    const around = getComputedStyle(document.documentElement).backgroundColor;
    if (this.canvas.width === width && this.canvas.height === height && this.around === around) {
      return false;
    }
    this.around = around;
    this.canvas.width = width;
    this.canvas.height = height;
    this.place(width, height);
    this.art = new BallArt(this.radius * this.scale);
    this.paintGround();
    return true;
  }

  /**
   * The head is at the left where the table lies, at the bottom where it stands.
   * @param {number} width
   * @param {number} height
   */
  place(width, height) {
    const across = this.table.width + 2 * this.margin;
    const along = this.table.length + 2 * this.margin;
    this.lies = width >= height;
    this.scale = this.lies ? Math.min(width / along, height / across)
      : Math.min(width / across, height / along);
    const s = this.scale;
    this.left = (width - s * (this.lies ? this.table.length : this.table.width)) / 2;
    this.top = (height - s * (this.lies ? this.table.width : this.table.length)) / 2;
  }

  /**
   * @param {number} x
   * @param {number} y
   * @returns {[number, number]} in device pixels
   */
  pixel(x, y) {
    const s = this.scale;
    return this.lies ? [this.left + s * y, this.top + s * x]
      : [this.left + s * x, this.top + s * (this.table.length - y)];
  }

  /**
   * A direction of the table's frame in the screen's.
   * @param {number[]} v
   * @returns {import('./ball_art.js').Vector}
   */
  turned([x, y, z]) {
    return this.lies ? [y, x, z] : [x, -y, z];
  }

  /**
   * @param {number} clientX
   * @param {number} clientY
   * @returns {Point}
   */
  tablePoint(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    const px = ((clientX - box.left) * this.canvas.width) / box.width - this.left;
    const py = ((clientY - box.top) * this.canvas.height) / box.height - this.top;
    return this.lies ? { x: py / this.scale, y: px / this.scale }
      : { x: px / this.scale, y: this.table.length - py / this.scale };
  }

  /**
   * Table coordinates, in metres, for what follows.
   * @param {CanvasRenderingContext2D} ctx
   */
  enterTable(ctx) {
    const s = this.scale;
    if (this.lies) {
      ctx.setTransform(0, s, s, 0, this.left, this.top);
    } else {
      ctx.setTransform(s, 0, 0, -s, this.left, this.top + s * this.table.length);
    }
  }

  paintGround() {
    this.ground.width = this.canvas.width;
    this.ground.height = this.canvas.height;
    const ctx = /** @type {CanvasRenderingContext2D | null} */ (this.ground.getContext('2d', opaque));
    if (ctx) {
      paintGround(ctx, {
        table: this.table, geometry: this.geometry, scale: this.scale, around: this.around, enter: (to) => this.enterTable(to),
      });
    }
  }

  /** @param {Frame} frame */
  draw(frame) {
    const { ctx } = this;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.drawImage(this.ground, 0, 0);
    this.enterTable(ctx);
    if (frame.highlight?.pocket) {
      this.drawCalledPocket(frame.highlight.pocket);
    }
    if (frame.cloud) {
      this.drawCloud(frame.cloud);
    }
    if (frame.aim) {
      this.drawAim(frame.aim);
    }
    if (frame.paths) {
      this.drawPaths(frame.motion, frame.t, 'solid');
    }
    if (frame.ghost) {
      this.drawPaths(frame.ghost, frame.t, 'ghost');
      this.drawGhost(frame.ghost, frame.t);
    }
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    this.drawBalls(frame);
    if (frame.cue) {
      this.enterTable(ctx);
      this.drawCue(frame.cue, frame.t);
    }
  }

  /** @param {string} name */
  drawCalledPocket(name) {
    const hole = this.geometry.holes.find(({ pocket }) => pocket === name);
    if (!hole) {
      return;
    }
    this.ctx.strokeStyle = '#ffd34d';
    this.ctx.lineWidth = 0.006;
    this.ctx.beginPath();
    this.ctx.arc(hole.centre.x, hole.centre.y, hole.radius + 0.006, 0, 2 * Math.PI);
    this.ctx.stroke();
  }

  /** @param {{id: number, points: Point[]}[]} cloud */
  drawCloud(cloud) {
    const { ctx } = this;
    for (const { id, points } of cloud) {
      ctx.fillStyle = lineColourOf(id);
      ctx.globalAlpha = 0.62;
      for (const { x, y } of points) {
        ctx.beginPath();
        ctx.arc(x, y, 0.0058, 0, 2 * Math.PI);
        ctx.fill();
      }
      ctx.globalAlpha = 1;
    }
  }

  /** @param {Point[]} points */
  drawAim(points) {
    const { ctx } = this;
    ctx.strokeStyle = 'rgba(255,255,255,.65)';
    ctx.lineWidth = 0.003;
    ctx.setLineDash([0.014, 0.01]);
    ctx.beginPath();
    points.forEach((p) => ctx.lineTo(p.x, p.y));
    ctx.stroke();
    ctx.setLineDash([]);
    const last = points[points.length - 1];
    ctx.beginPath();
    ctx.arc(last.x, last.y, this.radius, 0, 2 * Math.PI);
    ctx.stroke();
  }

  /**
   * @param {Motion} motion
   * @param {number} t
   * @param {'solid' | 'ghost'} style
   */
  drawPaths(motion, t, style) {
    const { ctx } = this;
    ctx.lineJoin = 'round';
    ctx.lineWidth = style === 'ghost' ? 0.0028 : 0.0045;
    ctx.globalAlpha = style === 'ghost' ? 0.75 : 0.85;
    ctx.setLineDash(style === 'ghost' ? [0.018, 0.012] : []);
    for (const id of motion.tracks.keys()) {
      const path = motion.pathUntil(id, t);
      if (path.length === 0) {
        continue;
      }
      ctx.strokeStyle = style === 'ghost' ? '#e6f4ec' : lineColourOf(id);
      ctx.beginPath();
      ctx.moveTo(path[0].x, path[0].y);
      path.forEach((p) => ctx.quadraticCurveTo(p.cx, p.cy, p.ex, p.ey));
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
    ctx.setLineDash([]);
  }

  /**
   * Rings where the balls would be had the shot been played as intended.
   * @param {Motion} ghost
   * @param {number} t
   */
  drawGhost(ghost, t) {
    const { ctx } = this;
    ctx.lineWidth = 0.0035;
    ctx.setLineDash([0.008, 0.006]);
    for (const ball of ghost.ballsAt(Math.max(0, t))) {
      if (ball.state !== 'pocketed' && ghost.isTouched(ball.id)) {
        ctx.strokeStyle = '#ffffff';
        ctx.beginPath();
        ctx.arc(ball.x, ball.y, this.radius, 0, 2 * Math.PI);
        ctx.stroke();
      }
    }
    ctx.setLineDash([]);
  }

  /** @param {Frame} frame */
  drawBalls({ motion, t, highlight }) {
    const { ctx, art } = this;
    const balls = motion.ballsAt(Math.max(0, t));
    const onTable = balls.filter((ball) => ball.state !== 'pocketed' && Number.isFinite(ball.x));
    for (const ball of onTable) {
      art?.drawShadow(ctx, ...this.pixel(ball.x, ball.y));
    }
    for (const ball of onTable) {
      const [x, y] = this.pixel(ball.x, ball.y);
      art?.draw(ctx, ball.id, x, y, this.axesOf(motion, ball.id, t));
      if (highlight?.ball === ball.id) {
        ctx.strokeStyle = '#ffd34d';
        ctx.lineWidth = 0.005 * this.scale;
        ctx.beginPath();
        ctx.arc(x, y, this.radius * this.scale * 1.25, 0, 2 * Math.PI);
        ctx.stroke();
      }
    }
    for (const ball of balls) {
      this.drawFall(motion, ball, t);
    }
  }

  /**
   * @param {Motion} motion
   * @param {number} id
   * @param {number} t
   * @returns {[import('./ball_art.js').Vector, import('./ball_art.js').Vector,
   *   import('./ball_art.js').Vector]}
   */
  axesOf(motion, id, t) {
    const [a, b, c] = axesOf(motion.orientationAt(id, Math.max(0, t)));
    // The ball's own "up" lies along the screen's, so that numbers at rest can be read.
    if (this.lies) {
      const [x, y, z] = this.turned(a);
      return [this.turned(b), [-x, -y, -z], this.turned(c)];
    }
    return [this.turned(a), this.turned(b), this.turned(c)];
  }

  /**
   * @param {Motion} motion
   * @param {import('./motion.js').BallState} ball
   * @param {number} t
   */
  drawFall(motion, ball, t) {
    const fell = ball.state === 'pocketed' ? motion.fellAt(ball.id, t) : undefined;
    if (fell === undefined || t - fell > fallTime) {
      return;
    }
    const hole = this.geometry.holes.find(({ centre, radius }) =>
      Math.hypot(centre.x - ball.x, centre.y - ball.y) < radius + 0.1);
    const part = (t - fell) / fallTime;
    const x = ball.x + (hole ? (hole.centre.x - ball.x) * part * 0.7 : 0);
    const y = ball.y + (hole ? (hole.centre.y - ball.y) * part * 0.7 : 0);
    this.ctx.globalAlpha = 1 - part;
    this.art?.draw(this.ctx, ball.id, ...this.pixel(x, y), this.axesOf(motion, ball.id, t), 1 - 0.3 * part);
    this.ctx.globalAlpha = 1;
  }

  /**
   * Drawn back before the strike, then gone.
   * @param {Cue} cue
   * @param {number} t
   */
  drawCue(cue, t) {
    if (t > 0.35) {
      return;
    }
    const { ctx } = this;
    const phi = (cue.phi * Math.PI) / 180;
    const [dx, dy] = [Math.cos(phi), Math.sin(phi)];
    const side = cue.a / 1000;
    const shortened = Math.cos((cue.theta * Math.PI) / 180);
    const pull = t < 0 ? backswing * Math.sin(Math.min(1, -t / 0.7) * (Math.PI / 2)) : 0;
    const gap = this.radius * 0.9 + pull;
    const x = cue.x - dy * side - dx * gap;
    const y = cue.y + dx * side - dy * gap;
    const [ex, ey] = [x - dx * cueLength * shortened, y - dy * cueLength * shortened];
    ctx.globalAlpha = t < 0 ? 1 : 1 - t / 0.35;
    ctx.lineCap = 'round';
    this.strokeLine(x, y, ex, ey, '#2a1a10', 0.02);
    this.strokeLine(x, y, x + (ex - x) * 0.7, y + (ey - y) * 0.7, '#d8b27a', 0.0135);
    this.strokeLine(x, y, x - dx * 0.02, y - dy * 0.02, '#f4efe4', 0.0135);
    this.strokeLine(x, y, x - dx * 0.004, y - dy * 0.004, '#3d6fb0', 0.0125);
    ctx.globalAlpha = 1;
    ctx.lineCap = 'butt';
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} ex
   * @param {number} ey
   * @param {string} colour
   * @param {number} width
   */
  strokeLine(x, y, ex, ey, colour, width) {
    this.ctx.strokeStyle = colour;
    this.ctx.lineWidth = width;
    this.ctx.beginPath();
    this.ctx.moveTo(x, y);
    this.ctx.lineTo(ex, ey);
    this.ctx.stroke();
  }
}
