// SPDX-License-Identifier: MIT
// Players: films side by side with one clock, one view and one set of controls. Text from data goes through textContent only.

const RATES = [1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16, 32, 64, 128, 256];
const START = { azimuth: Math.PI / 6, elevation: Math.PI * 25 / 180, zoom: 1, x: 0, y: 0 };

// Plasma (Smith and van der Walt 2015): equal steps look equal, also to colour-blind readers. Dark or light ends fade into the page, so
// they are left out.
const PLASMA = [[13, 8, 135], [75, 3, 161], [125, 3, 168], [168, 34, 150], [203, 70, 121], [229, 107, 93], [248, 148, 65], [253, 195, 40], [240, 249, 33]];
const TRACKS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#9a8700", "#8b5fbf", "#b5485d", "#3f8f3f", "#5b7fa6", "#a0522d"];

const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const still = matchMedia("(prefers-reduced-motion: reduce)");

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) name === "text" ? (element.textContent = value) : element.setAttribute(name, value);
  element.append(...children);
  return element;
}

const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
const mixed = (a, b, share) => a.map((value, k) => value + share * (b[k] - value));
const written = (colour) => `rgb(${colour.map(Math.round).join(",")})`;

// Colour k of n along the scale, for pages light or dark.
function plasma(share, dark) {
  const at = (dark ? 0.3 + 0.7 * share : 0.02 + 0.76 * share) * (PLASMA.length - 1), k = Math.min(PLASMA.length - 2, Math.floor(at));
  return mixed(PLASMA[k], PLASMA[k + 1], at - k);
}

// All colours of one theme, so that drawing mixes none.
function paintOf(colour) {
  const page = rgb(style("--page")), dark = page[0] < 128;
  const scale = [...Array(BINS).keys()].map((k) => (colour !== "speed" ? mixed(rgb(TRACKS[k]), [255, 255, 255], dark ? 0.25 : 0) : plasma(k / (BINS - 1), dark)));
  const faded = (steps, most) => [...Array(steps).keys()].flatMap((step) => scale.map((c) => written(mixed(c, page, most * (1 - step / (steps - 1))))));
  return {
    page: style("--page"), line: style("--line"), soft: style("--soft"), font: `12px ${getComputedStyle(document.body).fontFamily}`,
    solids: [...Array(SHADES).keys()].map((k) => written(mixed(page, dark ? [255, 255, 255] : [70, 64, 50], dark ? 0.12 + 0.16 * k / (SHADES - 1) : 0.34 - 0.22 * k / (SHADES - 1)))),
    scale: scale.map(written), heads: faded(LAYERS, 0.45), tails: faded(BANDS, 0.82),
  };
}

function number(x) { return String(Number(x.toPrecision(3))); }

class Player {
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.clock = data.clock.flatMap(([first, count]) => Array.from({ length: count }, (_, k) => first + k));
    this.position = 0;
    this.playing = false;
    // Whether points are recorded or synthetic, sheep or dog, is what one wants to see first.
    this.view = { ...START, tail: 0, colour: data.kinds.length > 1 ? "kind" : "speed", follow: false };
    this.stages = [];
    this.tick = this.tick.bind(this);
  }

  async open() {
    const { dims, dt, takes } = this.data, frames = this.clock.length;
    const films = await Promise.all(takes.map((take) => unpacked(take, takes[0].lower, dims, frames, dt)));
    const scales = scalesOf(films[0], frames);
    this.scales = scales;
    const across = Math.hypot(...scales.upper.map((u, k) => u - scales.lower[k]));
    this.scenery = await unpackedScenery(this.data.scenery, takes[0].lower, dims, frames, dt);
    if (this.scenery) this.embrace(this.scenery);
    const bodies = this.scenery !== null && this.scenery.balls.length + this.scenery.faces.length > 0;
    this.view.follow = across > 6 * scales.reach && !bodies;
    this.view.tail = this.usualTail(films[0], across);
    this.longest = Math.max(this.view.tail, Math.min(300, frames - 1));
    this.rate = this.usualRate();
    this.build(films);
    this.repaint();
    this.watch();
  }

  // The picture holds the scenery, too.
  embrace({ lower, upper }) {
    this.scales.lower = this.scales.lower.map((x, k) => Math.min(x, lower[k]));
    this.scales.upper = this.scales.upper.map((x, k) => Math.max(x, upper[k]));
  }

  // In frames: across a fifth of the picture, less in a crowd, where long tails hide everybody and take time.
  usualTail(film, across) {
    let crowd = 1;
    for (let f = 0; f < this.clock.length; ++f) crowd = Math.max(crowd, film.first[f + 1] - film.first[f]);
    const { reach, typical } = this.scales, far = 0.22 * Math.min(across, 4 * reach) * Math.min(1, Math.sqrt(100 / crowd));
    return Math.round(Math.max(3, Math.min(150, this.clock.length / 3, far / (typical * this.data.dt || Infinity))));
  }

  // A film should last some 15 seconds, and motion be neither a blur nor a crawl.
  usualRate() {
    const whole = this.clock.length * this.data.dt;
    return RATES.reduce((best, rate) => (Math.abs(Math.log(whole / rate / 15)) < Math.abs(Math.log(whole / best / 15)) ? rate : best), 1);
  }

  build(films) {
    const stage = make("div", {
      class: "stage", tabindex: "0", role: "application",
      "aria-label": `Player. Space: play or pause. Comma and full stop: one frame back or on. ${this.data.dims === 3 ? "Arrow keys: turn." : "Arrow keys: move."} Plus and minus: zoom. 0: as at first.`,
    });
    this.data.takes.forEach((take, k) => {
      const canvas = make("canvas", { role: "img" });
      canvas.setAttribute("aria-label", `Moving picture: ${take.title}`);
      const title = make("figcaption", {}, this.keyOf(take.series), take.title);
      if (films[k].rows === 0) title.append(" (no frames: the simulation diverged)");
      stage.append(make("figure", {}, canvas, title));
    });
    this.stage = stage;
    this.root.append(this.controls(), stage, this.legend());
    this.shape();
    this.stages = [...stage.querySelectorAll("canvas")].map((canvas, k) =>
      new Stage(canvas, films[k], smoothed(middlesOf(films[k], this.clock.length), this.clock), this.data.dims, this.scales, this.data.unit, films.length, this.scenery));
    this.listen();
  }

  // The line sample that the charts know a model by.
  keyOf(series) {
    if (series < 0) return "";
    const sample = document.querySelector(`#legend input[data-model="${series}"] ~ svg.key`);
    return sample ? sample.cloneNode(true) : "";
  }

  // Two-dimensional motion in a canvas of its own proportions.
  shape() {
    const { lower, upper } = this.scales, ratio = this.data.dims === 2 && !this.view.follow ? (upper[0] - lower[0]) / (upper[1] - lower[1] || 1) : 5 / 4;
    this.stage.classList.toggle("tall", ratio < 0.8);
    for (const canvas of this.stage.querySelectorAll("canvas")) canvas.style.aspectRatio = String(Math.max(0.4, Math.min(2.6, ratio)));
  }

  controls() {
    const { clock } = this, option = (value, text) => make("option", { value, text });
    this.button = make("button", { type: "button", class: "play", text: "Play" });
    this.scrub = make("input", { type: "range", min: 0, max: clock.length - 1, step: 1, value: 0, "aria-label": "Time" });
    this.time = make("output", { class: "time" });
    this.speed = make("select", {}, ...RATES.map((rate) => option(rate, `${rate < 1 ? `1/${1 / rate}` : rate} ×`)));
    this.speed.value = this.rate;
    this.colour = make("select", {}, option("speed", "speed"), option("track", "individual"),
      ...(this.data.kinds.length > 1 ? [option("kind", "kind")] : []));
    this.colour.value = this.view.colour;
    this.tail = make("input", { type: "range", min: 0, max: this.longest, step: 1, value: this.view.tail });
    this.tailText = make("output");
    this.follow = make("input", { type: "checkbox" });
    this.follow.checked = this.view.follow;
    this.reset = make("button", { type: "button", text: "Reset view" });
    const label = (text, ...controls) => make("label", {}, make("span", { text }), ...controls);
    return make("div", { class: "controls", role: "group", "aria-label": "Player controls" },
      make("div", { class: "row" }, this.button, this.scrub, this.time),
      make("div", { class: "row" }, label("pace ", this.speed), label("colour ", this.colour), label("tails ", this.tail, this.tailText),
        label("follow the group ", this.follow), this.reset));
  }

  legend() {
    this.strip = make("canvas", { width: 12 * BINS, height: 10, class: "strip", role: "img", "aria-label": "Colours from slow to fast" });
    this.key = make("p", { class: "note key-of-colours" }, "0 ", this.strip, ` ${number(this.scales.speed)} ${this.data.unit}/s and faster`);
    const turn = this.data.dims === 3 ? "drag to turn, with Shift to move" : "drag to move";
    this.kinds = make("p", { class: "note key-of-kinds" }, ...this.data.kinds.flatMap((name, k) => {
      const dot = make("span", { class: "dot", text: "● " });
      dot.style.color = TRACKS[k % TRACKS.length];
      return [dot, `${name} `];
    }));
    return make("div", {}, this.key, this.kinds, ...this.signs(), make("p", {
      class: "note hint", text: `In the pictures: ${turn}; Ctrl and the wheel, or the wheel after a click, to zoom. Keys: space, comma and full stop, + and −, 0, arrows.` }));
  }

  // What the marks and bodies of the scenery mean.
  signs() {
    if (!this.scenery) return [];
    const { marks, balls, faces } = this.scenery, kinds = Object.keys(MARK_NAMES).filter((kind) => marks.some((mark) => mark.kind === kind));
    const sign = (text, colour, name) => {
      const dot = make("span", { class: "dot", text });
      dot.style.color = colour;
      return [dot, ` ${name} `];
    };
    const shown = { attract: "●", repel: "◆", goal: "◌" };
    const all = kinds.flatMap((kind) => sign(shown[kind], MARK_COLOURS[kind], MARK_NAMES[kind]));
    if (balls.length + faces.length > 0) all.push(...sign("■", "#a9a59c", "obstacle; nobody is hidden behind one"));
    return all.length > 0 ? [make("p", { class: "note key-of-signs" }, ...all)] : [];
  }

  listen() {
    const input = (element, act) => element.addEventListener("input", () => (act(), this.show()));
    this.button.addEventListener("click", () => this.play(!this.playing));
    input(this.scrub, () => this.jump(Number(this.scrub.value)));
    input(this.speed, () => (this.rate = Number(this.speed.value)));
    input(this.colour, () => ((this.view.colour = this.colour.value), this.repaint()));
    input(this.tail, () => (this.view.tail = Number(this.tail.value)));
    input(this.follow, () => ((this.view.follow = this.follow.checked), this.centre()));
    this.reset.addEventListener("click", () => (Object.assign(this.view, START), this.show()));
    this.stage.addEventListener("keydown", (event) => this.press(event));
    this.stage.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.stage.addEventListener("pointerdown", (event) => this.drag(event));
  }

  watch() {
    const refit = () => (this.stages.forEach((stage) => stage.fit()), this.show());
    new ResizeObserver(refit).observe(this.stage);
    for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", () => this.repaint());
    // What has not begun looks alike everywhere: print shows the middle of the film, with tails.
    addEventListener("beforeprint", () => (this.position === 0 ? (this.jump(Math.floor(this.clock.length / 2)), this.show()) : this.play(false)));
    const pictures = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => (this.stages.find((s) => s.canvas === target).seen = isIntersecting)));
    this.stages.forEach((stage) => pictures.observe(stage.canvas));
    let begun = still.matches || this.clock.length < 2;
    if (still.matches) this.jump(Math.floor(this.clock.length / 2)), this.show();
    new IntersectionObserver(([entry]) => {
      this.seen = entry.isIntersecting;
      if (this.seen && !begun) (begun = true), this.play(true);
      else if (this.seen && this.playing) this.play(true);
    }).observe(this.stage);
  }

  centre() {
    Object.assign(this.view, { zoom: 1, x: 0, y: 0 });
    this.shape();
  }

  repaint() {
    this.paint = paintOf(this.view.colour);
    const c = this.strip.getContext("2d");
    this.paint.scale.forEach((colour, k) => ((c.fillStyle = colour), c.fillRect(12 * k, 0, 12, 10)));
    this.key.hidden = this.view.colour !== "speed";
    this.kinds.hidden = this.view.colour !== "kind";
    this.stages.forEach((stage) => stage.fit());
    this.show();
  }

  play(on) {
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    if (!on) this.position = Math.floor(this.position);
    this.last = undefined;
    cancelAnimationFrame(this.next);
    if (on) this.next = requestAnimationFrame(this.tick);
    else this.show();
  }

  // Out of sight nothing is drawn; the clock goes on when the stage comes back.
  tick(now) {
    if (!this.playing || !this.seen) return;
    const passed = this.last === undefined ? 0 : Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    this.position = (this.position + passed * this.rate / this.data.dt) % Math.max(1, this.clock.length - 1);
    this.show();
    this.next = requestAnimationFrame(this.tick);
  }

  show() {
    const f = Math.floor(this.position), seconds = ((this.clock[f] - this.clock[0]) * this.data.dt);
    this.scrub.value = f;
    this.time.textContent = `${seconds.toFixed(2)} s · frame ${this.clock[f]}`;
    this.scrub.setAttribute("aria-valuetext", `${seconds.toFixed(2)} seconds`);
    this.tailText.textContent = ` ${number(this.view.tail * this.data.dt)} s`;
    for (const stage of this.stages) if (stage.seen || !this.playing) stage.draw(this.position, this.view, this.paint);
  }

  jump(frame) {
    this.play(false);
    this.position = Math.max(0, Math.min(this.clock.length - 1, frame));
  }

  step(frames) { this.jump(Math.floor(this.position) + frames); }

  turn(azimuth, elevation) {
    if (this.data.dims === 2) return this.move(-azimuth / 4, -elevation / 4);
    this.view.azimuth -= azimuth;
    this.view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.view.elevation + elevation));
  }

  move(x, y) {
    this.view.x += x;
    this.view.y += y;
  }

  // About a point of a canvas, in widths of it from the middle.
  zoom(factor, x = 0, y = 0) {
    const zoom = Math.max(0.1, Math.min(200, this.view.zoom * factor)), by = zoom / this.view.zoom;
    this.view.x = x + (this.view.x - x) * by;
    this.view.y = y + (this.view.y - y) * by;
    this.view.zoom = zoom;
  }

  press(event) {
    const act = {
      " ": () => this.play(!this.playing), ",": () => this.step(-1), ".": () => this.step(1), Home: () => this.step(-this.clock.length),
      End: () => this.step(this.clock.length), ArrowLeft: () => this.turn(-0.1, 0), ArrowRight: () => this.turn(0.1, 0),
      ArrowUp: () => this.turn(0, 0.1), ArrowDown: () => this.turn(0, -0.1), "+": () => this.zoom(1.2), "=": () => this.zoom(1.2),
      "-": () => this.zoom(1 / 1.2), 0: () => Object.assign(this.view, START),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
    this.show();
  }

  // The page scrolls under the wheel until the pictures are meant.
  wheel(event) {
    if (!event.ctrlKey && !this.stage.contains(document.activeElement)) return;
    event.preventDefault();
    const box = (event.target.closest("canvas") || this.stage.querySelector("canvas")).getBoundingClientRect();
    this.zoom(Math.exp(-0.0015 * event.deltaY), (event.clientX - box.left - box.width / 2) / box.width, (event.clientY - box.top - box.height / 2) / box.width);
    this.show();
  }

  drag(event) {
    const canvas = event.target.closest("canvas");
    if (!canvas || event.button > 1) return;
    const width = canvas.getBoundingClientRect().width, shift = this.data.dims === 2 || event.shiftKey || event.button === 1;
    let { clientX: x, clientY: y } = event;
    canvas.setPointerCapture(event.pointerId);
    const move = (to) => {
      const dx = (to.clientX - x) / width, dy = (to.clientY - y) / width;
      x = to.clientX, y = to.clientY;
      shift ? this.move(dx, dy) : this.turn(3 * dx, 3 * dy);
      this.show();
    };
    const end = () => ["pointermove", "pointerup", "pointercancel"].forEach((name, k) => canvas.removeEventListener(name, k === 0 ? move : end));
    ["pointermove", "pointerup", "pointercancel"].forEach((name, k) => canvas.addEventListener(name, k === 0 ? move : end));
  }
}

for (const root of document.querySelectorAll(".player")) {
  const fail = (why) => root.append(make("p", { class: "note", text: `The player cannot show this: ${why}` }));
  if (typeof DecompressionStream === "undefined") fail("the browser has no DecompressionStream; any from 2023 on has.");
  else new Player(root, JSON.parse(root.querySelector("script").textContent)).open().catch((error) => fail(error.message));
}
