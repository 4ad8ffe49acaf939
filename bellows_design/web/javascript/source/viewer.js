/* The viewer: a scene that is turned, cut open, moved through its frames and coloured by values. */

import { LinearSRGBColorSpace, Scene, WebGLRenderer } from "three";
import { Camera, VIEWS } from "./camera.js";
import { mapBytes, shortNumber } from "./colours.js";
import { Controls } from "./controls.js";
import { element, onThemeChange, reducedMotion, shadowOf } from "./dom.js";
import { mapTexture } from "./materials.js";
import { Help, Legend, ScaleBar, Triad } from "./overlay.js";
import { picture, printedAsPicture } from "./picture.js";
import { Probe } from "./probe.js";
import { Section } from "./section.js";
import { Shape } from "./shape.js";
import { VIEWER_STYLE } from "./style.js";

const NO_WEBGL =
  "This browser shows no 3D here: WebGL 2 is switched off or missing. " +
  "Everything else on this page works without it.";
const LOST = "The graphics card was taken away from this page. The view comes back when it is free again.";
const PALETTE = ["", "#d98f4e", "#6aa66a", "#b07fb8", "#c8b04a", "#5fb0b0"];
const FRAMES_PER_SECOND = 6;
const LEGEND_WIDTH = 84; // pixels that it needs beside the scene
const NARROW = 560; // pixels: below, the legend lies over the scene

/**
 * A view of one scene in `host`, an element of the page.
 *
 * Options: `height` of the picture in pixels (420; null: as high as the host), `label` for screen
 * readers, `controls` (true, false, or the names of `Controls.PARTS` to show), `map` ("viridis",
 * "turbo"), `view` (a name of VIEWS or a direction).
 *
 * Events (CustomEvent): "shown", "frame", "field", "section", "visible", "view", "playing".
 */
export class Viewer extends EventTarget {
  constructor(host, options = {}) {
    super();
    this.host = host;
    this.options = { height: 420, label: "3D view", controls: true, map: "viridis", view: "corner", ...options };
    this.shapes = [];
    this.frame = 0;
    this.field = null;
    this.renders = 0;
    this.touched = false; // whether the reader has turned, moved or zoomed the view
    this.section = new Section();
    this.buildPage();
    this.startGraphics();
    this.controls = new Controls(this, this.bar, this.options.controls);
    this.endTheme = onThemeChange(this.host, () => this.recolour());
  }

  /* ---- page ---- */

  buildPage() {
    this.legend = new Legend();
    this.scaleBar = new ScaleBar();
    this.triad = new Triad();
    this.help = new Help();
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.message = element("div", { class: "message", role: "alert", hidden: true });
    this.note = element("div", { class: "note", "aria-hidden": "true" });
    this.value = element("div", { class: "value", "aria-hidden": "true", hidden: true });
    this.probe = new Probe(this);
    this.keysText = element("span", { class: "hidden-text", id: "keys" },
      "Arrow keys turn, plus and minus zoom, square brackets change the frame, S cuts, R resets.");
    this.stage = element(
      "div",
      { class: "stage", tabindex: 0, role: "application", "aria-roledescription": "3D view",
        "aria-label": this.options.label, "aria-describedby": "keys", part: "stage" },
      this.canvas, this.triad.root, this.scaleBar.root, this.legend.root, this.note, this.value, this.keysText,
    );
    this.bar = element("div", { class: "bar", part: "bar" });
    this.root = shadowOf(this.host, VIEWER_STYLE);
    this.box = element("div", { class: "frame", part: "frame" }, this.stage, this.bar);
    this.root.append(this.box);
    if (this.options.height) this.stage.style.height = `${this.options.height}px`;
    else this.fillHost();
    this.stage.addEventListener("keydown", (event) => this.onKey(event));
    this.stage.addEventListener("pointerdown", () => this.stage.focus({ preventScroll: true, focusVisible: false }));
    this.stage.addEventListener("pointermove", (event) => this.onPoint(event));
    this.stage.addEventListener("pointerleave", () => (this.value.hidden = true));
    this.stage.addEventListener("wheel", (event) => this.onWheel(event), { capture: true });
  }

  fillHost() {
    this.box.style.cssText = "height: 100%; display: flex; flex-direction: column;";
    this.stage.style.flex = "1 1 0";
  }

  /* ---- graphics ---- */

  startGraphics() {
    try {
      this.renderer = new WebGLRenderer({
        canvas: this.canvas, antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true,
      });
    } catch {
      this.fail(NO_WEBGL);
      return;
    }
    this.renderer.outputColorSpace = LinearSRGBColorSpace; // the shaders' colours are as displayed
    this.renderer.setClearColor(0, 0);
    this.scene = new Scene();
    const changed = () => {
      this.invalidate();
      this.tell("view");
    };
    this.camera = new Camera(this.canvas, changed, () => (this.touched = true));
    this.map = { value: null };
    this.setMap(this.options.map);
    this.canvas.addEventListener("webglcontextlost", (event) => this.onLost(event));
    this.canvas.addEventListener("webglcontextrestored", () => this.onRestored());
    this.stage.append(this.help.button, this.help.list, this.message);
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.stage);
    this.resize();
    this.endPrinting = printedAsPicture(this);
  }

  fail(text) {
    this.failed = text;
    this.stage.append(this.message);
    this.message.textContent = text;
    this.message.hidden = false;
  }

  onLost(event) {
    event.preventDefault();
    this.lost = true;
    this.message.textContent = LOST;
    this.message.hidden = false;
  }

  onRestored() {
    this.lost = false;
    this.message.hidden = true;
    this.invalidate();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!this.renderer || !width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const first = this.camera.width === 1;
    this.camera.resize(width, height);
    if (this.shapes.length && (first || !this.touched)) this.resetView();
    this.render();
  }

  /** Draw with the next picture of the screen. */
  invalidate() {
    if (this.pending || !this.renderer) return;
    this.pending = requestAnimationFrame(() => this.render());
  }

  render() {
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    if (!this.renderer || this.lost) return;
    this.section.centreOn(this.camera.middle.toArray());
    this.renderer.render(this.scene, this.camera.camera);
    this.scaleBar.update(this.camera.pixelsPerMm);
    this.triad.update(this.camera.camera);
    this.renders += 1;
  }

  /* ---- what is shown ---- */

  /** Show a scene from `Bellows.unpack`; with `keepView` from where the camera is. */
  show(scene, { keepView = false } = {}) {
    if (!this.renderer) return;
    const hadShapes = this.shapes.length > 0;
    this.takeShapes(scene.surfaces);
    this.field = this.fieldNames.includes(this.field) ? this.field : null;
    this.section.rebuild(this.shapes, this.size).forEach((object) => this.scene.add(object));
    if (!(keepView && hadShapes)) this.resetView();
    this.frame = Math.min(this.frame, this.frames - 1);
    this.recolour();
    this.setField(this.field, this.scale || {});
    this.setFrame(this.frame);
    this.tell("shown");
  }

  takeShapes(surfaces) {
    const before = new Map(this.shapes.map((shape) => [shape.name, shape]));
    this.shapes = surfaces.map((data, number) => {
      const coloured = { ...data, colour: data.colour || PALETTE[number % PALETTE.length] };
      const old = before.get(data.name);
      if (old && old.replaceData(coloured)) {
        before.delete(data.name);
        return old;
      }
      const made = new Shape(coloured, { section: this.section.uniforms, map: this.map });
      made.setVisible(old ? old.visible : data.visible);
      made.objects.forEach((object) => this.scene.add(object));
      return made;
    });
    for (const gone of before.values()) {
      gone.objects.forEach((object) => object.removeFromParent());
      gone.dispose();
    }
  }

  /** Number of frames of the scene. */
  get frames() {
    return Math.max(1, ...this.shapes.map((shape) => shape.frames));
  }

  /** Least and greatest coordinates over all frames of all surfaces, mm. */
  get bounds() {
    const axes = [0, 1, 2];
    const boxes = this.shapes.map((shape) => shape.box);
    return {
      low: axes.map((axis) => Math.min(...boxes.map(({ low }) => low[axis]))),
      high: axes.map((axis) => Math.max(...boxes.map(({ high }) => high[axis]))),
    };
  }

  get size() {
    const { low, high } = this.bounds;
    return Math.hypot(...high.map((x, axis) => x - low[axis]));
  }

  /** Names of all fields. */
  get fieldNames() {
    return [...new Set(this.shapes.flatMap((shape) => shape.data.fields.map((field) => field.name)))];
  }

  /** Label of the frame that is nearest to the one shown; empty if frames have none. */
  get frameLabel() {
    const labels = this.shapes.map((shape) => shape.data.frame_labels).find((found) => found.length);
    return labels ? labels[Math.round(this.frame)] : "";
  }

  /** Show frame `t`, from 0 to the last; between two frames a mix of both. */
  setFrame(t) {
    this.frame = Math.min(Math.max(Number(t) || 0, 0), this.frames - 1);
    for (const shape of this.shapes) shape.setFrame(this.frame);
    this.invalidate();
    this.tell("frame");
  }

  /** Run through the frames and back until stopped; whole frames only where motion is unwanted. */
  play(on = !this.playing) {
    cancelAnimationFrame(this.playTimer);
    this.playing = on && this.frames > 1;
    if (this.playing) this.runFrames(this.frame >= this.frames - 1 ? -1 : 1);
    this.tell("playing");
  }

  runFrames(direction) {
    let [way, before] = [direction, performance.now()];
    const step = (now) => {
      const calm = reducedMotion();
      if (!calm || now - before > 900) {
        const moved = calm ? 1 : ((now - before) / 1000) * FRAMES_PER_SECOND;
        let next = this.frame + way * Math.min(moved, 1);
        if (next >= this.frames - 1) [next, way] = [this.frames - 1, -1];
        else if (next <= 0) [next, way] = [0, 1];
        before = now;
        this.setFrame(calm ? Math.round(next) : next);
      }
      this.playTimer = requestAnimationFrame(step);
    };
    this.playTimer = requestAnimationFrame(step);
  }

  /** Colour by the field `name`, null for none. `low`, `high`, `limit`, `map` override its own. */
  setField(name, scale = {}) {
    const found = this.shapes.flatMap((shape) => shape.data.fields.filter((field) => field.name === name));
    this.field = found.length ? name : null;
    this.scale = scale;
    if (scale.map) this.options.map = scale.map;
    this.colouring = found.length ? this.colouringOf(found, scale) : null;
    const { low, high } = this.colouring || { low: 0, high: 1 };
    for (const shape of this.shapes) shape.setField(this.field, low, high);
    if (this.colouring) this.setMap(this.options.map, this.colouring.reverse);
    this.legend.show(this.colouring && { ...this.colouring, bytes: this.mapBytes });
    this.invalidate();
    this.tell("field");
  }

  colouringOf(fields, scale) {
    const chosen = (end, own, of) => scale[end] ?? fields[0].scale[own] ?? of(...fields.map((field) => field[end]));
    const [low, high] = [chosen("low", 0, Math.min), chosen("high", 1, Math.max)];
    return {
      name: fields[0].name,
      unit: fields[0].unit,
      low,
      high: high > low ? high : low + (Math.abs(low) || 1) * 1e-6,
      limit: scale.limit === undefined ? fields[0].limit : scale.limit,
      reverse: fields[0].reverse,
      missing: fields.some((field) => field.missing),
    };
  }

  setMap(name, reverse = false) {
    const key = `${name} ${reverse}`;
    if (key === this.mapKey) return;
    this.mapKey = key;
    this.mapBytes = mapBytes(name, reverse);
    if (this.map.value) this.map.value.dispose();
    this.map.value = mapTexture(this.mapBytes);
  }

  /** Cut along `axis` ("x", "y", "z") at `offset_mm`. Unless `flip` says it, the half towards the
      camera is taken away when the cut is switched on or its axis changes. */
  setSection({ axis, offset_mm, on, flip } = {}) {
    const { section } = this;
    const other = axis !== undefined && axis !== section.axis;
    const turned = other || (on && !section.on);
    if (other) section.axis = axis;
    const number = ["x", "y", "z"].indexOf(section.axis);
    if (offset_mm !== undefined || ((other || !section.placed) && this.shapes.length)) {
      const { low, high } = this.bounds;
      section.offset = offset_mm ?? (low[number] + high[number]) / 2;
      section.placed = true;
    }
    if (on !== undefined) section.on = Boolean(on);
    if (flip !== undefined) section.flip = Boolean(flip);
    else if (turned && this.camera) section.flip = this.camera.towards.getComponent(number) < 0;
    section.update();
    this.invalidate();
    this.tell("section");
  }

  /** Show or hide a surface. */
  setVisible(name, visible) {
    const shape = this.shapes.find((one) => one.name === name);
    if (!shape) throw new Error(`The scene has no surface “${name}”.`);
    shape.setVisible(Boolean(visible));
    this.section.update();
    this.invalidate();
    this.tell("visible");
  }

  /** Colour of a surface, `#rrggbb`, where no field colours it. */
  setColour(name, colour) {
    const shape = this.shapes.find((one) => one.name === name);
    if (!shape) throw new Error(`The scene has no surface “${name}”.`);
    shape.data.colour = colour;
    this.recolour();
  }

  /** See everything; `view` is a name of VIEWS or a direction towards the camera. */
  resetView(view = this.options.view) {
    if (!this.camera || !this.shapes.length) return;
    const points = this.shapes.filter((shape) => shape.visible).map((shape) => shape.allPoints());
    if (!points.length) return;
    const direction = Array.isArray(view) ? view : VIEWS[view] || VIEWS.corner;
    const aside = this.fieldNames.length && this.camera.width > NARROW ? LEGEND_WIDTH : 0;
    this.camera.fit(points, this.size, direction, aside);
    this.touched = false;
    this.invalidate();
    this.tell("view");
  }

  /** Take the page's colours anew. */
  recolour() {
    if (!this.renderer) return;
    const style = getComputedStyle(this.host);
    const colours = {};
    for (const name of ["surface", "edge", "cut"]) colours[name] = hexOf(style.getPropertyValue(`--own-${name}`));
    colours.line = hexOf(style.getPropertyValue("--own-wire"));
    for (const shape of this.shapes) shape.setColours(colours);
    this.section.setColours(colours, this.renderer.getPixelRatio());
    this.invalidate();
  }

  /* ---- mouse and keys ---- */

  onWheel(event) {
    this.touched = true;
    if (this.root.activeElement === this.stage || event.ctrlKey || event.metaKey) return;
    event.stopPropagation();
    this.say("Click first, or hold Ctrl, to zoom");
  }

  /** Say the value below the mouse; not while it turns the view. */
  onPoint({ clientX, clientY, buttons, pointerType }) {
    cancelAnimationFrame(this.pointing);
    this.value.hidden = true;
    if (buttons || pointerType !== "mouse" || !this.field || !this.renderer) return;
    this.pointing = requestAnimationFrame(() => {
      const box = this.stage.getBoundingClientRect();
      this.readValue(clientX - box.left, clientY - box.top);
    });
  }

  /** Show the value at a place of the stage, pixels; returns it, null where there is none. */
  readValue(x, y) {
    const found = this.probe.at(x, y);
    this.value.hidden = !found;
    if (!found) return null;
    const { low, high } = this.colouring;
    this.value.textContent = `${shortNumber(found.value, high - low)} ${found.unit}`.trim();
    const left = x > this.stage.clientWidth - 110;
    this.value.style.transform = `translate(${x}px, ${y}px) translate(${left ? "calc(-100% - 10px)" : "14px"}, -130%)`;
    return found.value;
  }

  say(text) {
    clearTimeout(this.noteTimer);
    this.note.textContent = text;
    this.note.classList.add("shown");
    this.noteTimer = setTimeout(() => this.note.classList.remove("shown"), 1400);
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== this.stage || !this.camera) return;
    const action = this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  actionOf({ key, shiftKey }) {
    const move = (right, up) => () => {
      this.touched = true;
      if (shiftKey) this.camera.pan(-right, up);
      else this.camera.rotate(right, up);
    };
    const zoom = (factor) => () => {
      this.touched = true;
      this.camera.zoom(factor);
    };
    const frame = (step) => () => this.setFrame(Math.round(this.frame) + step);
    const axis = (name) => () => this.setSection({ axis: name, on: true });
    return {
      ArrowLeft: move(-1, 0), ArrowRight: move(1, 0), ArrowUp: move(0, 1), ArrowDown: move(0, -1),
      "+": zoom(1.2), "=": zoom(1.2), "-": zoom(1 / 1.2), "_": zoom(1 / 1.2),
      "[": frame(-1), "]": frame(1), " ": () => this.play(),
      s: () => this.setSection({ on: !this.section.on }), x: axis("x"), y: axis("y"), z: axis("z"),
      r: () => this.resetView(), Home: () => this.resetView(), "?": () => this.help.toggle(),
    }[key.length === 1 ? key.toLowerCase() : key];
  }

  tell(name) {
    this.dispatchEvent(new CustomEvent(name, { detail: this }));
  }

  /* ---- for others ---- */

  /** The picture with legend and scale bar as a PNG (a data: address). */
  picture() {
    this.render();
    return picture(this);
  }

  /** What is shown, for tests. */
  state() {
    const sample = (shape) => {
      const { array, count } = shape.geometry.getAttribute("position");
      const numbers = [0, 1, 2, 3].map((part) => Math.floor((part * (count - 1)) / 3));
      return numbers.map((i) => Array.from(array.slice(3 * i, 3 * i + 3)));
    };
    return {
      frame: this.frame,
      frames: this.frames,
      label: this.frameLabel,
      playing: Boolean(this.playing),
      field: this.field,
      range: this.colouring ? { low: this.colouring.low, high: this.colouring.high } : null,
      limit: this.colouring ? this.colouring.limit : null,
      legend: this.legend.state,
      section: this.section.state,
      camera: this.camera ? this.camera.state : null,
      scale_bar_mm: this.scaleBar.length,
      surfaces: this.shapes.map((shape) => ({
        name: shape.name, visible: shape.visible, closed: shape.closed, colour: shape.data.colour,
        cells: shape.data.cells.length / shape.data.corners, points: shape.data.points, sample: sample(shape),
        sharp_edges: shape.topology.creases.length / 2,
      })),
      renders: this.renders,
      lost: Boolean(this.lost),
      failed: this.failed || "",
    };
  }

  /** Give all memory back. */
  dispose() {
    this.play(false);
    this.endTheme();
    if (this.sizes) this.sizes.disconnect();
    this.endPrinting?.();
    cancelAnimationFrame(this.pending);
    this.shapes.forEach((shape) => shape.dispose());
    this.section.dispose();
    if (this.camera) this.camera.dispose();
    if (this.renderer) {
      this.renderer.dispose();
      this.renderer.forceContextLoss();
    }
    this.renderer = null;
    this.root.replaceChildren();
  }
}

/** Any colour of CSS as `#rrggbb`. */
function hexOf(text) {
  const colour = text.trim();
  if (/^#[0-9a-f]{6}$/i.test(colour)) return colour;
  const context = document.createElement("canvas").getContext("2d");
  context.fillStyle = colour;
  return /^#[0-9a-f]{6}$/i.test(context.fillStyle) ? context.fillStyle : "#808080";
}
