// The picture of the bare table: wood, leather, cloth, cushions, pockets, sights. Painted once for
// each size; balls and paths are drawn upon a copy.
//
//   const m = tableMargin(geometry);        // m, of everything around the nose lines
//   paintGround(ctx, { table, geometry, scale, around, enter });

/**
 * @typedef {import('./geometry.js').Point} Point
 * @typedef {{table: import('./geometry.js').Table, geometry: import('./geometry.js').Geometry,
 *   scale: number, around: string, enter: (ctx: CanvasRenderingContext2D) => void}} Setting
 *   `scale`: pixels a metre; `around`: the page's colour, seen at the table's round corners;
 *   `enter`: table coordinates, in metres, for what follows
 */

/** Of the wood around the cushions at least, m. */
const rail = 0.07;
const corner = 0.05;
const leather = 0.013;
const cloth = { lamp: '#2a8a5e', middle: '#1c6d49', edge: '#114b32' };
const cushion = { nose: '#2b8a5f', top: '#1a6443', back: '#0e3d29' };
const wood = { light: '#8a5a36', middle: '#6d4328', dark: '#4b2c19' };
const pearl = '#eadfc6';
const grains = 34;

/**
 * Numbers between 0 and 1 that are the same each time.
 * @param {number} seed
 */
function dice(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** @param {import('./geometry.js').Geometry} geometry */
export function tableMargin(geometry) {
  const reach = geometry.holes.map(({ centre, radius }) => radius - Math.min(centre.x, centre.y, 0));
  return Math.max(geometry.cushionWidth + rail, ...reach.map((r) => r + leather + 0.016));
}

/**
 * One of four rails of wood, with its grain; the corners are mitred.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Point[]} outline the outer edge's ends, then the inner edge's
 * @param {{along: Point, across: Point, from: Point, long: number, deep: number, seed: number}} board
 */
function paintBoard(ctx, outline, { along, across, from, long, deep, seed }) {
  const random = dice(seed);
  ctx.save();
  ctx.beginPath();
  outline.forEach((p) => ctx.lineTo(p.x, p.y));
  ctx.closePath();
  ctx.clip();
  const at = (/** @type {number} */ s, /** @type {number} */ d) => ({
    x: from.x + along.x * s + across.x * d, y: from.y + along.y * s + across.y * d,
  });
  const [near, far] = [at(0, 0), at(0, deep)];
  const shade = ctx.createLinearGradient(near.x, near.y, far.x, far.y);
  shade.addColorStop(0, wood.dark);
  shade.addColorStop(0.3, wood.light);
  shade.addColorStop(0.75, wood.middle);
  shade.addColorStop(1, wood.dark);
  ctx.fillStyle = shade;
  ctx.fill();
  for (let i = 0; i < grains; ++i) {
    const depth = deep * random();
    const bend = 0.006 * (random() - 0.5);
    ctx.strokeStyle = random() < 0.6 ? `rgba(35,16,6,${0.08 + 0.2 * random()})` : `rgba(220,160,105,${0.04 + 0.08 * random()})`;
    ctx.lineWidth = 0.0006 + 0.0016 * random();
    const [a, b, c] = [at(-0.1, depth), at(long * random(), depth + bend), at(long + 0.1, depth - bend)];
    ctx.beginPath();
    ctx.moveTo(a.x, a.y);
    ctx.quadraticCurveTo(b.x, b.y, c.x, c.y);
    ctx.stroke();
  }
  ctx.restore();
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} width
 * @param {number} length
 * @param {number} m margin
 * @param {number} k cushions' width
 */
function paintWood(ctx, width, length, m, k) {
  const [l, r, t, b] = [-m, width + m, -m, length + m];
  const [il, ir, it, ib] = [-k, width + k, -k, length + k];
  const deep = m - k;
  ctx.save();
  ctx.beginPath();
  ctx.roundRect(l, t, r - l, b - t, corner);
  ctx.clip();
  const x = { x: 1, y: 0 };
  const y = { x: 0, y: 1 };
  paintBoard(ctx, [{ x: l, y: t }, { x: r, y: t }, { x: ir, y: it }, { x: il, y: it }],
    { along: x, across: y, from: { x: l, y: t }, long: r - l, deep, seed: 3 });
  paintBoard(ctx, [{ x: l, y: b }, { x: r, y: b }, { x: ir, y: ib }, { x: il, y: ib }],
    { along: x, across: { x: 0, y: -1 }, from: { x: l, y: b }, long: r - l, deep, seed: 5 });
  paintBoard(ctx, [{ x: l, y: t }, { x: l, y: b }, { x: il, y: ib }, { x: il, y: it }],
    { along: y, across: x, from: { x: l, y: t }, long: b - t, deep, seed: 7 });
  paintBoard(ctx, [{ x: r, y: t }, { x: r, y: b }, { x: ir, y: ib }, { x: ir, y: it }],
    { along: y, across: { x: -1, y: 0 }, from: { x: r, y: t }, long: b - t, deep, seed: 11 });
  ctx.restore();
  ctx.strokeStyle = 'rgba(255,214,170,.22)';
  ctx.lineWidth = 0.002;
  ctx.beginPath();
  ctx.roundRect(l + 0.0015, t + 0.0015, r - l - 0.003, b - t - 0.003, corner);
  ctx.stroke();
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} width
 * @param {number} length
 * @param {number} k
 */
function paintCloth(ctx, width, length, k) {
  ctx.fillStyle = cloth.edge;
  ctx.fillRect(-k, -k, width + 2 * k, length + 2 * k);
  const light = ctx.createRadialGradient(width / 2, length / 2, 0, width / 2, length / 2, length * 0.68);
  light.addColorStop(0, cloth.lamp);
  light.addColorStop(0.45, cloth.middle);
  light.addColorStop(1, cloth.edge);
  ctx.fillStyle = light;
  ctx.fillRect(-k, -k, width + 2 * k, length + 2 * k);
}

/**
 * The nap: specks that one sees only from near by.
 * @param {CanvasRenderingContext2D} ctx
 */
function paintNap(ctx) {
  const size = 96;
  const speck = document.createElement('canvas');
  speck.width = size;
  speck.height = size;
  const pixels = speck.getContext('2d');
  const picture = pixels?.createImageData(size, size);
  if (!pixels || !picture) {
    return;
  }
  const random = dice(17);
  for (let i = 0; i < picture.data.length; i += 4) {
    const bright = random() < 0.5 ? 255 : 0;
    picture.data.set([bright, bright, bright, 12 * random()], i);
  }
  pixels.putImageData(picture, 0, 0);
  const pattern = ctx.createPattern(speck, 'repeat');
  if (pattern) {
    ctx.fillStyle = pattern;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillRect(0, 0, ctx.canvas.width, ctx.canvas.height);
  }
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Setting} setting
 */
function paintCushions(ctx, { geometry, scale }) {
  const k = geometry.cushionWidth;
  for (const { points, nose } of geometry.cushions) {
    const [a, b] = nose;
    // From the nose to the back, whichever way this rail faces.
    const back = points[0];
    const level = Math.abs(a.y - b.y) < Math.abs(a.x - b.x);
    const to = level ? { x: a.x, y: back.y } : { x: back.x, y: a.y };
    const slope = ctx.createLinearGradient(a.x, a.y, to.x, to.y);
    slope.addColorStop(0, cushion.nose);
    slope.addColorStop(0.22, cushion.top);
    slope.addColorStop(1, cushion.back);
    ctx.beginPath();
    points.forEach((p) => ctx.lineTo(p.x, p.y));
    ctx.closePath();
    ctx.fillStyle = slope;
    ctx.shadowColor = 'rgba(0,0,0,.55)';
    ctx.shadowBlur = 0.35 * k * scale;
    ctx.fill();
    ctx.shadowColor = 'transparent';
    ctx.shadowBlur = 0;
    ctx.beginPath();
    nose.forEach((p) => ctx.lineTo(p.x, p.y));
    ctx.strokeStyle = 'rgba(170,240,205,.35)';
    ctx.lineWidth = 0.0016;
    ctx.stroke();
  }
}

/**
 * Leather behind the holes, where they reach into the wood.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Setting} setting
 */
function paintLeather(ctx, { table, geometry }) {
  for (const { centre, radius, pocket } of geometry.holes) {
    const x = centre.x < table.width / 2 ? -1 : 1;
    const y = pocket.startsWith('side') ? 0 : pocket.startsWith('head') ? -1 : 1;
    const out = Math.atan2(y, x);
    const half = (pocket.startsWith('side') ? 96 : 124) * (Math.PI / 180);
    ctx.beginPath();
    ctx.arc(centre.x, centre.y, radius + leather, out - half, out + half);
    ctx.arc(centre.x, centre.y, radius - 0.004, out + half, out - half, true);
    ctx.closePath();
    const hide = ctx.createRadialGradient(centre.x, centre.y, radius, centre.x, centre.y, radius + leather);
    hide.addColorStop(0, '#0d0907');
    hide.addColorStop(0.45, '#3a2a20');
    hide.addColorStop(1, '#17100c');
    ctx.fillStyle = hide;
    ctx.fill();
  }
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Setting} setting
 */
function paintHoles(ctx, { geometry }) {
  for (const { centre, radius } of geometry.holes) {
    const depth = ctx.createRadialGradient(centre.x, centre.y, radius * 0.2, centre.x, centre.y, radius);
    depth.addColorStop(0, '#000');
    depth.addColorStop(0.78, '#050505');
    depth.addColorStop(1, '#191714');
    ctx.fillStyle = depth;
    ctx.beginPath();
    ctx.arc(centre.x, centre.y, radius, 0, 2 * Math.PI);
    ctx.fill();
  }
  ctx.strokeStyle = 'rgba(255,255,255,.28)';
  ctx.lineWidth = 0.002;
  for (const [from, to] of geometry.mouths) {
    ctx.beginPath();
    ctx.moveTo(from.x, from.y);
    ctx.lineTo(to.x, to.y);
    ctx.stroke();
  }
}

/**
 * Head string and foot spot.
 * @param {CanvasRenderingContext2D} ctx
 * @param {import('./geometry.js').Table} table
 */
function paintMarks(ctx, table) {
  ctx.strokeStyle = 'rgba(255,255,255,.17)';
  ctx.lineWidth = 0.0025;
  if (table.head_string) {
    ctx.beginPath();
    ctx.moveTo(0, table.head_string);
    ctx.lineTo(table.width, table.head_string);
    ctx.stroke();
  }
  const spot = table.foot_spot;
  if (spot) {
    ctx.fillStyle = 'rgba(255,255,255,.4)';
    ctx.beginPath();
    ctx.arc(spot.x, spot.y, 0.0055, 0, 2 * Math.PI);
    ctx.fill();
  }
}

/**
 * Diamonds at the eighths and quarters, none where a pocket is.
 * @param {CanvasRenderingContext2D} ctx
 * @param {number} width
 * @param {number} length
 * @param {number} out from the nose line to their middle
 */
function paintSights(ctx, width, length, out) {
  const sight = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ turn) => {
    const [long, short] = [0.0105, 0.0056];
    const [dx, dy] = turn ? [long, short] : [short, long];
    ctx.beginPath();
    ctx.moveTo(x - dx, y);
    ctx.lineTo(x, y - dy);
    ctx.lineTo(x + dx, y);
    ctx.lineTo(x, y + dy);
    ctx.closePath();
    ctx.fillStyle = pearl;
    ctx.fill();
    ctx.strokeStyle = 'rgba(40,20,8,.6)';
    ctx.lineWidth = 0.0012;
    ctx.stroke();
  };
  for (let i = 1; i < 8; ++i) {
    if (i !== 4) {
      sight(-out, (length * i) / 8, 1);
      sight(width + out, (length * i) / 8, 1);
    }
  }
  for (let i = 1; i < 4; ++i) {
    sight((width * i) / 4, -out, 0);
    sight((width * i) / 4, length + out, 0);
  }
}

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {Setting} setting
 */
export function paintGround(ctx, setting) {
  const { table, geometry, around, enter } = setting;
  const m = tableMargin(geometry);
  const k = geometry.cushionWidth;
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.fillStyle = around;
  ctx.fillRect(0, 0, ctx.canvas.width, ctx.canvas.height);
  enter(ctx);
  paintWood(ctx, table.width, table.length, m, k);
  ctx.save();
  ctx.beginPath();
  ctx.rect(-k, -k, table.width + 2 * k, table.length + 2 * k);
  ctx.clip();
  paintCloth(ctx, table.width, table.length, k);
  paintNap(ctx);
  ctx.restore();
  enter(ctx);
  paintMarks(ctx, table);
  paintCushions(ctx, setting);
  ctx.strokeStyle = 'rgba(0,0,0,.45)';
  ctx.lineWidth = 0.003;
  ctx.strokeRect(-k, -k, table.width + 2 * k, table.length + 2 * k);
  paintLeather(ctx, setting);
  paintHoles(ctx, setting);
  paintSights(ctx, table.width, table.length, (m + k) / 2);
}
