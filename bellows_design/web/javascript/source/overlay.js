/* What lies over the picture: legend, scale bar, axes, help. All of it HTML and SVG. */

import { Vector3 } from "three";
import { mapGradient, niceStep, niceTicks, shortNumber } from "./colours.js";
import { element, svgElement } from "./dom.js";

const KEYS = [
  ["Drag, ← ↑ → ↓", "turn"],
  ["Right drag, two fingers, Shift + arrows", "move"],
  ["Wheel, pinch, + −", "zoom"],
  ["[ ]", "frame before, next"],
  ["Space", "play"],
  ["S", "section on and off"],
  ["X Y Z", "axis of the section"],
  ["R", "whole view"],
];

export class Legend {
  constructor() {
    this.root = element("div", { class: "legend", hidden: true, role: "group", part: "legend" });
  }

  /** `colouring`: name, unit, low, high, limit, missing, bytes of the map; null for none. */
  show(colouring) {
    this.root.hidden = !colouring;
    this.root.replaceChildren();
    if (!colouring) return;
    const { name, unit, low, high, limit, missing, bytes } = colouring;
    const title = unit ? `${name}, ${unit}` : name;
    const scale = element("div", { class: "legend-scale" });
    scale.style.background = mapGradient(bytes, "to top");
    const place = (made, value) => {
      made.style.top = `${100 * (1 - (value - low) / (high - low || 1))}%`;
      scale.append(made);
    };
    for (const tick of niceTicks(low, high)) {
      place(element("span", { class: "legend-tick" }, shortNumber(tick, high - low)), tick);
    }
    const beyond = limit !== null && (limit < low || limit > high);
    const said = limit === null ? "" : `limit ${shortNumber(limit, high - low)}`;
    if (said && !beyond) place(element("span", { class: "legend-limit" }, said), limit);
    this.root.setAttribute("aria-label", `Colours: ${title}, ${low} to ${high}`);
    this.root.append(element("div", { class: "legend-title" }, title), scale);
    if (beyond) this.root.append(element("div", { class: "legend-missing" }, `${said}${unit && ` ${unit}`}, off the scale`));
    if (missing) this.root.append(element("div", { class: "legend-missing" }, element("i"), "no value"));
  }

  /** What it says, for tests. */
  get state() {
    const texts = (kind) => [...this.root.querySelectorAll(kind)].map((found) => found.textContent);
    return {
      shown: !this.root.hidden,
      title: texts(".legend-title")[0] || "",
      ticks: texts(".legend-tick"),
      limit: texts(".legend-limit")[0] || "",
    };
  }
}

export class ScaleBar {
  constructor() {
    this.bar = element("i");
    this.text = element("span");
    this.root = element("div", { class: "scale-bar", part: "scale-bar" }, this.text, this.bar);
  }

  update(pixelsPerMm) {
    let length = niceStep(70 / pixelsPerMm);
    if (length * pixelsPerMm > 140) length = niceStep(30 / pixelsPerMm);
    this.length = length;
    this.bar.style.width = `${length * pixelsPerMm}px`;
    this.text.textContent = `${shortNumber(length, length)} mm`;
  }
}

export class Triad {
  constructor() {
    this.root = svgElement("svg", { class: "triad", viewBox: "-34 -34 68 68", "aria-hidden": "true" });
    this.arms = ["x", "y", "z"].map((name, axis) => {
      const line = svgElement("line", { class: `axis-${name}`, x1: 0, y1: 0 });
      const text = svgElement("text", {}, name);
      const group = svgElement("g", {}, line, text);
      const direction = new Vector3().setComponent(axis, 1);
      return { line, text, group, direction };
    });
  }

  update(camera) {
    const seen = this.arms.map((arm) => {
      const end = arm.direction.clone().applyQuaternion(camera.quaternion.clone().invert());
      arm.line.setAttribute("x2", 20 * end.x);
      arm.line.setAttribute("y2", -20 * end.y);
      arm.text.setAttribute("x", 27 * end.x);
      arm.text.setAttribute("y", -27 * end.y);
      return [end.z, arm.group];
    });
    seen.sort((one, other) => one[0] - other[0]);
    this.root.replaceChildren(...seen.map(([, group]) => group));
  }
}

export class Help {
  constructor() {
    this.list = element("div", { class: "help", hidden: true, id: "help" });
    const lines = KEYS.flatMap(([keys, what]) => [element("dt", {}, keys), element("dd", {}, what)]);
    this.list.append(element("dl", {}, ...lines));
    this.button = element(
      "button",
      { type: "button", class: "help-button", "aria-label": "Mouse and keys", "aria-expanded": "false",
        "aria-controls": "help", title: "Mouse and keys", onclick: () => this.toggle() },
      "?",
    );
  }

  toggle(open = this.list.hidden) {
    this.list.hidden = !open;
    this.button.setAttribute("aria-expanded", String(open));
  }
}
