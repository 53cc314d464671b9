// Any instant of a shot from its event log, in closed form and without a physics engine: between
// two of its events a ball moves as r + v t + a t^2 / 2 (protocol/README.md, "State").
//
//   const motion = new Motion({ balls, events, physics });
//   motion.duration;                    // s
//   motion.ballsAt(1.25)[0].x;          // m
//   motion.orientationAt(3, 1.25);      // quaternion [w, x, y, z]
//
// Not for finding events: the log has them all.

/**
 * @typedef {{id: number, state: string, x: number, y: number, vx: number, vy: number,
 *   wx: number, wy: number, wz: number, pocket?: string}} BallState
 * @typedef {{t: number, type: string, balls: number[], rail?: string, pocket?: string,
 *   count?: number, until?: number, after: BallState[]}} ShotEvent
 * @typedef {{gravity: number, ball_radius: number, mu_slide: number, mu_roll: number,
 *   mu_spin?: number, spin_deceleration?: number}} Physics
 * @typedef {[number, number, number, number]} Quaternion w, x, y, z
 * @typedef {{radius: number, slide: number, roll: number, spin: number, lever: number}} Coefficients
 */

/** A slip below this part of |v| + R |w_xy| is rounding. */
const negligibleSlip = 1e-13;
/** Radians between two stored orientations of a rolling ball. */
const turnBetweenKeys = 0.25;
const mostKeys = 4000;

/**
 * @param {number} x
 * @param {number} y
 */
const length = (x, y) => Math.sqrt(x * x + y * y);

/**
 * @param {Physics} physics
 * @returns {Coefficients}
 */
export function coefficients(physics) {
  const radius = physics.ball_radius;
  const spin = physics.spin_deceleration
    ?? (5 * ((physics.mu_spin ?? 0) * physics.gravity)) / (2 * radius);
  return {
    radius,
    slide: physics.mu_slide * physics.gravity,
    roll: physics.mu_roll * physics.gravity,
    spin,
    lever: 5 / (2 * radius),
  };
}

/**
 * The motion state that velocities imply.
 * @param {BallState} b
 * @param {number} radius
 */
export function motionStateOf(b, radius) {
  const slip = length(b.vx - radius * b.wy, b.vy + radius * b.wx);
  if (slip > negligibleSlip * (length(b.vx, b.vy) + radius * length(b.wx, b.wy))) {
    return 'sliding';
  }
  if (b.vx !== 0 || b.vy !== 0) {
    return 'rolling';
  }
  return b.wz !== 0 ? 'spinning' : 'stationary';
}

/**
 * @param {Partial<BallState>} ball
 * @param {number} radius
 * @returns {BallState}
 */
function completed(ball, radius) {
  const full = { vx: 0, vy: 0, wx: 0, wy: 0, wz: 0, state: '', x: 0, y: 0, id: 0, ...ball };
  full.state = ball.pocket !== undefined ? 'pocketed' : ball.state || motionStateOf(full, radius);
  return full;
}

/** One ball between two of its events. */
class Segment {
  /**
   * @param {number} start
   * @param {BallState} ball
   * @param {Coefficients} c
   */
  constructor(start, ball, c) {
    this.start = start;
    this.ball = ball;
    this.c = c;
    this.ax = 0;
    this.ay = 0;
    if (ball.state === 'sliding') {
      const ux = ball.vx - c.radius * ball.wy;
      const uy = ball.vy + c.radius * ball.wx;
      this.brake(ux, uy, c.slide);
    } else if (ball.state === 'rolling') {
      this.brake(ball.vx, ball.vy, c.roll);
    }
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} size
   */
  brake(x, y, size) {
    const speed = length(x, y);
    if (speed > 0) {
      this.ax = (-size / speed) * x;
      this.ay = (-size / speed) * y;
    }
  }

  get moves() {
    return this.ball.state === 'sliding' || this.ball.state === 'rolling';
  }

  /**
   * @param {number} t of the shot
   * @returns {BallState}
   */
  at(t) {
    const { ball, c } = this;
    const dt = t - this.start;
    const half = dt / 2;
    const vx = ball.vx + dt * this.ax;
    const vy = ball.vy + dt * this.ay;
    const lost = c.spin * dt;
    const wz = Math.abs(ball.wz) > lost ? ball.wz - Math.sign(ball.wz) * lost : 0;
    let wx = ball.wx;
    let wy = ball.wy;
    if (ball.state === 'rolling') {
      wx = -vy / c.radius;
      wy = vx / c.radius;
    } else if (ball.state === 'sliding') {
      wx = ball.wx + dt * c.lever * this.ay;
      wy = ball.wy - dt * c.lever * this.ax;
    }
    const still = !this.moves;
    return {
      ...ball,
      x: still ? ball.x : ball.x + dt * (ball.vx + half * this.ax),
      y: still ? ball.y : ball.y + dt * (ball.vy + half * this.ay),
      vx: still ? 0 : vx,
      vy: still ? 0 : vy,
      wx: still ? 0 : wx,
      wy: still ? 0 : wy,
      wz: ball.state === 'stationary' || ball.state === 'pocketed' ? 0 : wz,
    };
  }
}

/** Many tiny hops that the log has merged into one entry: a cubic from its first to its last. */
class Hops {
  /**
   * @param {number} start
   * @param {BallState} from
   * @param {number} end
   * @param {BallState} to
   */
  constructor(start, from, end, to) {
    this.start = start;
    this.ball = from;
    this.end = end;
    this.to = to;
    this.moves = true;
  }

  /**
   * @param {number} t
   * @returns {BallState}
   */
  at(t) {
    const T = this.end - this.start;
    const s = T > 0 ? (t - this.start) / T : 1;
    const { ball: p, to: q } = this;
    const blend = (/** @type {number} */ a, /** @type {number} */ b) => a + s * (b - a);
    return {
      ...p,
      x: hermite(s, p.x, p.vx * T, q.x, q.vx * T),
      y: hermite(s, p.y, p.vy * T, q.y, q.vy * T),
      vx: blend(p.vx, q.vx),
      vy: blend(p.vy, q.vy),
      wx: blend(p.wx, q.wx),
      wy: blend(p.wy, q.wy),
      wz: blend(p.wz, q.wz),
    };
  }
}

/**
 * @param {number} s
 * @param {number} p
 * @param {number} dp
 * @param {number} q
 * @param {number} dq
 */
function hermite(s, p, dp, q, dq) {
  const r = 1 - s;
  return r * r * (1 + 2 * s) * p + r * r * s * dp + s * s * (3 - 2 * s) * q - s * s * r * dq;
}

/**
 * The last index whose start is not after t.
 * @param {{start: number}[]} list
 * @param {number} t
 */
function lastBefore(list, t) {
  let low = 0;
  let high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle].start <= t) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

/**
 * Turns q by the rotation vector (x, y, z) of the world.
 * @param {Quaternion} q
 * @param {number} x
 * @param {number} y
 * @param {number} z
 * @returns {Quaternion}
 */
export function turned(q, x, y, z) {
  const angle = Math.sqrt(x * x + y * y + z * z);
  if (angle < 1e-12) {
    return q;
  }
  const s = Math.sin(angle / 2) / angle;
  const w = Math.cos(angle / 2);
  const [qw, qx, qy, qz] = q;
  const [a, b, c] = [s * x, s * y, s * z];
  return [
    w * qw - a * qx - b * qy - c * qz,
    w * qx + a * qw + b * qz - c * qy,
    w * qy - a * qz + b * qw + c * qx,
    w * qz + a * qy - b * qx + c * qw,
  ];
}

/**
 * How a ball is turned before the first shot: its number looks up, a little aslant.
 * @param {number} id
 * @returns {Quaternion}
 */
export function restingOrientation(id) {
  /** @type {Quaternion} */
  const upright = [1, 0, 0, 0];
  return turned(turned(upright, 0.25 * Math.sin(id * 2.4), 0.25 * Math.cos(id * 1.7), 0),
    0, 0, 0.5 * Math.sin(id * 5.1));
}

/**
 * How long a ball slides or rolls on if nothing happens to it, s.
 * @param {BallState} ball
 * @param {Coefficients} c
 */
function timeLeft({ state, vx, vy, wx, wy }, c) {
  if (state === 'sliding') {
    return (2 * length(vx - c.radius * wy, vy + c.radius * wx)) / (7 * c.slide);
  }
  return state === 'rolling' ? length(vx, vy) / c.roll : 0;
}

/** One ball's way through a shot. */
class Track {
  /**
   * @param {BallState} ball
   * @param {Coefficients} c
   * @param {Quaternion} orientation
   */
  constructor(ball, c, orientation) {
    this.c = c;
    /** @type {(Segment | Hops)[]} */
    this.segments = [new Segment(-Infinity, ball, c)];
    if (ball.state !== 'stationary' && ball.state !== 'pocketed') {
      this.segments = [new Segment(0, ball, c)];
    }
    this.id = ball.id;
    /** @type {Quaternion[]} */
    this.starts = [orientation];
    /** @type {Map<number, Quaternion[]>} */
    this.keys = new Map();
  }

  /**
   * @param {ShotEvent} event
   * @param {BallState} after
   */
  take(event, after) {
    const until = event.until ?? event.t;
    if (until > event.t) {
      this.segments.push(new Hops(event.t, this.at(event.t), until, after));
    }
    this.segments.push(new Segment(until, after, this.c));
  }

  /** @param {number} t */
  at(t) {
    return this.segments[lastBefore(this.segments, t)].at(t);
  }

  /**
   * @param {number} index
   * @param {number} t
   */
  end(index, t) {
    return index + 1 < this.segments.length ? Math.min(this.segments[index + 1].start, t) : t;
  }

  /**
   * The orientation where a segment begins.
   * @param {number} index
   * @returns {Quaternion}
   */
  startOf(index) {
    for (let i = this.starts.length; i <= index; ++i) {
      this.starts.push(this.turnedIn(i - 1, this.segments[i].start));
    }
    return this.starts[index];
  }

  /**
   * Stored orientations of a segment at equal distances.
   * @param {number} index
   */
  keysOf(index) {
    const known = this.keys.get(index);
    if (known) {
      return known;
    }
    const segment = this.segments[index];
    const span = this.spanOf(index);
    const { wx, wy, wz } = segment.ball;
    const fastest = Math.sqrt(wx * wx + wy * wy + wz * wz) + this.c.lever * this.c.slide * span;
    const count = Math.min(mostKeys, Math.max(1, Math.ceil((fastest * span) / turnBetweenKeys)));
    const keys = [this.startOf(index)];
    for (let i = 1; i < count; ++i) {
      const from = segment.start + ((i - 1) * span) / count;
      keys.push(step(segment, keys[i - 1], from, span / count));
    }
    this.keys.set(index, keys);
    return keys;
  }

  /**
   * How long a segment lasts, at most until the ball would rest.
   * @param {number} index
   */
  spanOf(index) {
    const segment = this.segments[index];
    if (index + 1 < this.segments.length) {
      return this.segments[index + 1].start - segment.start;
    }
    return Math.max(this.c.spin > 0 ? Math.abs(segment.ball.wz) / this.c.spin : 0, timeLeft(segment.ball, this.c));
  }

  /**
   * @param {number} index
   * @param {number} t
   * @returns {Quaternion}
   */
  turnedIn(index, t) {
    const segment = this.segments[index];
    if (segment.ball.state === 'stationary' || segment.ball.state === 'pocketed'
        || !(t > segment.start)) {
      return this.startOf(index);
    }
    const span = this.spanOf(index);
    const keys = this.keysOf(index);
    const part = span / keys.length;
    const i = part > 0 ? Math.min(keys.length - 1, Math.floor((t - segment.start) / part)) : 0;
    const from = segment.start + i * part;
    return step(segment, keys[i], from, Math.min(t, segment.start + span) - from);
  }

  /** @param {number} t */
  orientationAt(t) {
    return this.turnedIn(lastBefore(this.segments, t), t);
  }
}

/**
 * By the angular velocity in the middle of the step: exact while its direction stays.
 * @param {Segment | Hops} segment
 * @param {Quaternion} q
 * @param {number} from
 * @param {number} dt
 */
function step(segment, q, from, dt) {
  const { wx, wy, wz } = segment.at(from + dt / 2);
  return turned(q, wx * dt, wy * dt, wz * dt);
}

/** A whole shot. */
export class Motion {
  /** @param {{balls: Partial<BallState>[], events: ShotEvent[], physics: Physics,   orientations?: Map<number, Quaternion>, until?: number}} shot `balls`: before the first event */
  constructor({ balls, events, physics, orientations, until }) {
    this.events = events;
    this.physics = physics;
    const c = coefficients(physics);
    /** @type {Map<number, Track>} */
    this.tracks = new Map();
    const add = (/** @type {Partial<BallState>} */ ball) => {
      const id = ball.id ?? 0;
      this.tracks.set(id, new Track(completed(ball, c.radius), c,
        orientations?.get(id) ?? restingOrientation(id)));
    };
    balls.forEach(add);
    for (const event of events) {
      for (const after of event.after) {
        const known = this.tracks.get(after.id);
        if (!known || event.type === 'cue_strike') {
          // The cue ball may have been placed: it is where the strike finds it.
          add({ id: after.id, x: after.x, y: after.y });
        }
        this.tracks.get(after.id)?.take(event, after);
      }
    }
    this.duration = until ?? events.reduce((end, e) => Math.max(end, e.until ?? e.t), 0);
  }

  /**
   * All balls, in the order given.
   * @param {number} t
   * @returns {BallState[]}
   */
  ballsAt(t) {
    return [...this.tracks.values()].map((track) => track.at(t));
  }

  /**
   * @param {number} id
   * @param {number} t
   * @returns {BallState | undefined}
   */
  ballAt(id, t) {
    return this.tracks.get(id)?.at(t);
  }

  /**
   * @param {number} id
   * @param {number} t
   * @returns {Quaternion}
   */
  orientationAt(id, t) {
    return this.tracks.get(id)?.orientationAt(t) ?? restingOrientation(id);
  }

  /**
   * For the shot that comes after this one.
   * @returns {Map<number, Quaternion>}
   */
  finalOrientations() {
    return new Map([...this.tracks.keys()].map((id) => [id, this.orientationAt(id, this.duration)]));
  }

  /**
   * Whether this ball has moved by the end.
   * @param {number} id
   */
  isTouched(id) {
    return (this.tracks.get(id)?.segments.length ?? 0) > 1;
  }

  /**
   * When this ball fell, if it has by t.
   * @param {number} id
   * @param {number} t
   */
  fellAt(id, t) {
    const segments = this.tracks.get(id)?.segments ?? [];
    const last = segments[segments.length - 1];
    return last && last.ball.state === 'pocketed' && last.start <= t && last.start >= 0
      ? last.start : undefined;
  }

  /**
   * The way a ball has come by t, as parabolas: each from where the last one ended.
   * @param {number} id
   * @param {number} t
   * @returns {{x: number, y: number, cx: number, cy: number, ex: number, ey: number}[]}
   */
  pathUntil(id, t) {
    const track = this.tracks.get(id);
    const path = [];
    for (const [i, segment] of (track?.segments ?? []).entries()) {
      const end = track ? track.end(i, t) : t;
      if (!segment.moves || !(segment.start < end)) {
        continue;
      }
      const from = segment.at(segment.start);
      const to = segment.at(end);
      const half = (end - segment.start) / 2;
      const straight = segment instanceof Hops;
      path.push({
        x: from.x,
        y: from.y,
        cx: straight ? (from.x + to.x) / 2 : from.x + half * from.vx,
        cy: straight ? (from.y + to.y) / 2 : from.y + half * from.vy,
        ex: to.x,
        ey: to.y,
      });
    }
    return path;
  }
}
