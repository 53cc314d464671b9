// A screenshot with fewer colours, so that it takes less room: Chromium writes 24 bits a pixel, of
// which smooth gradients need the upper ones.
//
//   const smaller = coarser(png, 4);   // levels of each colour 4 apart
import { deflateSync, inflateSync } from 'node:zlib';

const table = [...Array(256).keys()].map((n) => {
  let c = n;
  for (let i = 0; i < 8; ++i) {
    c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  }
  return c >>> 0;
});
function crc32(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) {
    c = table[(c ^ byte) & 0xff] ^ (c >>> 8);
  }
  return (c ^ 0xffffffff) >>> 0;
}

function paeth(a, b, c) {
  const p = a + b - c;
  const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

const predictors = [() => 0, (a) => a, (a, b) => b, (a, b) => (a + b) >> 1, paeth];

function chunksOf(png) {
  const chunks = [];
  for (let at = 8; at < png.length;) {
    const length = png.readUInt32BE(at);
    chunks.push({ type: png.toString('latin1', at + 4, at + 8), data: png.subarray(at + 8, at + 8 + length) });
    at += 12 + length;
  }
  return chunks;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc32(body), body.length + 4);
  return out;
}

/** Undoes the rows' filters (PNG, 9.2). */
function unfiltered(raw, width, height, size) {
  const row = width * size;
  const pixels = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const predict = predictors[raw[y * (row + 1)]];
    for (let x = 0; x < row; ++x) {
      const a = x >= size ? pixels[y * row + x - size] : 0;
      const b = y > 0 ? pixels[(y - 1) * row + x] : 0;
      const c = x >= size && y > 0 ? pixels[(y - 1) * row + x - size] : 0;
      pixels[y * row + x] = raw[y * (row + 1) + 1 + x] + predict(a, b, c);
    }
  }
  return pixels;
}

export function coarser(png, step) {
  const chunks = chunksOf(png);
  const head = chunks.find((c) => c.type === 'IHDR').data;
  const [width, height] = [head.readUInt32BE(0), head.readUInt32BE(4)];
  const size = head[9] === 6 ? 4 : 3;
  const raw = inflateSync(Buffer.concat(chunks.filter((c) => c.type === 'IDAT').map((c) => c.data)));
  const pixels = unfiltered(raw, width, height, size);
  // Three bytes a pixel, a page has no transparency; rows as differences to the row above.
  const row = width * 3;
  const out = Buffer.alloc((row + 1) * height);
  const level = (value) => Math.min(255, Math.round(value / step) * step);
  for (let y = 0; y < height; ++y) {
    out[y * (row + 1)] = 2;
    for (let x = 0; x < row; ++x) {
      const at = (line) => level(pixels[(line * width + Math.floor(x / 3)) * size + (x % 3)]);
      out[y * (row + 1) + 1 + x] = at(y) - (y > 0 ? at(y - 1) : 0);
    }
  }
  const header = Buffer.from(head);
  header[9] = 2;
  return Buffer.concat([png.subarray(0, 8), chunk('IHDR', header),
    chunk('IDAT', deflateSync(out, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}
