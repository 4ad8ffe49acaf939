// Forces: the finger free, blocked, or gripping, as a picture with figures.

import { byId, element, option, setText } from "../parts/elements.js";
import { parsed, shown, withUnit } from "../model/numbers.js";
import { capitalised, readable } from "../parts/words.js";
import { SCENES, keysOf } from "./scene_fields.js";

export class Scenes {
  #session;
  #kind = "blocked";
  #inputs = new Map();
  #picture = null; // address of the picture that is shown
  #asked = null; // revision that was asked for
  #stage = ""; // what is computed

  constructor(session) {
    this.#session = session;
    this.button = byId("scene-run");
    this.status = byId("scene-status");
    byId("scene-kinds").append(
      ...Object.entries(SCENES).map(([kind, scene]) => this.#radio(kind, scene)),
    );
    byId("scene-form").addEventListener("submit", (event) => this.#ask(event));
    session.addEventListener("scene", (event) => this.#take(event.detail.header));
    session.addEventListener("working", (event) => this.#working(event.detail.header));
    session.addEventListener("failed", (event) => this.#failed(event.detail.header));
    session.addEventListener("values", () => this.#age());
    this.#choose(this.#kind);
  }

  #radio(kind, scene) {
    const box = element("input", {
      type: "radio",
      name: "scene",
      value: kind,
      id: `scene-${kind}`,
      change: () => this.#choose(kind),
    });
    box.checked = kind === this.#kind;
    return element("label", { for: `scene-${kind}` }, box, element("span", {}, scene.label));
  }

  #choose(kind) {
    this.#kind = kind;
    setText(byId("scene-meaning"), SCENES[kind].meaning);
    const rows = SCENES[kind].fields.map((field) => this.#row(field));
    byId("scene-fields").replaceChildren(...rows);
    this.#showNeeded();
  }

  #row(field) {
    const id = `scene-field-${field.name}`;
    const described = { id, "aria-describedby": field.meaning ? `${id}-meaning` : null };
    const input = field.choices
      ? element(
          "select",
          { ...described, change: () => this.#showNeeded() },
          ...field.choices.map((name) => option(name, readable(name), name === field.value)),
        )
      : element("input", {
          ...described,
          type: "text",
          inputmode: "decimal",
          value: shown(field.value),
          autocomplete: "off",
        });
    this.#inputs.set(field.name, input);
    const unit = field.unit ? element("span", { class: "unit" }, field.unit) : null;
    return element(
      "div",
      { class: "scene-field", "data-field": field.name },
      element("label", { for: id }, field.label),
      element("span", { class: "entry" }, input, unit),
      field.meaning ? element("p", { class: "meaning shown", id: `${id}-meaning` }, field.meaning) : null,
    );
  }

  /** Keys that the chosen support does not know are hidden. */
  #showNeeded() {
    const support = this.#inputs.get("support")?.value;
    for (const field of SCENES[this.#kind].fields) {
      const row = this.#inputs.get(field.name).closest(".scene-field");
      row.hidden = Boolean(field.of) && !field.of.includes(support);
    }
  }

  #ask(event) {
    event.preventDefault();
    const keys = keysOf(this.#kind, (field) => this.#read(field));
    const wrong = SCENES[this.#kind].fields.find((field) => Number.isNaN(keys[field.name]));
    if (wrong)
      return setText(
        this.status,
        `${wrong.label} must be a number from ${wrong.least} to ${wrong.most} ${wrong.unit}.`,
      );
    if (!this.#session.ask({ type: "scene", scene: this.#kind, ...keys }))
      return setText(this.status, "The studio is not connected.");
    this.#asked = this.#session.revision;
    this.button.disabled = true;
    this.#stage = "";
    setText(this.status, "Computing…");
  }

  #read(field) {
    const { value } = this.#inputs.get(field.name);
    if (field.choices) return value;
    const number = parsed(value, field.unit);
    return number >= field.least && number <= field.most ? number : NaN;
  }

  #take({ svg, figures, message, warnings, caption }) {
    this.#finish("");
    const notes = [message, ...(warnings ?? [])].filter(Boolean).map(capitalised);
    byId("scene-notes").replaceChildren(...notes.map((note) => element("li", {}, note)));
    setText(byId("scene-caption"), caption ?? "");
    const blob = new Blob([svg], { type: "image/svg+xml" });
    const former = this.#picture;
    this.#picture = URL.createObjectURL(blob);
    byId("scene-picture").src = this.#picture;
    if (former) URL.revokeObjectURL(former);
    byId("scene-figures").replaceChildren(...rows(figures));
    byId("scene-result").hidden = false;
    byId("scene-result").classList.remove("stale");
  }

  #working({ what, fraction, message }) {
    if (what !== "scene") return;
    if (message) this.#stage = message;
    const share = fraction && fraction < 1 ? `, ${Math.round(100 * fraction)} %` : "";
    setText(this.status, `Computing… ${this.#stage}${share}`);
  }

  #failed({ what, message }) {
    if (what === "scene") this.#finish(message);
  }

  #finish(text) {
    this.button.disabled = false;
    this.#asked = null;
    setText(this.status, text);
  }

  /** The picture is of a design before the last change. */
  #age() {
    byId("scene-result").classList.add("stale");
    if (this.#asked === null || this.#asked === this.#session.revision) return;
    this.#finish("The design changed; ask again.");
  }
}

function rows(figures) {
  return figures.map(({ label, value, unit, error_percent: error }) => {
    const number = typeof value === "number" ? shown(value, 3) : String(value ?? "–");
    const band = error === null || error === undefined ? "" : ` ± ${shown(error, 2)} %`;
    return element(
      "div",
      { class: "scene-figure" },
      element("dt", {}, label),
      element("dd", {}, withUnit(number, unit) + band),
    );
  });
}
