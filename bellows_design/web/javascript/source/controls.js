/* The control bar below a viewer. */

import { element, svgElement } from "./dom.js";
import { shortNumber } from "./colours.js";

const ICONS = {
  play: "M4 2.5v11l9.5-5.5z",
  pause: "M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z",
  picture: "M1.5 3.5h3l1-1.5h5l1 1.5h3v10h-13zM8 5.5a3 3 0 1 0 .01 0z",
  reset: "M2 2h5v1.8H3.8V7H2zM9 2h5v5h-1.8V3.8H9zM2 9h1.8v3.2H7V14H2zM12.2 9H14v5H9v-1.8h3.2z",
};

const icon = (name) => svgElement("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, svgElement("path", { d: ICONS[name], "fill-rule": "evenodd" }));

/** Frames, fields, section, surfaces, whole view and picture of a viewer. */
export class Controls {
  static PARTS = ["frames", "fields", "section", "surfaces", "reset", "picture"];

  /** `parts`: true for all, false for none, or names of PARTS. */
  constructor(viewer, bar, parts = true) {
    this.viewer = viewer;
    this.bar = bar;
    this.parts = parts === true ? Controls.PARTS : parts || [];
    viewer.addEventListener("shown", () => this.build());
    for (const name of ["frame", "playing"]) viewer.addEventListener(name, () => this.readFrame());
    for (const name of ["field", "section", "visible"]) viewer.addEventListener(name, () => this.read());
  }

  build() {
    const { viewer } = this;
    const key = JSON.stringify([viewer.frames, viewer.fieldNames, viewer.shapes.map((shape) => shape.name)]);
    if (key !== this.key) {
      this.key = key;
      const made = this.parts.map((part) => this[part]()).filter((group) => group !== null);
      this.bar.replaceChildren(...made);
    }
    this.readFrame();
    this.read();
  }

  frames() {
    const { viewer } = this;
    if (viewer.frames < 2) return (this.slider = null);
    this.playButton = element("button", { type: "button", class: "round", onclick: () => viewer.play() });
    this.slider = element("input", {
      type: "range", min: 0, max: viewer.frames - 1, step: 0.02, "aria-label": "Frame",
      oninput: () => this.onSlide(this.slider.valueAsNumber),
      onkeydown: (event) => this.onSliderKey(event),
    });
    this.reading = element("output", { class: "reading", "aria-live": "off" });
    return element("div", { class: "group frames" }, this.playButton, this.slider, this.reading);
  }

  onSlide(frame) {
    this.viewer.play(false);
    this.viewer.setFrame(frame);
  }

  /** Arrow keys step by whole frames, though the mouse moves between them. */
  onSliderKey(event) {
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    this.onSlide(Math.round(this.viewer.frame) + step);
  }

  fields() {
    const { viewer } = this;
    if (!viewer.fieldNames.length) return (this.choice = null);
    const option = (name) => element("option", { value: name }, name || "none");
    this.choice = element(
      "select",
      { "aria-label": "Colours show", onchange: () => viewer.setField(this.choice.value || null) },
      option(""), ...viewer.fieldNames.map(option),
    );
    return element("label", { class: "group" }, element("span", { class: "quiet" }, "Colours"), this.choice);
  }

  section() {
    const { viewer } = this;
    this.cut = element("button", {
      type: "button", "aria-pressed": "false", onclick: () => viewer.setSection({ on: !viewer.section.on }),
    }, "Section");
    this.axis = element(
      "select", { "aria-label": "Axis of the section", onchange: () => viewer.setSection({ axis: this.axis.value, on: true }) },
      ...["x", "y", "z"].map((name) => element("option", { value: name }, name)),
    );
    this.offset = element("input", {
      type: "range", "aria-label": "Place of the section, mm",
      oninput: () => viewer.setSection({ offset_mm: this.offset.valueAsNumber, on: true }),
    });
    this.flip = element("button", {
      type: "button", title: "Cut away the other half", "aria-label": "Cut away the other half", class: "round",
      onclick: () => viewer.setSection({ flip: !viewer.section.flip }),
    }, "⇄");
    this.place = element("output", { class: "reading quiet", "aria-live": "off" });
    this.placing = element("div", { class: "place" }, this.axis, this.offset, this.place, this.flip);
    return element("div", { class: "group section" }, this.cut, this.placing);
  }

  surfaces() {
    const { viewer } = this;
    if (viewer.shapes.length < 2) return (this.checks = null);
    this.checks = viewer.shapes.map((shape) => {
      const box = element("input", {
        type: "checkbox", onchange: () => viewer.setVisible(shape.name, box.checked),
      });
      const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
      swatch.style.background = shape.data.colour || "var(--own-surface)";
      return { name: shape.name, box, label: element("label", { class: "check" }, box, swatch, shape.name) };
    });
    return element("div", { class: "group surfaces", role: "group", "aria-label": "Surfaces" }, ...this.checks.map((check) => check.label));
  }

  reset() {
    return element("button", {
      type: "button", class: "round", title: "Whole view (R)", "aria-label": "Whole view", onclick: () => this.viewer.resetView(),
    }, icon("reset"));
  }

  picture() {
    return element("button", {
      type: "button", class: "round", title: "Save the picture", "aria-label": "Save the picture as PNG", onclick: () => this.save(),
    }, icon("picture"));
  }

  save() {
    const name = (this.viewer.options.label || "view").toLowerCase().replace(/[^\p{L}\p{N}]+/gu, "_");
    element("a", { href: this.viewer.picture(), download: `${name}.png` }).click();
  }

  readFrame() {
    if (!this.slider) return;
    const { viewer } = this;
    this.slider.value = viewer.frame;
    const text = viewer.frameLabel || `${Math.round(viewer.frame) + 1} of ${viewer.frames}`;
    this.slider.setAttribute("aria-valuetext", text);
    this.reading.textContent = text;
    if (this.shownPlaying === Boolean(viewer.playing)) return;
    this.shownPlaying = Boolean(viewer.playing);
    this.playButton.replaceChildren(icon(this.shownPlaying ? "pause" : "play"));
    this.playButton.setAttribute("aria-label", this.shownPlaying ? "Pause" : "Play");
  }

  read() {
    const { viewer } = this;
    if (this.choice) this.choice.value = viewer.field || "";
    if (this.checks) for (const { name, box } of this.checks) box.checked = viewer.shapes.find((shape) => shape.name === name)?.visible;
    if (this.cut && viewer.shapes.length) this.readSection(viewer);
  }

  readSection({ section, bounds }) {
    const number = ["x", "y", "z"].indexOf(section.axis);
    const [low, high] = [bounds.low[number], bounds.high[number]];
    Object.assign(this.offset, { min: low, max: high, step: (high - low) / 200 || 1 });
    this.offset.value = section.placed ? section.offset : (low + high) / 2;
    this.cut.setAttribute("aria-pressed", String(section.on));
    this.axis.value = section.axis;
    this.placing.hidden = !section.on;
    this.place.textContent = `${shortNumber(section.offset, high - low)} mm`;
    this.offset.setAttribute("aria-valuetext", `${section.axis} = ${this.place.textContent}`);
  }
}
