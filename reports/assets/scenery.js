// SPDX-License-Identifier: MIT
// What surrounds everybody: bodies, a round arena, and marks that attract, repel or are goals. Drawn before the individuals, so that nobody
// is hidden. The other half of fit/results/scenery.h.

const SHADES = 8;        // of the faces of bodies, from dark to light
const ROUND = 48;        // corners of a circle seen aslant
const MARK = 6;          // half the width of a mark that is a point, in pixels
const MARK_COLOURS = { attract: "#009e73", repel: "#c2185b", goal: "#7b5ea7" };
const MARK_NAMES = { attract: "attracts", repel: "repels", goal: "goal" };

// Coordinates are counted from `origin`, as those of films are. A face knows its unit normal.
async function unpackedScenery(packed, origin, dims, frames, dt) {
  if (!packed) return null;
  const from = (p) => [0, 1, 2].map((axis) => p[axis] - (axis < dims ? origin[axis] : 0));
  const ball = ({ centre, radius }) => ({ centre: from(centre), radius });
  const faces = packed.solids.flatMap(({ corners, faces }) => {
    const places = corners.map(from);
    return faces.map((face) => faceOf(face.map((k) => places[k]))).filter((face) => face !== null);
  });
  return {
    lower: from(packed.lower), upper: from(packed.upper), balls: packed.balls.map(ball), faces, arena: packed.arena ? ball(packed.arena) : null,
    marks: packed.marks || [], film: packed.take ? await unpacked(packed.take, origin, dims, frames, dt) : null,
  };
}

function faceOf(corners) {
  const [a, b, c] = corners, u = b.map((x, k) => x - a[k]), v = c.map((x, k) => x - a[k]);
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], size = Math.hypot(...n);
  if (size === 0) return null;
  const middle = [0, 1, 2].map((axis) => corners.reduce((sum, p) => sum + p[axis], 0) / corners.length);
  return { corners, middle, normal: n.map((x) => x / size) };
}

const across = (p, [x, y, z]) => p.xx * x + p.xy * y + p.xz * z + p.x0;
const down = (p, [x, y, z]) => p.yx * x + p.yy * y + p.yz * z + p.y0;
const away = (p, [x, y, z]) => p.dx * x + p.dy * y + p.dz * z;

function drawScenery(c, scenery, p, scale, frame, dims, paint) {
  c.lineWidth = 1;
  c.lineJoin = "round";
  c.setLineDash([]);
  if (scenery.arena) {
    c.strokeStyle = paint.line;
    circle(c, across(p, scenery.arena.centre), down(p, scenery.arena.centre), scenery.arena.radius * scale);
    c.stroke();
  }
  // The far ones first; of solids the faces that look at the eye.
  const shapes = scenery.balls.map((ball) => ({ depth: away(p, ball.centre), ball }));
  for (const face of scenery.faces) if (dims === 2 || away(p, face.normal) < 0) shapes.push({ depth: away(p, face.middle), face });
  shapes.sort((a, b) => b.depth - a.depth);
  for (const { ball, face } of shapes) ball ? drawBall(c, ball, p, scale, paint) : drawFace(c, face, p, dims, paint);
  if (scenery.film) drawMarks(c, scenery, p, scale, frame, dims);
}

function circle(c, x, y, radius) {
  c.beginPath();
  c.arc(x, y, Math.max(0.5, radius), 0, 7);
}

function drawBall(c, { centre, radius }, p, scale, paint) {
  circle(c, across(p, centre), down(p, centre), radius * scale);
  c.fillStyle = paint.solids[SHADES >> 1];
  c.strokeStyle = paint.soft;
  c.fill();
  c.stroke();
}

// The lighter, the more it looks up the page.
function drawFace(c, { corners, normal }, p, dims, paint) {
  c.beginPath();
  corners.forEach((place, k) => (k === 0 ? c.moveTo(across(p, place), down(p, place)) : c.lineTo(across(p, place), down(p, place))));
  c.closePath();
  const up = dims === 2 ? 0 : -(p.yx * normal[0] + p.yy * normal[1] + p.yz * normal[2]) / Math.hypot(p.yx, p.yy, p.yz);
  c.fillStyle = paint.solids[Math.min(SHADES - 1, Math.floor(SHADES * (up + 1) / 2))];
  c.strokeStyle = corners.length === 3 ? c.fillStyle : paint.line;
  c.fill();
  c.stroke();
}

function drawMarks(c, { marks, film }, p, scale, frame, dims) {
  for (let k = film.first[frame]; k < film.first[frame + 1]; ++k) {
    const row = film.order[k], place = film.axes.map((values) => values[row]), { kind, radius } = marks[film.track[film.run[row]]];
    const x = across(p, place), y = down(p, place), r = radius * scale;
    c.strokeStyle = c.fillStyle = MARK_COLOURS[kind];
    c.lineWidth = 1.5;
    c.setLineDash(radius > 0 ? [5, 3] : []);
    if (kind === "goal") {
      circle(c, x, y, r);
      c.globalAlpha = 0.12;
      c.fill();
      c.globalAlpha = 1;
      c.stroke();
    } else if (radius > 0) {
      c.beginPath();
      for (let j = 0; j <= ROUND; ++j) {
        const angle = 2 * Math.PI * j / ROUND, along = radius * Math.cos(angle), side = radius * Math.sin(angle);
        const there = dims === 3 ? [place[0] + along, place[1], place[2] + side] : [place[0] + along, place[1] + side, 0];
        j === 0 ? c.moveTo(across(p, there), down(p, there)) : c.lineTo(across(p, there), down(p, there));
      }
      c.stroke();
    } else if (kind === "attract") {
      circle(c, x, y, MARK);
      c.fill();
    } else {
      c.beginPath();
      c.moveTo(x, y - MARK), c.lineTo(x + MARK, y), c.lineTo(x, y + MARK), c.lineTo(x - MARK, y);
      c.fill();
    }
  }
  c.setLineDash([]);
}
