// SPDX-License-Identifier: MIT
// Films as typed arrays: the other half of reports/motion/film.h.

async function inflated(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return (await new Response(stream).arrayBuffer());
}

// Points stand run by run, so that the past of a point is right before it. `order` lists them by frame: those of frame f are
// order[first[f]] .. order[first[f + 1] - 1].
//
// Coordinates are counted from `origin`: what they lose as 32-bit numbers is then small beside the group, wherever on Earth it is.
async function unpacked(packed, origin, dims, frames, dt) {
  const buffer = await inflated(packed.data), table = new DataView(buffer), bytes = new Uint8Array(buffer);
  const { rows, runs } = packed;
  const film = {
    rows, axes: [0, 1, 2].map(() => new Float32Array(rows)), frame: new Int32Array(rows), run: new Int32Array(rows),
    begin: new Int32Array(runs), end: new Int32Array(runs), track: new Int32Array(runs),
    first: new Int32Array(frames + 1), order: new Int32Array(rows), speed: new Float32Array(rows),
  };
  for (let k = 0, row = 0; k < runs; ++k) {
    const start = table.getUint32(12 * k + 4, true), length = table.getUint32(12 * k + 8, true);
    film.track[k] = table.getUint32(12 * k, true);
    film.begin[k] = row;
    for (let j = 0; j < length; ++j, ++row) film.run[row] = k, film.frame[row] = start + j;
    film.end[k] = row;
  }
  for (let axis = 0; axis < dims; ++axis) readAxis(film, axis, bytes, 12 * runs + 2 * rows * axis, packed.lower[axis] - origin[axis], packed.step[axis]);
  readKinds(film, bytes, 12 * runs + 2 * rows * dims);
  indexFrames(film, frames);
  measureSpeed(film, dt);
  return film;
}

function readAxis(film, axis, bytes, low, lower, step) {
  const out = film.axes[axis], high = low + film.rows;
  for (let k = 0; k < film.begin.length; ++k) {
    let code = 0;
    for (let row = film.begin[k]; row < film.end[k]; ++row) {
      code = (code + bytes[low + row] + 256 * bytes[high + row]) & 0xffff;
      out[row] = lower + step * code;
    }
  }
}

// One byte per point behind all axes, where individuals are of several kinds.
function readKinds(film, bytes, from) {
  film.kind = bytes.length > from ? bytes.subarray(from, from + film.rows) : new Uint8Array(film.rows);
}

function indexFrames(film, frames) {
  for (let row = 0; row < film.rows; ++row) ++film.first[film.frame[row] + 1];
  for (let f = 0; f < frames; ++f) film.first[f + 1] += film.first[f];
  const next = film.first.slice();
  for (let row = 0; row < film.rows; ++row) film.order[next[film.frame[row]]++] = row;
}

// Over two frames, one at the ends of a run: less of the localisation error than over one.
function measureSpeed(film, dt) {
  const [x, y, z] = film.axes;
  for (let row = 0; row < film.rows; ++row) {
    const k = film.run[row], a = Math.max(film.begin[k], row - 1), b = Math.min(film.end[k] - 1, row + 1);
    if (b > a) film.speed[row] = Math.hypot(x[b] - x[a], y[b] - y[a], z[b] - z[a]) / ((b - a) * dt);
  }
}

// What the recording says of scale: its box, the speed that few exceed, and how far a group reaches from its own middle.
function scalesOf(film, frames) {
  const lower = film.axes.map((values) => values.reduce((a, b) => Math.min(a, b), Infinity));
  const upper = film.axes.map((values) => values.reduce((a, b) => Math.max(a, b), -Infinity));
  const sorted = film.speed.slice().sort();
  const middles = middlesOf(film, frames);
  const reach = new Float32Array(film.rows);
  for (let row = 0; row < film.rows; ++row) {
    const f = 3 * film.frame[row];
    reach[row] = Math.hypot(film.axes[0][row] - middles[f], film.axes[1][row] - middles[f + 1], film.axes[2][row] - middles[f + 2]);
  }
  reach.sort();
  const at = (values, share) => values[Math.min(values.length - 1, Math.floor(share * values.length))] || 0;
  return { lower, upper, speed: at(sorted, 0.95) || 1, typical: at(sorted, 0.5), reach: at(reach, 0.99) || 1 };
}

// The middle of the group in every frame; of the nearest frame before where nobody is there.
function middlesOf(film, frames) {
  const out = new Float32Array(3 * frames);
  for (let f = 0; f < frames; ++f) {
    const count = film.first[f + 1] - film.first[f];
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let k = film.first[f]; k < film.first[f + 1]; ++k) sum += film.axes[axis][film.order[k]];
      out[3 * f + axis] = count > 0 ? sum / count : f > 0 ? out[3 * f - 3 + axis] : film.axes[axis][0] || 0;
    }
  }
  return out;
}

// The same without jolts where somebody appears or vanishes: means over some frames before and after, but never over a pause of the clock.
function smoothed(middles, clock) {
  const out = new Float32Array(middles.length), reach = 12;
  for (let f = 0; f < clock.length; ++f) {
    let a = f, b = f;
    while (a > 0 && f - a < reach && clock[a - 1] === clock[a] - 1) --a;
    while (b + 1 < clock.length && b - f < reach && clock[b + 1] === clock[b] + 1) ++b;
    const half = Math.min(f - a, b - f);  // to both sides alike, or the view would run ahead at the ends
    for (let axis = 0; axis < 3; ++axis) {
      let sum = 0;
      for (let k = f - half; k <= f + half; ++k) sum += middles[3 * k + axis];
      out[3 * f + axis] = sum / (2 * half + 1);
    }
  }
  return out;
}
