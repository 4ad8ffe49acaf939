// One parameter: its label, slider, number field, meaning, sensitivity and problems.

import { element, setText } from "../parts/elements.js";
import { onGrid, parsed, shown, signed } from "../model/numbers.js";
import { firstWindow, widened } from "../model/window.js";

/**
 * A row for one parameter. It calls `onMove(name, value)` while it moves, and `onGesture(begins)`
 * when a drag begins and ends.
 */
export class SliderRow {
  #window;
  #value;
  #opened;
  #dragging = false; // the window stays as it is under the pointer

  constructor(parameter, handlers) {
    this.parameter = parameter;
    this.handlers = handlers;
    this.#window = firstWindow(parameter);
    this.id = `p-${parameter.name.replace(/\W/g, "-")}`;
    this.#build();
  }

  get name() {
    return this.parameter.name;
  }

  /** The number that stands there. */
  get value() {
    return this.#value;
  }

  /**
   * Shows `shownValue`, the design's number, which follows from others where `value` is null or the
   * opened one.
   */
  show(value, opened, shownValue) {
    this.#opened = opened;
    this.#value = shownValue;
    if (!this.#dragging) this.#window = widened(this.#window, this.parameter, shownValue);
    this.#applyWindow();
    if (shownValue !== null) this.range.value = shownValue;
    this.range.setAttribute("aria-valuetext", `${shown(shownValue)} ${this.parameter.unit}`.trim());
    if (!this.field.dataset.typing) this.field.value = shown(shownValue);
    this.#showBack(value !== opened);
  }

  #showBack(changed) {
    const { label, unit } = this.parameter;
    const known = this.#opened !== undefined && (this.#opened !== null || this.parameter.optional);
    this.back.hidden = !changed || !known;
    const text = this.#opened === null ? "as before" : `${shown(this.#opened)} ${unit}`.trim();
    this.back.title = `Back to ${text}`;
    this.back.setAttribute("aria-label", `${label}: back to ${text}`);
  }

  enable(enabled) {
    for (const control of [this.range, this.field]) control.disabled = !enabled;
  }

  /** Says what is wrong with the value; an empty text says nothing is. */
  showProblem(text) {
    setText(this.problem, text);
    this.problem.hidden = !text;
    this.row.classList.toggle("has-problem", Boolean(text));
    for (const control of [this.range, this.field])
      control.setAttribute("aria-invalid", String(Boolean(text)));
  }

  /** Shows what a small step does; null where that is not known. */
  showSensitivity(sensitivity) {
    const text = sensitivity ? sensitivityText(this.parameter, sensitivity) : "";
    setText(this.arrow, text);
    this.arrow.dataset.direction = sensitivity ? Math.sign(sensitivity.angle_per_unit) : 0;
  }

  #build() {
    const { parameter, id } = this;
    this.field = this.#numberField();
    this.range = this.#slider();
    this.back = element(
      "button",
      { type: "button", class: "back", hidden: true, click: () => this.#set(this.#opened) },
      "↺",
    );
    this.arrow = element("span", { class: "sensitivity", id: `${id}-sensitivity` });
    this.meaning = element("p", { class: "meaning", id: `${id}-meaning` }, parameter.meaning ?? "");
    this.problem = element("p", { class: "problem", id: `${id}-problem`, hidden: true });
    this.row = element(
      "div",
      { class: "slider-row", "data-parameter": parameter.name },
      element(
        "div",
        { class: "slider-head" },
        element("label", { for: `${id}-range` }, parameter.label),
        this.back,
        element(
          "span",
          { class: "entry" },
          this.field,
          element("span", { class: "unit" }, parameter.unit),
        ),
      ),
      this.range,
      this.arrow,
      this.meaning,
      this.problem,
    );
  }

  #slider() {
    return element("input", {
      type: "range",
      id: `${this.id}-range`,
      "aria-describedby": this.#descriptions(),
      input: (event) => this.#move(Number(event.target.value)),
      pointerdown: () => this.#drag(true),
      pointerup: () => this.#drag(false),
      pointercancel: () => this.#drag(false),
      keydown: (event) => this.#pageKeys(event),
    });
  }

  #numberField() {
    return element("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      spellcheck: "false",
      id: `${this.id}-field`,
      "aria-label": [this.parameter.label, this.parameter.unit].filter(Boolean).join(" in "),
      "aria-describedby": this.#descriptions(),
      input: () => (this.field.dataset.typing = "yes"),
      change: () => this.#typed(),
      blur: () => this.#typed(),
      keydown: (event) => this.#fieldKeys(event),
    });
  }

  #descriptions() {
    return ["meaning", "sensitivity", "problem"].map((part) => `${this.id}-${part}`).join(" ");
  }

  #applyWindow() {
    const { low, high, step } = this.#window;
    Object.assign(this.range, { min: low, max: high, step: "any" });
    this.range.dataset.step = step;
  }

  #drag(begins) {
    this.#dragging = begins;
    this.handlers.onGesture(begins);
    if (!begins) this.#window = widened(this.#window, this.parameter, this.#value);
    this.#applyWindow();
    this.range.value = this.#value;
  }

  #move(raw) {
    const { low, high, step } = this.#window;
    this.#set(Math.min(high, Math.max(low, onGrid(raw, step))));
  }

  #set(value) {
    if (value !== this.#value || value === this.#opened) this.handlers.onMove(this.name, value);
  }

  #stepBy(steps) {
    const { least, most } = this.parameter;
    const from = this.#value ?? least;
    this.#set(
      Math.min(most, Math.max(least, Number((from + steps * this.#window.step).toFixed(6)))),
    );
  }

  /** The slider's own keys would leave the grid, as it has none of its own. */
  #pageKeys(event) {
    const steps = {
      ArrowUp: 1,
      ArrowRight: 1,
      ArrowDown: -1,
      ArrowLeft: -1,
      PageUp: 10,
      PageDown: -10,
    }[event.key];
    if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.#stepBy(event.shiftKey ? 10 * steps : steps);
  }

  #fieldKeys(event) {
    const steps = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (steps !== undefined) {
      event.preventDefault();
      this.#typed();
      this.#stepBy(event.shiftKey ? 10 * steps : steps);
    } else if (event.key === "Enter") {
      event.preventDefault();
      this.#typed();
      this.field.select();
    } else if (event.key === "Escape") {
      this.#endTyping();
      this.showProblem("");
    }
  }

  #typed() {
    if (!this.field.dataset.typing) return;
    const { least, most, unit } = this.parameter;
    const value = parsed(this.field.value, unit);
    const bounds = `${shown(least)} to ${shown(most)} ${unit}`.trim();
    if (Number.isNaN(value))
      return this.showProblem(`“${this.field.value}” is no number; ${bounds} are possible.`);
    if (value < least || value > most)
      return this.showProblem(`${shown(value)} ${unit} is outside ${bounds}.`);
    this.#endTyping(value);
    this.showProblem("");
    this.#set(this.parameter.whole ? Math.round(value) : value);
  }

  #endTyping(value = this.#value) {
    delete this.field.dataset.typing;
    this.field.value = shown(value);
  }
}

// The same for all of a unit, so that they can be compared.
const STEPS = { mm: 0.1, MPa: 0.01 };

/** "↑ +0.1 mm: +4°, +0.1 MPa" */
export function sensitivityText(parameter, { angle_per_unit: angle, stress_per_unit: stress }) {
  const step = STEPS[parameter.unit] ?? 1;
  const arrow = angle > 0 ? "↑" : angle < 0 ? "↓" : "→";
  const parts = [`${signed(angle * step)}°`];
  if (stress !== null && stress !== undefined) parts.push(`${signed(stress * step)} MPa`);
  return `${arrow} +${shown(step)} ${parameter.unit}: ${parts.join(", ")}`;
}
