// A pinned design: its shape stays in view as a ghost, the figures show the difference.

import { byId, element, setText } from "../parts/elements.js";
import { fixed, shown } from "../model/numbers.js";
import { AUTOMATIC, readable } from "../parts/words.js";
import { changedValues, same } from "../model/values.js";

export class Compare {
  #session;
  #view;
  #figures;
  #pin = null; // {start, values, revision, answer, snapshot}

  constructor(session, view, figures) {
    this.#session = session;
    this.#view = view;
    this.#figures = figures;
    this.card = byId("pinned");
    this.text = byId("pinned-text");
    byId("pin").addEventListener("click", () => this.pin());
    byId("pinned-remove").addEventListener("click", () => this.remove());
    byId("pinned-take").addEventListener("click", () => session.takeUp(this.#pin));
    session.addEventListener("answer", () => this.#complete());
    view.addEventListener("scene", () => this.#complete());
    session.addEventListener("values", () => this.#show());
  }

  pin() {
    const { start, values, revision, answer } = this.#session;
    if (!start) return;
    this.#pin = { start, values, revision, answer, snapshot: this.#view.snapshot };
    this.#apply();
  }

  remove() {
    this.#pin = null;
    this.#apply();
    byId("pin").focus();
  }

  /** Figures and shapes that came after the design was pinned. */
  #complete() {
    const pin = this.#pin;
    if (!pin || pin.revision !== this.#session.revision) return;
    const { snapshot } = this.#view;
    const more =
      this.#session.answer !== pin.answer || (snapshot.deformed && !pin.snapshot.deformed);
    if (!more) return;
    this.#pin = { ...pin, answer: this.#session.answer ?? pin.answer, snapshot };
    this.#apply();
  }

  #apply() {
    this.card.hidden = !this.#pin;
    this.#figures.compare(this.#pin?.answer ?? null);
    this.#showGhost();
    this.#show();
  }

  #showGhost() {
    const wanted = this.#pin && !this.#isCurrent();
    const snapshot = wanted ? this.#pin.snapshot : null;
    if (snapshot === this.#shownGhost) return;
    this.#shownGhost = snapshot;
    this.#view.setGhost(snapshot);
  }

  #shownGhost = null;

  #isCurrent() {
    return this.#pin.start === this.#session.start && same(this.#pin.values, this.#session.values);
  }

  #show() {
    if (!this.#pin) return;
    this.#showGhost();
    const { answer } = this.#pin;
    const figures = answer
      ? `${fixed(answer.bending_angle_deg, 1)}°, ${fixed(answer.max_von_mises_mpa, 2)} MPa`
      : "not computed";
    setText(this.text, this.#isCurrent() ? `${figures}; change something to compare` : figures);
    byId("pinned-differences").replaceChildren(...this.#differences());
  }

  #differences() {
    const changed = Object.keys(changedValues(this.#session.values, this.#pin.values));
    return changed.map((name) => {
      const [before, now] = [this.#pin.values[name], this.#session.values[name]].map((value) => text(name, value));
      return element("li", {}, `${readable(name)}: ${before} → ${now}`);
    });
  }
}

function text(name, value) {
  if (value === null || value === undefined) return AUTOMATIC[name] ?? "none";
  if (typeof value === "number") return shown(value);
  return typeof value === "string"
    ? readable(value)
    : `${value.side} ${value.shape}, ${shown(value.depth)} × ${shown(value.width)} mm`;
}
