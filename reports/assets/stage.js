// SPDX-License-Identifier: MIT
// Draws one film at one moment on a canvas. Without perspective, so that the scale bar holds everywhere; what is far is paler and smaller.
// Nothing is allocated per frame: places are written into buffers, sorted by colour with a counting sort, and every colour is one path.

const BINS = 12;           // colours of a scale, or of tracks
const BANDS = 4;           // steps in which a tail fades
const LAYERS = 6;          // of depth
const MOST_PIECES = 9000;  // of all tails of a canvas; what several side by side may have together is twice that

const pieces = {
  ends: new Float32Array(4 * MOST_PIECES), key: new Uint8Array(MOST_PIECES), sorted: new Uint16Array(MOST_PIECES),
  start: new Int32Array(BANDS * BINS + 1),
};

// indices 0 .. n - 1 into `sorted`, by key; start[key] .. start[key + 1] are those of a key.
function countingSort(key, n, start, sorted) {
  start.fill(0);
  for (let k = 0; k < n; ++k) ++start[key[k] + 1];
  for (let k = 1; k < start.length; ++k) start[k] += start[k - 1];
  for (let k = n - 1; k >= 0; --k) sorted[--start[key[k] + 1]] = k;  // leaves start[key + 1] at the key's first
  for (let k = 1; k < start.length; ++k) start[k - 1] = start[k];
  start[start.length - 1] = n;
}

// 1, 2 or 5 times a power of ten, not above x.
function roundBelow(x) {
  const power = 10 ** Math.floor(Math.log10(x)), digit = x / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

class Stage {
  constructor(canvas, film, middles, dims, scales, unit, neighbours, scenery) {
    Object.assign(this, { canvas, film, middles, dims, scales, unit, scenery });
    this.most = Math.floor(Math.min(MOST_PIECES, 2 * MOST_PIECES / neighbours));
    this.context = canvas.getContext("2d", { alpha: false });
    let most = 1;
    for (let f = 0; f + 1 < film.first.length; ++f) most = Math.max(most, film.first[f + 1] - film.first[f]);
    this.heads = {
      place: new Float32Array(5 * most), key: new Uint8Array(most), sorted: new Uint32Array(most), start: new Int32Array(LAYERS * BINS + 1),
    };
    this.crowd = most;
    this.middle = [0, 0, 0];
    this.bySpeed = new Uint8Array(film.rows);
    for (let row = 0; row < film.rows; ++row) this.bySpeed[row] = Math.min(BINS - 1, Math.floor(BINS * film.speed[row] / scales.speed));
    this.fit();
  }

  // As many device pixels as the canvas covers, at most two per length of the style sheet.
  fit() {
    const ratio = Math.min(2, devicePixelRatio || 1), box = this.canvas.getBoundingClientRect();
    this.width = Math.max(1, box.width);
    this.height = Math.max(1, box.height);
    const across = Math.round(this.width * ratio), down = Math.round(this.height * ratio);
    if (this.canvas.width !== across || this.canvas.height !== down) this.canvas.width = across, this.canvas.height = down;
    this.context.setTransform(across / this.width, 0, 0, down / this.height, 0, 0);
  }

  // Pixels per unit that show the whole box, or the whole group.
  fullScale(follow) {
    const { lower, upper, reach } = this.scales, margin = 14;
    const across = this.width - 2 * margin, down = this.height - 2 * margin - 14;
    if (follow) return Math.min(across, down) / (2.2 * reach);
    if (this.dims === 2) return Math.min(across / (upper[0] - lower[0] || 1), down / (upper[1] - lower[1] || 1));
    const half = Math.hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]) / 2 || 1;
    return (this.scenery ? 1 : 1.15) * Math.min(across, down) / (2 * half);
  }

  middleAt(position, axis) {
    const f = Math.floor(position), m = this.middles, a = m[3 * f + axis], b = 3 * f + 3 < m.length ? m[3 * f + 3 + axis] : a;
    return a + (position - f) * (b - a);
  }

  // From the world to the canvas: to the right, downwards, and away from the eye.
  look(position, view) {
    const scale = view.zoom * this.fullScale(view.follow), { lower, upper } = this.scales;
    for (let axis = 0; axis < 3; ++axis) this.middle[axis] = view.follow ? this.middleAt(position, axis) : (lower[axis] + upper[axis]) / 2;
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth), ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
    const flat = this.dims === 2;
    const p = this.projection = flat
      ? { xx: scale, xy: 0, xz: 0, yx: 0, yy: -scale, yz: 0, dx: 0, dy: 0, dz: 0 }
      : { xx: -sa * scale, xy: ca * scale, xz: 0, yx: se * ca * scale, yy: se * sa * scale, yz: -ce * scale, dx: -ce * ca, dy: -ce * sa, dz: -se };
    const [x, y, z] = this.middle;
    p.x0 = this.width / 2 + view.x * this.width - (p.xx * x + p.xy * y + p.xz * z);
    p.y0 = (this.height - 14) / 2 + view.y * this.width - (p.yx * x + p.yy * y + p.yz * z);
    p.d0 = -(p.dx * x + p.dy * y + p.dz * z);
    this.scale = scale;
  }

  draw(position, view, paint) {
    const c = this.context;
    c.fillStyle = paint.page;
    c.fillRect(0, 0, this.width, this.height);
    this.look(position, view);
    if (!view.follow) this.drawBox(paint);
    if (this.scenery) drawScenery(this.context, this.scenery, this.projection, this.scale, Math.floor(position), this.dims, paint);
    if (view.tail > 0) this.drawTails(position, view, paint);
    this.drawHeads(position, view, paint);
    this.drawScale(paint);
    if (this.dims === 3) this.drawAxes(paint);
  }

  binOf(row, view) {
    if (view.colour === "kind") return this.film.kind[row] % BINS;
    return view.colour === "track" ? this.film.track[this.film.run[row]] % BINS : this.bySpeed[row];
  }

  drawTails(position, view, paint) {
    const n = this.collectPieces(position, view), c = this.context, { ends, key, sorted, start } = pieces;
    countingSort(key, n, start, sorted);
    const large = this.crowd > 200;  // round ends and joints take time, and are not seen on thin lines
    c.lineWidth = large ? 1 : 1.4;
    c.lineCap = large ? "butt" : "round";
    c.lineJoin = large ? "bevel" : "round";
    for (let colour = 0; colour < BANDS * BINS; ++colour) {
      if (start[colour] === start[colour + 1]) continue;
      c.strokeStyle = paint.tails[colour];
      c.beginPath();
      for (let k = start[colour]; k < start[colour + 1]; ++k) {
        const at = 4 * sorted[k];
        // A piece that begins where the last one ended goes on with it.
        if (k === start[colour] || ends[at] !== ends[4 * sorted[k - 1] + 2] || ends[at + 1] !== ends[4 * sorted[k - 1] + 3]) c.moveTo(ends[at], ends[at + 1]);
        c.lineTo(ends[at + 2], ends[at + 3]);
      }
      c.stroke();
    }
  }

  // From the oldest point of every tail to its head. Large groups get fewer points, at frames that are the same from picture to picture.
  collectPieces(position, view) {
    const { film } = this, f = Math.floor(position), part = position - f, [x, y, z] = film.axes, p = this.projection;
    const count = film.first[f + 1] - film.first[f];
    const knots = Math.max(2, Math.min(view.tail, Math.floor(this.most / Math.max(1, count)) - 1)), stride = Math.ceil(view.tail / knots);
    let n = 0;
    for (let k = film.first[f]; k < film.first[f + 1]; ++k) {
      const head = film.order[k], run = film.run[head], oldest = Math.max(film.begin[run], head - view.tail);
      let px = 0, py = 0, pen = false;
      for (let row = oldest; row <= head && n < MOST_PIECES;) {
        const qx = p.xx * x[row] + p.xy * y[row] + p.xz * z[row] + p.x0, qy = p.yx * x[row] + p.yy * y[row] + p.yz * z[row] + p.y0;
        if (pen) n = this.addPiece(n, px, py, qx, qy, head - row, view, this.binOf(row, view));
        px = qx, py = qy, pen = true;
        row = row === head ? row + 1 : Math.min(head, row + stride - film.frame[row] % stride);
      }
      if (part > 0 && head + 1 < film.end[run] && n < MOST_PIECES) {
        const r = head + 1, hx = x[head] + part * (x[r] - x[head]), hy = y[head] + part * (y[r] - y[head]), hz = z[head] + part * (z[r] - z[head]);
        n = this.addPiece(n, px, py, p.xx * hx + p.xy * hy + p.xz * hz + p.x0, p.yx * hx + p.yy * hy + p.yz * hz + p.y0, 0, view, this.binOf(head, view));
      }
    }
    return n;
  }

  addPiece(n, ax, ay, bx, by, age, view, bin) {
    const { ends, key } = pieces, at = 4 * n;
    ends[at] = ax, ends[at + 1] = ay, ends[at + 2] = bx, ends[at + 3] = by;
    key[n] = BINS * (BANDS - 1 - Math.min(BANDS - 1, Math.floor(BANDS * age / (view.tail + 1)))) + bin;
    return n + 1;
  }

  // Arrowheads along the motion on the canvas; the far ones first.
  drawHeads(position, view, paint) {
    const n = this.collectHeads(position, view), c = this.context, { place, key, sorted, start } = this.heads;
    countingSort(key, n, start, sorted);
    const size = Math.max(this.crowd > 200 ? 2.6 : 3.6, Math.min(5.5, 0.014 * this.width * Math.sqrt(60 / Math.max(60, this.crowd)) * Math.max(0.8, Math.min(2, Math.sqrt(view.zoom)))));
    const outlined = this.crowd <= 300;
    c.strokeStyle = paint.page;
    c.lineWidth = 0.8;
    for (let colour = 0; colour < LAYERS * BINS; ++colour) {
      if (start[colour] === start[colour + 1]) continue;
      const s = this.dims === 2 ? size : size * (0.78 + 0.44 * Math.floor(colour / BINS) / (LAYERS - 1));
      c.fillStyle = paint.heads[colour];
      c.beginPath();
      for (let k = start[colour]; k < start[colour + 1]; ++k) {
        const at = 5 * sorted[k], px = place[at], py = place[at + 1], ux = s * place[at + 2], uy = s * place[at + 3];
        if (ux === 0 && uy === 0) {
          c.moveTo(px + 0.6 * s, py);
          c.arc(px, py, 0.6 * s, 0, 7);
        } else {
          c.moveTo(px + 1.35 * ux, py + 1.35 * uy);
          c.lineTo(px - ux - 0.72 * uy, py - uy + 0.72 * ux);
          c.lineTo(px - 0.55 * ux, py - 0.55 * uy);
          c.lineTo(px - ux + 0.72 * uy, py - uy - 0.72 * ux);
          c.closePath();
        }
      }
      c.fill();
      if (outlined) c.stroke();
    }
  }

  // Place, direction and depth of everybody, between two frames where the position is.
  collectHeads(position, view) {
    const { film } = this, f = Math.floor(position), part = position - f, [x, y, z] = film.axes, p = this.projection, { place, key } = this.heads;
    let n = 0, nearest = Infinity, farthest = -Infinity;
    for (let k = film.first[f]; k < film.first[f + 1]; ++k) {
      const row = film.order[k], run = film.run[row], next = Math.min(film.end[run] - 1, row + 1), before = Math.max(film.begin[run], row - 1);
      const wx = x[row] + part * (x[next] - x[row]), wy = y[row] + part * (y[next] - y[row]), wz = z[row] + part * (z[next] - z[row]);
      const vx = x[next] - x[before], vy = y[next] - y[before], vz = z[next] - z[before];
      const ux = p.xx * vx + p.xy * vy + p.xz * vz, uy = p.yx * vx + p.yy * vy + p.yz * vz, length = Math.hypot(ux, uy), at = 5 * n;
      place[at] = p.xx * wx + p.xy * wy + p.xz * wz + p.x0;
      place[at + 1] = p.yx * wx + p.yy * wy + p.yz * wz + p.y0;
      place[at + 2] = length > 0 ? ux / length : 0;
      place[at + 3] = length > 0 ? uy / length : 0;
      place[at + 4] = p.dx * wx + p.dy * wy + p.dz * wz;
      const depth = place[at + 4];  // as stored, in 32 bits, or the farthest one would lie beyond itself
      nearest = Math.min(nearest, depth);
      farthest = Math.max(farthest, depth);
      key[n++] = this.binOf(row, view);
    }
    const layers = farthest > nearest ? (LAYERS - 0.001) / (farthest - nearest) : 0;
    for (let k = 0; k < n; ++k) key[k] += BINS * (layers > 0 ? Math.floor(layers * (farthest - place[5 * k + 4])) : LAYERS - 1);
    return n;
  }

  // The recording's bounding box: of a rectangle four sides, of a cuboid the nine edges that face away are enough to see where it is.
  drawBox(paint) {
    const { lower, upper } = this.scales, p = this.projection, c = this.context;
    const corner = (i, j, k) => {
      const x = i ? upper[0] : lower[0], y = j ? upper[1] : lower[1], z = k ? upper[2] : lower[2];
      return [p.xx * x + p.xy * y + p.xz * z + p.x0, p.yx * x + p.yy * y + p.yz * z + p.y0];
    };
    const line = (a, b) => (c.moveTo(...a), c.lineTo(...b));
    // Of each pair of parallel faces the one farther from the eye.
    const far = [p.dx > 0 ? 1 : 0, p.dy > 0 ? 1 : 0, p.dz > 0 ? 1 : 0];
    c.strokeStyle = paint.line;
    c.lineWidth = 1;
    c.beginPath();
    for (let axis = 0; axis < 3; ++axis) {
      for (let k = 0; k < 4; ++k) {
        const a = [0, 0, 0], u = (axis + 1) % 3, v = (axis + 2) % 3;
        a[u] = k & 1, a[v] = k >> 1;
        if (this.dims === 3 ? a[u] !== far[u] && a[v] !== far[v] : axis === 2 || a[2] !== 0) continue;
        const b = a.slice();
        b[axis] = 1;
        line(corner(...a), corner(...b));
      }
    }
    c.stroke();
  }

  drawScale(paint) {
    const c = this.context, length = roundBelow(this.width / 5 / this.scale), x = 10, y = this.height - 10;
    c.fillStyle = c.strokeStyle = paint.soft;
    c.lineWidth = 2;
    c.lineCap = "butt";
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + length * this.scale, y);
    c.stroke();
    c.font = paint.font;
    c.textBaseline = "middle";
    c.textAlign = "left";
    c.fillText(`${Number(length.toPrecision(3))} ${this.unit}`, x + length * this.scale + 6, y);
  }

  drawAxes(paint) {
    const c = this.context, p = this.projection, x = this.width - 26, y = this.height - 26, reach = 15 / this.scale;
    const axes = [["x", p.xx, p.yx], ["y", p.xy, p.yy], ["z", p.xz, p.yz]];
    c.strokeStyle = c.fillStyle = paint.soft;
    c.lineWidth = 1;
    c.textAlign = "center";
    c.beginPath();
    for (const [, ax, ay] of axes) c.moveTo(x, y), c.lineTo(x + reach * ax, y + reach * ay);
    c.stroke();
    for (const [name, ax, ay] of axes) if (Math.hypot(ax, ay) * reach > 3) c.fillText(name, x + 1.5 * reach * ax, y + 1.5 * reach * ay);
  }
}
