// Shots of many kinds, as scenes of `poolhall simulate`.
const R = 0.028575;

/** A rack with its head ball on the foot spot, balls in touch. */
export function rack(x = 0.558, y = 1.677) {
  const balls = [];
  for (let row = 0; row < 5; ++row) {
    for (let i = 0; i <= row; ++i) {
      balls.push({ id: balls.length + 1, x: x + (2 * i - row) * R * 1.001, y: y + row * Math.sqrt(3) * R * 1.001 });
    }
  }
  return balls;
}

const plain = { table: 'olympiad', physics: 'olympiad' };
const cue = { id: 0, x: 0.5, y: 0.5 };

export const scenes = {
  'a break': { ...plain, balls: [{ id: 0, x: 0.56, y: 0.5 }, ...rack()], shot: { a: 0, b: 2, theta: 5, phi: 89.8, v: 8 } },
  'follow into a ball': { ...plain, balls: [cue, { id: 3, x: 0.52, y: 1.2 }], shot: { a: 0, b: 12, theta: 5, phi: 88, v: 4 } },
  'draw with english': { ...plain, balls: [cue, { id: 3, x: 0.52, y: 1.2 }], shot: { a: 9, b: -14, theta: 8, phi: 88.6, v: 5 } },
  'a masse': { ...plain, balls: [cue], shot: { a: 12, b: 6, theta: 70, phi: 80, v: 4 } },
  'side spin alone': { ...plain, balls: [cue], shot: { a: 20, b: 0, theta: 8, phi: 30, v: 1.2 } },
  'round the table': { ...plain, physics: 'modern', balls: [cue, { id: 9, x: 0.9, y: 2 }], shot: { a: -8, b: 4, theta: 6, phi: 38, v: 7 } },
  'jaws': {
    table: 'wpa9', physics: 'modern', balls: [{ id: 0, x: 0.6, y: 0.6 }, { id: 5, x: 1.14, y: 2.38 }],
    shot: { a: 0, b: 0, theta: 4, phi: 73.2, v: 3 },
  },
  'pressed to a rail by its spin': {
    ...plain, physics: 'modern', balls: [{ id: 0, x: R, y: 0.7, vy: 1.1, wx: -20, wy: -60, wz: 30 }],
  },
  'a ball that pushes two': {
    ...plain, balls: [{ id: 0, x: 0.3, y: 0.6 }, { id: 1, x: 0.3, y: 0.7 }, { id: 2, x: 0.3, y: 0.7 + 2 * R }],
    shot: { a: 0, b: 15, theta: 5, phi: 90, v: 4 },
  },
  'two balls that roll side by side': {
    ...plain, balls: [{ id: 0, x: 0.4, y: 0.6 }, { id: 1, x: 0.4 + 2 * R, y: 0.62 }, { id: 2, x: 0.45, y: 0.9 }],
    shot: { a: 4, b: 8, theta: 3, phi: 84, v: 2.5 },
  },
};
