// Balls that roll: drawn as vectors from their orientation, so that they are crisp at any size.
// Numbers and stripes are circles on the sphere, seen from above as parts of ellipses.
//
//   const art = new BallArt(radiusInPixels);
//   art.draw(ctx, 9, x, y, axes);
//
// `axes`: where the ball's own axes point, in the screen's frame (x right, y down, z at the eye).

/** @typedef {[number, number, number]} Vector */

/** By number: 0 the cue ball, 9 to 15 the stripes of 1 to 7. */
export const ballColours = [
  '#f7f5ec', '#f2b705', '#1f56c4', '#d5281f', '#6a2f9c', '#f0741a', '#13793f', '#8e1b2c', '#17181b',
];

/** @param {number} id */
export const colourOf = (id) => ballColours[id > 8 ? id - 8 : id];

/** Of paths: the same hues, light enough to be told apart on the cloth. */
const lineColours = [
  '#ffffff', '#ffd23e', '#7fa8ff', '#ff6b5e', '#c79bff', '#ff9d52', '#8df0b2', '#ff8fa3', '#c3c8d0',
];

/** @param {number} id */
export const lineColourOf = (id) => lineColours[id > 8 ? id - 8 : id];

const ivory = '#f7f5ec';
const spotAngle = 0.52;
const capAngle = 1.02;
const measleAngle = 0.16;

/**
 * Fills the visible part of a circle on the unit sphere.
 * @param {CanvasRenderingContext2D} ctx
 * @param {Vector} axis towards the circle's middle
 * @param {number} angle from the middle to the rim
 */
function fillCap(ctx, [x, y, z], angle) {
  const flat = Math.sqrt(x * x + y * y);
  const cos = Math.cos(angle);
  const sin = Math.sin(angle);
  ctx.beginPath();
  if (flat < 1e-6) {
    if (z > 0) {
      ctx.arc(0, 0, sin, 0, 2 * Math.PI);
      ctx.fill();
    }
    return;
  }
  const towards = Math.atan2(y, x);
  // The rim: cos * axis + sin * (cos f * u + sin f * w), u level and w the steepest way up.
  const level = (-cos * z) / (sin * flat);
  const tilt = towards + Math.PI / 2;
  if (level >= 1) {
    return;
  }
  if (level <= -1) {
    ctx.ellipse(cos * x, cos * y, sin, sin * Math.abs(z), tilt, 0, 2 * Math.PI);
  } else {
    // The visible arc of the rim, closed along the ball's outline.
    const from = Math.asin(level);
    const half = Math.acos(Math.min(1, cos / flat));
    const steps = 14;
    for (let i = 0; i <= steps; ++i) {
      const f = from + ((Math.PI - 2 * from) * i) / steps;
      const u = sin * Math.cos(f);
      const w = sin * Math.sin(f);
      // w's axis is (-z * x / flat, -z * y / flat, flat): up, away from the middle when z > 0.
      ctx.lineTo(cos * x - u * (y / flat) - w * ((z * x) / flat),
        cos * y + u * (x / flat) - w * ((z * y) / flat));
    }
    ctx.arc(0, 0, 1, towards - half, towards + half);
    ctx.closePath();
  }
  ctx.fill();
}

/**
 * A round picture that many balls share.
 * @param {number} size
 * @param {(ctx: any) => void} paint
 */
function sprite(size, paint) {
  const canvas = document.createElement('canvas');
  canvas.width = size;
  canvas.height = size;
  const ctx = canvas.getContext('2d');
  if (ctx) {
    ctx.translate(size / 2, size / 2);
    paint(ctx);
  }
  return canvas;
}

export class BallArt {
  /** @param {number} radius in device pixels */
  constructor(radius) {
    this.radius = radius;
    const size = Math.ceil(radius * 2) + 2;
    this.size = size;
    this.shade = sprite(size, (ctx) => {
      const dark = ctx.createRadialGradient(-0.3 * radius, -0.35 * radius, 0.2 * radius, 0, 0, radius);
      dark.addColorStop(0, 'rgba(255,255,255,.18)');
      dark.addColorStop(0.45, 'rgba(0,0,0,0)');
      dark.addColorStop(1, 'rgba(0,0,0,.5)');
      ctx.fillStyle = dark;
      ctx.beginPath();
      ctx.arc(0, 0, radius, 0, 2 * Math.PI);
      ctx.fill();
      const light = ctx.createRadialGradient(-0.36 * radius, -0.42 * radius, 0, -0.36 * radius,
        -0.42 * radius, 0.3 * radius);
      light.addColorStop(0, 'rgba(255,255,255,.85)');
      light.addColorStop(1, 'rgba(255,255,255,0)');
      ctx.fillStyle = light;
      ctx.fill();
    });
    this.shadow = sprite(size * 2, (ctx) => {
      const soft = ctx.createRadialGradient(0, 0, 0.55 * radius, 0, 0, 1.35 * radius);
      soft.addColorStop(0, 'rgba(0,0,0,.5)');
      soft.addColorStop(1, 'rgba(0,0,0,0)');
      ctx.fillStyle = soft;
      ctx.beginPath();
      ctx.arc(0, 0, 1.35 * radius, 0, 2 * Math.PI);
      ctx.fill();
    });
  }

  /**
   * @param {CanvasRenderingContext2D} ctx
   * @param {number} x
   * @param {number} y
   */
  drawShadow(ctx, x, y) {
    ctx.drawImage(this.shadow, x - this.size + 0.16 * this.radius, y - this.size + 0.24 * this.radius);
  }

  /**
   * @param {CanvasRenderingContext2D} ctx
   * @param {number} id
   * @param {number} x
   * @param {number} y
   * @param {[Vector, Vector, Vector]} axes
   * @param {number} [scale]
   */
  draw(ctx, id, x, y, axes, scale = 1) {
    ctx.save();
    ctx.translate(x, y);
    ctx.scale(this.radius * scale, this.radius * scale);
    ctx.fillStyle = colourOf(id);
    ctx.beginPath();
    ctx.arc(0, 0, 1, 0, 2 * Math.PI);
    ctx.fill();
    if (id === 0) {
      this.measles(ctx, axes);
    } else {
      this.marks(ctx, id, axes);
    }
    ctx.scale(1 / this.radius, 1 / this.radius);
    ctx.drawImage(this.shade, -this.size / 2, -this.size / 2);
    ctx.restore();
  }

  /**
   * The cue ball's six spots.
   * @param {CanvasRenderingContext2D} ctx
   * @param {Vector[]} axes
   */
  measles(ctx, axes) {
    ctx.fillStyle = '#c8321f';
    for (const axis of axes) {
      fillCap(ctx, axis, measleAngle);
      fillCap(ctx, [-axis[0], -axis[1], -axis[2]], measleAngle);
    }
  }

  /**
   * @param {CanvasRenderingContext2D} ctx
   * @param {number} id
   * @param {Vector[]} axes
   */
  marks(ctx, id, [across, up, spot]) {
    ctx.fillStyle = ivory;
    if (id > 8) {
      fillCap(ctx, up, capAngle);
      fillCap(ctx, [-up[0], -up[1], -up[2]], capAngle);
    }
    const back = /** @type {Vector} */ ([-spot[0], -spot[1], -spot[2]]);
    fillCap(ctx, spot, spotAngle);
    fillCap(ctx, back, spotAngle);
    ctx.fillStyle = '#17181b';
    this.number(ctx, id, spot, across, up);
    this.number(ctx, id, back, /** @type {Vector} */ ([-across[0], -across[1], -across[2]]), up);
  }

  /**
   * @param {CanvasRenderingContext2D} ctx
   * @param {number} id
   * @param {Vector} out
   * @param {Vector} right
   * @param {Vector} up
   */
  number(ctx, id, out, right, up) {
    if (out[2] < 0.25) {
      return;
    }
    ctx.save();
    ctx.transform(right[0], right[1], -up[0], -up[1], 0.97 * out[0], 0.97 * out[1]);
    ctx.font = `700 ${id > 9 ? 0.56 : 0.68}px system-ui, sans-serif`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.fillText(String(id), 0, 0.03);
    ctx.restore();
  }
}
