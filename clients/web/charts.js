// Charts as SVG: ratings with their error bars, ratings over time.
//
//   page.append(intervalChart([{ label: 'Anna', value: 120, margin: 60 }]));

import { svg } from './dom.js';

/** Of the scheme's, style.css. */
const seriesColours = 8;

/** Characters; the whole name is in the tooltip. */
const longestLabel = 20;
/** Of a label's character, in a chart's units, about. */
const labelWidth = 7.5;

/**
 * A colour that stays with a name's place.
 * @param {number} index
 */
export const seriesColour = (index) => `var(--series${index % seriesColours})`;

/**
 * Round numbers from low to high.
 * @param {number} low
 * @param {number} high
 * @param {number} count
 */
export function ticks(low, high, count) {
  const span = high - low || 1;
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const unit = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? rough;
  const out = [];
  for (let v = Math.ceil(low / unit) * unit; v <= high + unit * 1e-9; v += unit) {
    out.push(Math.abs(v) < unit * 1e-9 ? 0 : v);
  }
  return out;
}

/** Units across a chart; fewer where there is little room, for its text shrinks with it. */
const chartWidth = () => Math.max(320, Math.min(640, window.innerWidth - 40));

/** @param {number | string} value */
const withMinus = (value) => String(value).replace('-', '−');

/**
 * @param {string} name
 * @param {number} most characters
 */
const shortened = (name, most) => (name.length > most ? `${name.slice(0, most - 1)}…` : name);

/**
 * One line a row: a point and its 95 % interval.
 * @param {{label: string, value: number, margin: number}[]} rows
 * @param {string} title
 */
export function intervalChart(rows, title) {
  const low = Math.min(...rows.map((r) => r.value - r.margin));
  const high = Math.max(...rows.map((r) => r.value + r.margin));
  const pad = (high - low || 100) * 0.06;
  const width = chartWidth();
  const longest = Math.min(longestLabel, Math.max(...rows.map((r) => r.label.length)));
  const [left, line, top] = [Math.min(width * 0.42, longest * labelWidth + 16), 30, 8];
  const most = Math.floor((left - 14) / labelWidth);
  const height = top + rows.length * line + 26;
  const x = (/** @type {number} */ v) =>
    left + ((v - low + pad) / (high - low + 2 * pad || 1)) * (width - left - 16);
  const grid = ticks(low - pad, high + pad, width / 70);
  return svg('svg', { class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title },
    svg('title', {}, title),
    grid.map((v) => [
      svg('line', { class: v === 0 ? 'axis' : 'grid', x1: x(v), x2: x(v), y1: top, y2: height - 22 }),
      svg('text', { class: 'tick', x: x(v), y: height - 6, 'text-anchor': 'middle' }, withMinus(Math.round(v))),
    ]).flat(),
    rows.map((row, i) => {
      const y = top + (i + 0.5) * line;
      const colour = seriesColour(i);
      const [a, b] = [x(row.value - row.margin), x(row.value + row.margin)];
      return [
        svg('text', { class: 'label', x: left - 12, y: y + 4, 'text-anchor': 'end' }, svg('title', {}, row.label), shortened(row.label, most)),
        svg('line', { class: 'bar', x1: a, x2: b, y1: y, y2: y, stroke: colour }),
        svg('line', { class: 'bar', x1: a, x2: a, y1: y - 5, y2: y + 5, stroke: colour }),
        svg('line', { class: 'bar', x1: b, x2: b, y1: y - 5, y2: y + 5, stroke: colour }),
        svg('circle', { cx: x(row.value), cy: y, r: 5, fill: colour }),
      ];
    }).flat());
}

/**
 * Where a sequential test stands between its bounds.
 * @param {{log_likelihood_ratio: number, lower: number, upper: number, verdict: string, pairs: number}} test
 */
export function testGauge({ log_likelihood_ratio: ratio, lower, upper, verdict, pairs }) {
  const [width, height, side, line] = [chartWidth(), 62, 46, 26];
  const low = Math.min(lower, ratio);
  const high = Math.max(upper, ratio);
  const x = (/** @type {number} */ v) => side + ((v - low) / (high - low)) * (width - 2 * side);
  const title = `Log likelihood ratio ${ratio.toFixed(2)} after ${pairs} pairs`;
  const bound = (/** @type {number} */ value, /** @type {string} */ name, /** @type {boolean} */ met) => [
    svg('line', { class: 'axis', x1: x(value), x2: x(value), y1: line - 12, y2: line + 12 }),
    svg('text', { class: met ? 'label' : 'tick', x: x(value), y: height - 8, 'text-anchor': 'middle' },
      withMinus(`${name} ${value.toFixed(2)}`)),
  ];
  return svg('svg', { class: 'chart gauge', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title },
    svg('title', {}, title),
    svg('line', { class: 'grid', x1: x(low), x2: x(high), y1: line, y2: line }),
    svg('line', { class: 'axis', x1: x(0), x2: x(0), y1: line - 6, y2: line + 6 }),
    svg('line', { class: 'bar', x1: x(0), x2: x(ratio), y1: line, y2: line, stroke: seriesColour(0) }),
    svg('circle', { cx: x(ratio), cy: line, r: 6, fill: seriesColour(0) }),
    bound(lower, 'H0', verdict === 'h0'), bound(upper, 'H1', verdict === 'h1'));
}

/**
 * Lines over a common axis, each with a band of how sure it is.
 * @param {{label: string, points: {x: number, y: number, margin: number}[]}[]} series
 * @param {string} title
 * @param {string} below what the axis counts
 */
export function lineChart(series, title, below) {
  const all = series.flatMap((s) => s.points);
  const [lowX, highX] = [0, Math.max(1, ...all.map((p) => p.x))];
  const lowY = Math.min(...all.map((p) => p.y - p.margin), 1400);
  const highY = Math.max(...all.map((p) => p.y + p.margin), 1600);
  const [width, height, left, right, top, bottom] = [chartWidth(), 320, 48, 14, 10, 40];
  const x = (/** @type {number} */ v) => left + ((v - lowX) / (highX - lowX)) * (width - left - right);
  const y = (/** @type {number} */ v) =>
    height - bottom - ((v - lowY) / (highY - lowY)) * (height - top - bottom);
  const at = (/** @type {number} */ px, /** @type {number} */ py) => `${px.toFixed(1)} ${py.toFixed(1)}`;
  return svg('svg', { class: 'chart', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title },
    svg('title', {}, title),
    ticks(lowY, highY, 6).map((v) => [
      svg('line', { class: 'grid', x1: left, x2: width - right, y1: y(v), y2: y(v) }),
      svg('text', { class: 'tick', x: left - 8, y: y(v) + 4, 'text-anchor': 'end' }, Math.round(v)),
    ]).flat(),
    ticks(lowX, highX, width / 100).map((v) =>
      svg('text', { class: 'tick', x: x(v), y: height - bottom + 18, 'text-anchor': 'middle' }, v)),
    svg('text', { class: 'tick', x: (left + width) / 2, y: height - 4, 'text-anchor': 'middle' }, below),
    series.map(({ label, points }, i) => {
      if (points.length === 0) {
        return [];
      }
      const colour = seriesColour(i);
      const upper = points.map((p) => at(x(p.x), y(p.y + p.margin)));
      const lower = points.map((p) => at(x(p.x), y(p.y - p.margin))).reverse();
      return [
        svg('path', { d: `M${[...upper, ...lower].join('L')}Z`, fill: colour, opacity: series.length > 3 ? 0.07 : 0.14 }),
        svg('path', {
          d: `M${points.map((p) => at(x(p.x), y(p.y))).join('L')}`, class: 'line', stroke: colour,
        }, svg('title', {}, label)),
        svg('circle', { cx: x(points[points.length - 1].x), cy: y(points[points.length - 1].y), r: 3.5, fill: colour }),
      ];
    }).flat());
}
