// The outlines of a table from its numbers (config/README.md): where rails end, jaws turn, pockets
// open. The corner at the origin and half a side pocket are worked out, the rest are mirror images.
//
//   const { cushions, holes } = tableGeometry(table, radius);
//   cushions[0].points;   // m, the nose first, then back along the rail's outer edge

/**
 * @typedef {{x: number, y: number}} Point
 * @typedef {{width: number, angle: number, depth: number, radius: number, jaw_radius: number}} Jaw
 * @typedef {{name?: string, width: number, length: number, head_string?: number,
 *   foot_spot?: Point, pockets: 'none' | {kind: 'mouth_lines', corner: number, side: number} |
 *   {kind: 'jaws', cushion_width: number, corner: Jaw, side: Jaw}}} Table
 * @typedef {{points: Point[], nose: Point[]}} Cushion
 * @typedef {{pocket: string, centre: Point, radius: number}} Hole
 * @typedef {{cushions: Cushion[], holes: Hole[], mouths: [Point, Point][], cushionWidth: number}}
 *   Geometry
 */

const radians = Math.PI / 180;
/** Of tables without jaws, whose cushions have no depth. */
const plainCushionWidth = 0.0508;
const arcSteps = 12;

/**
 * @param {Point} centre
 * @param {number} radius
 * @param {number} from
 * @param {number} to
 */
function arc(centre, radius, from, to) {
  const points = [];
  for (let i = 0; i <= arcSteps; ++i) {
    const angle = from + ((to - from) * i) / arcSteps;
    points.push({ x: centre.x + radius * Math.cos(angle), y: centre.y + radius * Math.sin(angle) });
  }
  return points;
}

/**
 * The head rail's end at the corner of the origin: nose, arc, facing.
 * @param {Jaw} jaw
 * @param {number} k the cushion's width
 * @returns {Point[]}
 */
export function cornerJaw(jaw, k) {
  const mouth = jaw.width / Math.SQRT2;
  const j = jaw.jaw_radius;
  const turn = (45 + jaw.angle) * radians;
  const end = mouth + j / Math.tan(((135 + jaw.angle) / 2) * radians);
  const centre = { x: end, y: -j };
  // From straight up (the nose) round to the facing's normal.
  const last = Math.atan2(Math.sin(turn), -Math.cos(turn));
  return [...arc(centre, j, Math.PI / 2, last), { x: mouth - k * Math.tan(turn), y: -k }];
}

/**
 * The left rail's head half at the side pocket: nose, arc, facing.
 * @param {Jaw} jaw
 * @param {number} k
 * @param {number} length
 * @returns {Point[]}
 */
export function sideJaw(jaw, k, length) {
  const mouth = (length - jaw.width) / 2;
  const j = jaw.jaw_radius;
  const f = jaw.angle * radians;
  const end = mouth - j / Math.tan(((90 + jaw.angle) / 2) * radians);
  const centre = { x: -j, y: end };
  const last = Math.atan2(Math.cos(f), Math.sin(f));
  return [...arc(centre, j, 0, last), { x: -k, y: mouth + k * Math.tan(f) }];
}

/** @param {Point} p */
const swapped = (p) => ({ x: p.y, y: p.x });

/**
 * Both ends of the head rail and of the left rail's head half, from nose to back.
 * @param {Table} table
 * @returns {{corner: Point[], side: Point[], k: number}}
 */
function railEnds(table) {
  const { pockets } = table;
  const k = plainCushionWidth;
  if (pockets === 'none') {
    return { corner: [{ x: 0, y: 0 }, { x: 0, y: -k }], side: [], k };
  }
  if (pockets.kind === 'mouth_lines') {
    const leg = pockets.corner / Math.SQRT2;
    const half = (table.length - pockets.side) / 2;
    return {
      corner: [{ x: leg, y: 0 }, { x: leg - k * 0.7, y: -k }],
      side: [{ x: 0, y: half }, { x: -k, y: half + k * 0.12 }],
      k,
    };
  }
  return {
    corner: cornerJaw(pockets.corner, pockets.cushion_width),
    side: sideJaw(pockets.side, pockets.cushion_width, table.length),
    k: pockets.cushion_width,
  };
}

/**
 * @param {Table} table
 * @returns {Hole[]}
 */
function holesOf(table) {
  const { pockets, width, length } = table;
  if (pockets === 'none') {
    return [];
  }
  // A table of mouth lines has no holes; what is drawn behind a mouth is as wide as the mouth.
  const jaws = pockets.kind === 'jaws';
  const cornerRadius = jaws ? pockets.corner.radius : pockets.corner / 2;
  const cornerDepth = jaws ? pockets.corner.depth / Math.SQRT2 : -pockets.corner / (2 * Math.SQRT2)
    + cornerRadius * 0.55;
  const sideRadius = jaws ? pockets.side.radius : pockets.side / 2;
  const sideDepth = jaws ? pockets.side.depth : sideRadius * 0.62;
  /** @type {Hole[]} */
  const holes = [];
  for (const [side, x, out] of /** @type {[string, number, number][]} */ (
    [['left', 0, -1], ['right', width, 1]])) {
    holes.push({ pocket: `head_${side}`, centre: { x: x + out * cornerDepth, y: -cornerDepth }, radius: cornerRadius });
    holes.push({ pocket: `side_${side}`, centre: { x: x + out * sideDepth, y: length / 2 }, radius: sideRadius });
    holes.push({
      pocket: `foot_${side}`,
      centre: { x: x + out * cornerDepth, y: length + cornerDepth },
      radius: cornerRadius,
    });
  }
  return holes;
}

/**
 * @param {Table} table
 * @returns {[Point, Point][]}
 */
function mouthsOf({ pockets, width, length }) {
  if (pockets === 'none' || pockets.kind !== 'mouth_lines') {
    return [];
  }
  const leg = pockets.corner / Math.SQRT2;
  const half = pockets.side / 2;
  /** @type {[Point, Point][]} */
  const mouths = [];
  for (const [x, inward] of [[0, leg], [width, -leg]]) {
    mouths.push([{ x: x + inward, y: 0 }, { x, y: leg }]);
    mouths.push([{ x: x + inward, y: length }, { x, y: length - leg }]);
    mouths.push([{ x, y: length / 2 - half }, { x, y: length / 2 + half }]);
  }
  return mouths;
}

/**
 * @param {Table} table
 * @returns {Geometry}
 */
export function tableGeometry(table) {
  const { width, length } = table;
  const { corner, side, k } = railEnds(table);
  const flipX = (/** @type {Point} */ p) => ({ x: width - p.x, y: p.y });
  const flipY = (/** @type {Point} */ p) => ({ x: p.x, y: length - p.y });
  // Nose ends first, so that the first of `first` and of `last` are joined by the nose line.
  const cushion = (/** @type {Point[]} */ first, /** @type {Point[]} */ last) => ({
    points: [...[...first].reverse(), ...last],
    nose: [first[0], last[0]],
  });
  const leftCorner = corner.map(swapped);
  const head = cushion(corner, corner.map(flipX));
  const left = side.length > 0 ? cushion(leftCorner, side)
    : cushion(leftCorner, leftCorner.map(flipY));
  const mirrored = (/** @type {Cushion} */ c, /** @type {(p: Point) => Point} */ flip) => ({
    points: c.points.map(flip),
    nose: c.nose.map(flip),
  });
  const cushions = [head, mirrored(head, flipY), left, mirrored(left, flipX)];
  if (side.length > 0) {
    cushions.push(mirrored(left, flipY), mirrored(mirrored(left, flipX), flipY));
  }
  return { cushions, holes: holesOf(table), mouths: mouthsOf(table), cushionWidth: k };
}
