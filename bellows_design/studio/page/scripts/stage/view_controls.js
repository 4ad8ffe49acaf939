// What stands above the viewer's own bar: which shape, and how far on the way to the pressure.

import { byId, setText } from "../parts/elements.js";
import { fixed } from "../model/numbers.js";

export class ViewControls {
  #view;
  #session;

  constructor(view, session) {
    this.#view = view;
    this.#session = session;
    this.printed = byId("mode-printed");
    this.pressure = byId("mode-pressure");
    this.blend = byId("blend");
    this.printed.addEventListener("change", () => view.setMode("printed"));
    this.pressure.addEventListener("change", () => view.setMode("pressure"));
    this.blend.addEventListener("input", () => view.setBlend(Number(this.blend.value)));
    view.addEventListener("scene", () => this.#show());
    session.addEventListener("state", () => this.#show());
    this.#show();
  }

  toggleMode() {
    this.#view.setMode(this.#view.mode === "printed" ? "pressure" : "printed");
  }

  #show() {
    const { mode, hasDeformed, blend } = this.#view;
    this.printed.checked = mode === "printed";
    this.pressure.checked = mode === "pressure";
    this.blend.disabled = mode !== "pressure" || !hasDeformed;
    const text = this.blend.disabled ? "" : this.#blendText(blend);
    setText(byId("blend-text"), text);
    this.blend.setAttribute("aria-valuetext", text);
  }

  #blendText(share) {
    if (share === 0) return "at rest";
    if (share < 1) return `${Math.round(100 * share)} % of the way`;
    return `${fixed(this.#session.answer?.pressure_mpa ?? NaN, 3)} MPa`;
  }
}
