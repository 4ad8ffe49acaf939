// The controls below the 3D view.

import { byId, option, setText } from "../parts/elements.js";
import { extent, fieldNames } from "./scenes_shown.js";
import { fixed } from "../model/numbers.js";

const AXES = { x: 0, y: 1, z: 2 };

/** Binds mode, blend, section, colours and the pinned shape to a view. */
export class ViewControls {
  #view;
  #session;

  constructor(view, session) {
    this.#view = view;
    this.#session = session;
    this.printed = byId("mode-printed");
    this.pressure = byId("mode-pressure");
    this.blend = byId("blend");
    this.section = byId("section-on");
    this.axis = byId("section-axis");
    this.offset = byId("section-offset");
    this.colours = byId("colours");
    this.#listen();
    view.addEventListener("scene", () => this.#showScene());
  }

  toggleMode() {
    this.#setMode(this.#view.mode === "printed" ? "pressure" : "printed");
  }

  toggleSection() {
    this.section.checked = !this.section.checked;
    this.#applySection();
  }

  #listen() {
    this.printed.addEventListener("change", () => this.#setMode("printed"));
    this.pressure.addEventListener("change", () => this.#setMode("pressure"));
    this.blend.addEventListener("input", () => this.#setBlend());
    for (const control of [this.section, this.offset]) control.addEventListener("input", () => this.#applySection());
    this.axis.addEventListener("change", () => this.#axisChosen());
    this.colours.addEventListener("change", () => this.#view.setField(this.colours.value || null));
    byId("reset-view").addEventListener("click", () => this.#view.resetView());
  }

  #setMode(mode) {
    this.printed.checked = mode === "printed";
    this.pressure.checked = mode === "pressure";
    this.#view.setMode(mode);
    this.#showScene();
  }

  #setBlend() {
    this.#view.setBlend(Number(this.blend.value));
    this.#showBlend();
  }

  #showBlend() {
    const pressure = this.#session.answer?.pressure_mpa ?? this.#session.valueOf("load.pressure") ?? 0;
    const share = Number(this.blend.value);
    const text = share === 0 ? "at rest" : share === 1 ? `at ${fixed(pressure, 3)} MPa` : `${Math.round(100 * share)} % of the way`;
    setText(byId("blend-text"), text);
    this.blend.setAttribute("aria-valuetext", text);
  }

  #axisChosen() {
    const [low, high] = this.#extent();
    this.offset.value = (low + high) / 2;
    this.#applySection();
  }

  #extent() {
    return extent(this.#view.scene)[AXES[this.axis.value]];
  }

  #applySection() {
    const on = this.section.checked;
    byId("section-details").hidden = !on;
    if (!this.#view.scene) return;
    this.#spanOffset();
    this.#view.setSection({ on, axis: this.axis.value, offset_mm: Number(this.offset.value) });
  }

  #spanOffset() {
    const [low, high] = this.#extent();
    Object.assign(this.offset, { min: low, max: high, step: "any" });
    this.offset.setAttribute("aria-valuetext", `${fixed(Number(this.offset.value), 1)} mm`);
  }

  #showScene() {
    const { scene, field } = this.#view;
    this.blend.disabled = this.#view.mode !== "pressure" || !this.#view.hasDeformed;
    this.#showBlend();
    if (!scene) return;
    if (this.section.checked) this.#applySection();
    const names = fieldNames(scene);
    const chosen = field === undefined ? names[0] : field;
    this.colours.replaceChildren(option("", "plain"), ...names.map((name) => option(name, name, name === chosen)));
    this.colours.disabled = !names.length;
  }
}
