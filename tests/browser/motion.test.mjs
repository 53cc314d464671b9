// motion.js against the program: at any instant of a shot the balls are where the physics has them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Motion, coefficients, motionStateOf, turned } from '../../clients/web/motion.js';
import { tableGeometry } from '../../clients/web/geometry.js';
import { simulateAll } from './program.mjs';
import { scenes } from './scenes.mjs';

const materials = {
  olympiad: { gravity: 9.81, ball_radius: 0.028575, mu_slide: 0.2, mu_roll: 0.015, mu_spin: 0.044 },
  modern: { gravity: 9.81, ball_radius: 0.028575, mu_slide: 0.2, mu_roll: 0.01, spin_deceleration: 10 },
};
const instants = 40;
const keys = ['x', 'y', 'vx', 'vy', 'wx', 'wy', 'wz'];
/** Of lengths in m and m/s; a ball's surface turns at R w. */
const tolerance = 1e-9;

/** Where hops were merged into one entry, nothing is said of what is between. */
const insideHops = (events, id, t) =>
  events.some((e) => e.until !== undefined && e.balls.includes(id) && t > e.t && t < e.until);

for (const [name, scene] of Object.entries(scenes)) {
  const [whole] = simulateAll([scene]);
  const physics = materials[scene.physics];

  test(`${name}: every instant is as the physics has it`, () => {
    const motion = new Motion({ balls: scene.balls, events: whole.events, physics });
    assert.ok(Math.abs(motion.duration - whole.duration) < 1e-12);
    const times = [...Array(instants).keys()].map((i) => ((i + 0.37) / instants) * whole.duration);
    const truths = simulateAll(times.map((t) => ({ ...scene, t_max: t })));
    let compared = 0;
    truths.forEach((truth, i) => {
      for (const ball of truth.final) {
        const drawn = motion.ballAt(ball.id, times[i]);
        if (insideHops(whole.events, ball.id, times[i])) {
          assert.ok(Math.hypot(drawn.x - ball.x, drawn.y - ball.y) < 2e-4, `hops at ${times[i]}`);
          continue;
        }
        assert.equal(drawn.state, ball.state, `${name}, ball ${ball.id} at ${times[i]}`);
        for (const key of ball.state === 'pocketed' ? [] : keys) {
          const scale = key.startsWith('w') ? physics.ball_radius : 1;
          const off = Math.abs(drawn[key] - ball[key]) * scale;
          assert.ok(off < tolerance, `ball ${ball.id} at ${times[i]}: ${key} is ${drawn[key]}, not ${ball[key]}`);
          ++compared;
        }
      }
    });
    assert.ok(compared > instants);
  });

  test(`${name}: the end is where the balls came to rest`, () => {
    const motion = new Motion({ balls: scene.balls, events: whole.events, physics });
    for (const ball of whole.final.filter((b) => b.state !== 'pocketed')) {
      const drawn = motion.ballAt(ball.id, whole.duration + 1);
      assert.ok(Math.hypot(drawn.x - ball.x, drawn.y - ball.y) < tolerance);
    }
  });

  test(`${name}: paths are whole and begin and end at balls`, () => {
    const motion = new Motion({ balls: scene.balls, events: whole.events, physics });
    for (const id of motion.tracks.keys()) {
      const path = motion.pathUntil(id, whole.duration);
      for (let i = 1; i < path.length; ++i) {
        assert.ok(Math.hypot(path[i].x - path[i - 1].ex, path[i].y - path[i - 1].ey) < 1e-8);
      }
      assert.equal(path.length > 0, motion.isTouched(id) && motion.pathUntil(id, whole.duration).length > 0);
    }
  });
}

test('a hop entry of a pressed ball is met by the scenes', () => {
  const results = simulateAll(Object.values(scenes));
  assert.ok(results.some((r) => r.events.some((e) => e.until !== undefined)));
});

test('a rolling ball turns by its way over its radius', () => {
  const physics = materials.olympiad;
  const R = physics.ball_radius;
  const after = { id: 0, state: 'rolling', x: 0, y: 0, vx: 0, vy: 1, wx: -1 / R, wy: 0, wz: 0 };
  const motion = new Motion({
    balls: [{ id: 0, x: 0, y: 0 }], physics, orientations: new Map([[0, [1, 0, 0, 0]]]),
    events: [{ t: 0, type: 'cue_strike', balls: [0], after: [after] }], until: 2,
  });
  const t = 1.234;
  const way = motion.ballAt(0, t).y;
  const [w, x] = motion.orientationAt(0, t);
  const angle = way / R;
  assert.ok(Math.abs(Math.abs(w) - Math.abs(Math.cos(angle / 2))) < 1e-9);
  assert.ok(Math.abs(Math.abs(x) - Math.abs(Math.sin(angle / 2))) < 1e-9);
});

test('an orientation depends on the instant alone, not on what was asked before', () => {
  const scene = scenes['draw with english'];
  const [{ events, duration }] = simulateAll([scene]);
  const make = () => new Motion({ balls: scene.balls, events, physics: materials.olympiad });
  const [once, often] = [make(), make()];
  for (let i = 0; i <= 300; ++i) {
    often.orientationAt(0, (duration * (300 - i)) / 300);
  }
  for (let i = 0; i <= 20; ++i) {
    assert.deepEqual(once.orientationAt(0, (duration * i) / 20), often.orientationAt(0, (duration * i) / 20));
  }
});

test('an orientation is the integral of the angular velocity', () => {
  const scene = scenes['a masse'];
  const [{ events, duration }] = simulateAll([scene]);
  const motion = new Motion({ balls: scene.balls, events, physics: materials.olympiad });
  const steps = 200_000;
  let q = motion.orientationAt(0, 0);
  for (let i = 0; i < steps; ++i) {
    const dt = duration / steps;
    const { wx, wy, wz } = motion.ballAt(0, (i + 0.5) * dt);
    q = turned(q, wx * dt, wy * dt, wz * dt);
  }
  const end = motion.orientationAt(0, duration);
  const cosine = Math.abs(q.reduce((sum, v, i) => sum + v * end[i], 0));
  assert.ok(cosine > 0.9995, `turned apart by ${(2 * Math.acos(Math.min(1, cosine)) * 180) / Math.PI} degrees`);
});

test('the state of a ball follows from its velocities', () => {
  const R = 0.028575;
  const ball = (v) => ({ id: 1, state: '', x: 0, y: 0, vx: 0, vy: 0, wx: 0, wy: 0, wz: 0, ...v });
  assert.equal(motionStateOf(ball({}), R), 'stationary');
  assert.equal(motionStateOf(ball({ wz: -3 }), R), 'spinning');
  assert.equal(motionStateOf(ball({ vx: 1 }), R), 'sliding');
  assert.equal(motionStateOf(ball({ vx: 1, wy: 1 / R }), R), 'rolling');
  assert.equal(coefficients(materials.modern).spin, 10);
});

test('a bar table has the jaws of its numbers', () => {
  const table = {
    width: 0.9906, length: 1.9812,
    pockets: {
      kind: 'jaws', cushion_width: 0.0508,
      corner: { width: 0.118, angle: 5.3, depth: 0.0417, radius: 0.062, jaw_radius: 0.02095 },
      side: { width: 0.137, angle: 7.14, depth: 0.0685, radius: 0.0645, jaw_radius: 0.00795 },
    },
  };
  const { cushions, holes } = tableGeometry(table);
  assert.equal(cushions.length, 6);
  assert.equal(holes.length, 6);
  const near = (a, b) => Math.abs(a - b) < 1e-6;
  const points = cushions.flatMap((c) => c.points);
  const has = (x, y) => points.some((p) => near(p.x, x) && near(p.y, y));
  // physics.md 6: rails end at .091002, facings (.02225, -.0508)-(.07762, -.004831) and
  // (-.0508, .928463)-(-.006962, .922972), to the digits given there.
  assert.ok(has(0.0910017, 0) || points.some((p) => Math.abs(p.x - 0.091002) < 1e-5 && p.y === 0));
  const close = (x, y) => points.some((p) => Math.abs(p.x - x) < 6e-6 && Math.abs(p.y - y) < 6e-6);
  assert.ok(close(0.02225, -0.0508) && close(0.07762, -0.004831));
  assert.ok(close(-0.0508, 0.928463) && close(-0.006962, 0.922972));
});
