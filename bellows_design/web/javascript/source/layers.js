/* The layers of a print: a picture from above, a slider over the layers, marks of leaks and seals. */

import { element, onThemeChange, shadowOf } from "./dom.js";
import { shortNumber } from "./colours.js";
import { ScaleBar } from "./overlay.js";
import { airColour, colourOf, drawAir, drawBeads, runsOf } from "./print.js";
import { LAYERS_STYLE } from "./style.js";

const MARGIN = 26;
const CLOSE = 12; // mm across the smaller side of the picture, at a mark
const SIGNS = { fail: "✕", warn: "!", info: "•" };

/**
 * A picture of layers in `host`, an element of the page.
 *
 * Options: `height` in pixels (420), `label` for screen readers. Events: "layer", "view".
 */
export class Layers extends EventTarget {
  constructor(host, options = {}) {
    super();
    this.host = host;
    this.options = { height: 420, label: "Layers of the print", ...options };
    this.layer = 0;
    this.fit = null;
    this.buildPage();
    this.pointers = new Map();
    this.listen();
    this.endTheme = onThemeChange(this.host, () => this.invalidate());
  }

  buildPage() {
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.legend = element("div", { class: "kinds", role: "group", "aria-label": "Kinds of beads" });
    this.scaleBar = new ScaleBar();
    this.stage = element(
      "div",
      { class: "stage", tabindex: 0, role: "application", "aria-roledescription": "layer view",
        "aria-label": this.options.label, "aria-describedby": "keys", part: "stage" },
      this.canvas, this.legend, this.scaleBar.root,
      element("span", { class: "hidden-text", id: "keys" },
        "Arrow keys move, plus and minus zoom, square brackets change the layer, R shows all."),
    );
    this.stage.style.height = `${this.options.height}px`;
    this.slider = element("input", { type: "range", min: 0, step: 1, "aria-label": "Layer",
      oninput: () => this.setLayer(this.slider.valueAsNumber) });
    this.reading = element("output", { class: "reading", "aria-live": "off" });
    this.marks = element("div", { class: "group marks" });
    this.bar = element("div", { class: "bar", part: "bar" },
      element("div", { class: "group frames" }, element("span", { class: "quiet" }, "Layer"), this.slider, this.reading),
      this.marks,
      element("button", { type: "button", title: "Whole layer (R)", onclick: () => this.resetView() }, "Whole layer"));
    shadowOf(this.host, LAYERS_STYLE).append(element("div", { class: "frame", part: "frame" }, this.stage, this.bar));
  }

  listen() {
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.stage);
    const on = (name, what, options) => this.stage.addEventListener(name, what, options);
    on("keydown", (event) => this.onKey(event));
    on("wheel", (event) => this.onWheel(event), { passive: false });
    on("pointerdown", (event) => this.onPointer(event, true));
    on("pointermove", (event) => this.onMove(event));
    for (const name of ["pointerup", "pointercancel"]) on(name, (event) => this.onPointer(event, false));
  }

  /** Show layers from `Bellows.unpackLayers`, at first the layer of this number. */
  show(layers, { layer = 0 } = {}) {
    this.data = layers;
    this.slider.max = layers.tops.length - 1;
    this.marks.replaceChildren(...layers.marks.map((mark) => this.markButton(mark)));
    this.setLayer(layer);
    this.resetView();
  }

  markButton(mark) {
    const sign = element("b", { "aria-hidden": "true" }, SIGNS[mark.severity]);
    return element("button", { type: "button", class: `mark ${mark.severity}`, title: "Go there",
      onclick: () => this.goTo(mark) }, sign, ` ${mark.text}`);
  }

  /** Show layer `number`, from 0. */
  setLayer(number) {
    const last = this.data.tops.length - 1;
    this.layer = Math.min(Math.max(Math.round(number), 0), last);
    this.slider.value = this.layer;
    const text = `${this.layer + 1} of ${last + 1}, top at ${this.data.tops[this.layer].toFixed(2)} mm`;
    this.reading.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
    this.showKinds();
    this.invalidate();
    this.tell("layer");
  }

  showKinds() {
    const kinds = new Set();
    for (const { kind } of runsOf(this.data, this.layer)) kinds.add(kind);
    this.kinds = this.data.kind_names.filter((name) => kinds.has(name));
    const { air } = this.data;
    const names = air && air.layer === this.layer ? air.names.filter((name) => airColour(name)) : [];
    const swatch = (name, colour) => {
      const box = element("i", { class: "swatch" });
      box.style.background = colour;
      return element("span", {}, box, name);
    };
    this.legend.replaceChildren(
      ...this.kinds.map((name) => swatch(name, colourOf(name, this.dark))),
      ...names.map((name) => swatch(name, airColour(name))),
    );
  }

  /** See a mark closely. */
  goTo(mark) {
    this.setLayer(mark.layer);
    this.keepFitting(() => {
      this.centre = [mark.x, mark.y];
      this.scale = Math.max(this.fitting, Math.min(this.stage.clientWidth, this.stage.clientHeight) / CLOSE);
    });
  }

  /** See all of every layer. */
  resetView() {
    if (!this.data) return;
    const { low, high } = this.data;
    this.keepFitting(() => {
      this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
      this.scale = this.fitting;
    });
  }

  /** Apply `fit` now, and whenever the size changes until the reader moves the view: what is not
   *  on the screen yet has no size that a scale could be for. */
  keepFitting(fit) {
    this.fit = fit;
    fit();
    this.changedView();
  }

  /** Pixels of one mm that show everything. */
  get fitting() {
    const { low, high } = this.data;
    const { clientWidth: width, clientHeight: height } = this.stage;
    return Math.max(0.01, Math.min((width - 2 * MARGIN) / (high[0] - low[0] || 1), (height - 3 * MARGIN) / (high[1] - low[1] || 1)));
  }

  changedView() {
    this.invalidate();
    this.tell("view");
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    const ratio = Math.min(devicePixelRatio, 2);
    [this.canvas.width, this.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.data && this.fit) this.keepFitting(this.fit);
    this.draw();
  }

  invalidate() {
    this.pending ||= requestAnimationFrame(() => this.draw());
  }

  /* ---- drawing ---- */

  draw() {
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    if (!this.data || !this.stage.clientWidth) return;
    this.colours = this.pageColours();
    const context = this.canvas.getContext("2d");
    const ratio = this.canvas.width / this.stage.clientWidth;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const [x, y] = [this.stage.clientWidth / 2, this.stage.clientHeight / 2];
    const scale = this.scale * ratio;
    context.setTransform(scale, 0, 0, -scale, x * ratio - this.centre[0] * scale, y * ratio + this.centre[1] * scale);
    context.lineCap = context.lineJoin = "round";
    this.drawLayers(context, 1 / scale);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawMarks(context);
    this.scaleBar.update(this.scale);
  }

  drawLayers(context, pixel) {
    const { air } = this.data;
    const look = { dark: this.dark, rim: this.colours.rim, pixel };
    if (this.layer > 0) {
      context.globalAlpha = 0.16;
      drawBeads(context, this.data, this.layer - 1, { ...look, rim: "transparent" });
      context.globalAlpha = 1;
    }
    if (air && air.layer === this.layer) drawAir(context, air);
    drawBeads(context, this.data, this.layer, look);
  }

  drawMarks(context) {
    context.font = "600 13px system-ui, sans-serif";
    for (const mark of this.data.marks.filter(({ layer }) => layer === this.layer)) {
      const [x, y] = this.onStage(mark.x, mark.y);
      const colour = this.colours[mark.severity];
      for (const [style, width] of [[this.colours.stage, 5], [colour, 2.2]]) {
        context.strokeStyle = style;
        context.lineWidth = width;
        context.beginPath();
        context.arc(x, y, 13, 0, 2 * Math.PI);
        context.stroke();
      }
      const right = x < this.stage.clientWidth / 2;
      context.textAlign = right ? "left" : "right";
      context.textBaseline = "middle";
      context.lineWidth = 4;
      context.strokeStyle = this.colours.stage;
      context.fillStyle = colour;
      const at = x + (right ? 20 : -20);
      context.strokeText(mark.text, at, y);
      context.fillText(mark.text, at, y);
    }
  }

  /** Pixels of a place in mm. */
  onStage(x, y) {
    const { clientWidth: width, clientHeight: height } = this.stage;
    return [width / 2 + (x - this.centre[0]) * this.scale, height / 2 - (y - this.centre[1]) * this.scale];
  }

  pageColours() {
    const style = getComputedStyle(this.host);
    const own = (name) => style.getPropertyValue(`--own-${name}`).trim();
    this.wasDark = this.dark;
    this.dark = style.colorScheme === "dark";
    if (this.dark !== this.wasDark) this.showKinds();
    return {
      stage: own("stage"), fail: own("fail"), warn: own("warn"), info: own("ink"),
      rim: this.dark ? "#12181f" : "#5b3a22",
    };
  }

  /* ---- mouse, touch, keys ---- */

  zoomAt(factor, x = this.stage.clientWidth / 2, y = this.stage.clientHeight / 2) {
    const scale = Math.min(Math.max(this.scale * factor, this.fitting / 2), 400);
    const [dx, dy] = [x - this.stage.clientWidth / 2, y - this.stage.clientHeight / 2];
    const change = 1 / this.scale - 1 / scale;
    this.centre = [this.centre[0] + dx * change, this.centre[1] - dy * change];
    this.scale = scale;
    this.fit = null;
    this.changedView();
  }

  onWheel(event) {
    const focused = this.host.shadowRoot.activeElement === this.stage;
    if (!focused && !event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const box = this.stage.getBoundingClientRect();
    this.zoomAt(Math.exp(-event.deltaY * 0.002), event.clientX - box.left, event.clientY - box.top);
  }

  onPointer(event, down) {
    if (!down) {
      this.pointers.delete(event.pointerId);
      return;
    }
    this.stage.focus({ preventScroll: true, focusVisible: false });
    this.stage.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  onMove(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    this.fit = null;
    const now = [event.clientX, event.clientY];
    const other = [...this.pointers].find(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, now);
    const share = other ? 0.5 : 1;
    this.centre = [
      this.centre[0] - (share * (now[0] - before[0])) / this.scale,
      this.centre[1] + (share * (now[1] - before[1])) / this.scale,
    ];
    if (!other) {
      this.changedView();
      return;
    }
    const apart = ([x, y]) => Math.max(Math.hypot(x - other[1][0], y - other[1][1]), 1);
    this.zoomAt(apart(now) / apart(before));
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.data) return;
    const step = 40 / this.scale;
    const move = (x, y) => () => {
      this.centre = [this.centre[0] + x * step, this.centre[1] + y * step];
      this.fit = null;
      this.changedView();
    };
    const action = {
      ArrowLeft: move(-1, 0), ArrowRight: move(1, 0), ArrowUp: move(0, 1), ArrowDown: move(0, -1),
      "+": () => this.zoomAt(1.25), "=": () => this.zoomAt(1.25), "-": () => this.zoomAt(0.8),
      "[": () => this.setLayer(this.layer - 1), "]": () => this.setLayer(this.layer + 1),
      PageDown: () => this.setLayer(this.layer - 10), PageUp: () => this.setLayer(this.layer + 10),
      r: () => this.resetView(), R: () => this.resetView(), Home: () => this.resetView(),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  tell(name) {
    this.dispatchEvent(new CustomEvent(name, { detail: this }));
  }

  /** What is shown, for tests. */
  state() {
    const runs = [...runsOf(this.data, this.layer)];
    return {
      layer: this.layer,
      layers: this.data.tops.length,
      top_mm: this.data.tops[this.layer],
      beads: runs.reduce((sum, { widths }) => sum + widths.length, 0),
      kinds: this.kinds,
      first: runs.length ? { places: runs[0].places.slice(0, 4), width: runs[0].widths[0] } : null,
      marks: this.data.marks.filter(({ layer }) => layer === this.layer).map(({ text }) => text),
      centre: this.centre,
      pixels_per_mm: this.scale,
      scale_bar_mm: this.scaleBar.length,
      reading: shortNumber(this.data.tops[this.layer], 10),
    };
  }

  /** Give all memory back. */
  dispose() {
    this.endTheme();
    this.sizes.disconnect();
    cancelAnimationFrame(this.pending);
    this.host.shadowRoot.replaceChildren();
  }
}
