// The 3D view: the shape while sliders move, and the deformed one once it is computed.

import { setText } from "../parts/elements.js";
import { GHOST, fieldNames, withGhost } from "./scenes_shown.js";

const INFLATING_MS = 300;

/**
 * Shows the session's shapes with `viewer`, a `Bellows.Viewer`; `unpack` makes a scene of a message.
 *
 * Events: `scene`, when another scene is shown; `blend`, when the share of the pressure changed.
 */
export class View extends EventTarget {
  #session;
  #viewer;
  #unpack;
  #host;
  #rest = null; // {scene, revision}
  #deformed = null;
  #ghost = null; // {rest, deformed}
  #frame = 0;

  mode = "pressure"; // or "printed"
  blend = 1;
  field = undefined; // undefined: the first there is; null: none

  constructor(host, session, { viewer, unpack, note }) {
    super();
    this.#session = session;
    this.#viewer = viewer;
    this.#unpack = unpack;
    this.#host = host;
    this.note = note;
    session.addEventListener("start", () => this.#forget());
    session.addEventListener("shape", (event) => this.#take(event.detail, "rest"));
    session.addEventListener("deformed", (event) => this.#take(event.detail, "deformed"));
    session.addEventListener("state", () => this.#showState());
  }

  /** The scene that is shown, without the pinned one; null before the first. */
  get scene() {
    return this.#chosen()?.scene ?? null;
  }

  /** Whether the deformed shape of the design on the sliders is known. */
  get hasDeformed() {
    return this.#deformed !== null && this.#deformed.revision === this.#session.revision;
  }

  /** What is known of the design on the sliders, to be pinned. */
  get snapshot() {
    return { rest: this.#rest?.scene ?? null, deformed: this.hasDeformed ? this.#deformed.scene : null };
  }

  setMode(mode) {
    this.mode = mode;
    this.#show();
  }

  setBlend(blend) {
    cancelAnimationFrame(this.#frame);
    this.blend = blend;
    if (this.mode === "pressure" && this.hasDeformed) this.#viewer.setFrame(blend);
    this.dispatchEvent(new CustomEvent("blend"));
  }

  setField(name) {
    this.field = name;
    this.#applyField();
  }

  setSection(section) {
    this.#viewer.setSection(section);
  }

  setGhost(snapshot) {
    this.#ghost = snapshot;
    this.#show();
  }

  showGhost(visible) {
    for (const { name } of this.#shownGhosts()) this.#viewer.setVisible(name, visible);
  }

  resetView() {
    this.#viewer.resetView();
  }

  #forget() {
    this.#deformed = null;
    this.#fresh = true;
  }

  #fresh = true; // the next scene is of another design: the camera turns to it

  async #take({ header, payload }, kind) {
    const scene = await this.#unpack(payload);
    const { revision } = header;
    if (kind === "rest") {
      if (this.#rest && revision < this.#rest.revision) return;
      this.#rest = { scene, revision };
    } else {
      if (revision !== this.#session.revision) return;
      const first = !this.hasDeformed;
      this.#deformed = { scene, revision };
      if (first && this.mode === "pressure") return this.#inflate();
    }
    this.#show();
  }

  #chosen() {
    return this.mode === "pressure" && this.hasDeformed ? this.#deformed : this.#rest;
  }

  #show() {
    const chosen = this.#chosen();
    if (!chosen) return;
    const deformed = chosen === this.#deformed;
    const ghost = this.#ghost && (deformed ? (this.#ghost.deformed ?? this.#ghost.rest) : this.#ghost.rest);
    this.#viewer.show(withGhost(chosen.scene, ghost), { keepView: !this.#fresh });
    this.#fresh = false;
    if (deformed) this.#viewer.setFrame(this.blend);
    this.#applyField();
    this.#showState();
    this.dispatchEvent(new CustomEvent("scene"));
  }

  #applyField() {
    if (!this.scene) return;
    const names = fieldNames(this.scene);
    const wanted = this.field === undefined ? (names[0] ?? null) : this.field;
    this.#viewer.setField(names.includes(wanted) ? wanted : null);
  }

  /** The finger bends from rest to the pressure, unless motion is unwanted. */
  #inflate() {
    const target = this.blend;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.blend = still ? target : 0;
    this.#show();
    if (still) return;
    const begin = performance.now();
    const step = (now) => {
      const share = Math.min(1, (now - begin) / INFLATING_MS);
      this.blend = target * share * (2 - share);
      this.#viewer.setFrame(this.blend);
      if (share < 1) this.#frame = requestAnimationFrame(step);
    };
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(step);
  }

  #shownGhosts() {
    return this.#ghost ? [{ name: GHOST }] : [];
  }

  /** What is seen, and whether it is the design on the sliders. */
  #showState() {
    const { state } = this.#session;
    this.#host.classList.toggle("dimmed", state === "invalid");
    const atRest = this.mode === "pressure" && !this.hasDeformed;
    const texts = {
      invalid: "the last valid shape",
      failed: "at rest: there is no deformed shape of this design",
    };
    const waiting = atRest && this.#rest ? "at rest; the deformed shape follows" : "";
    setText(this.note, texts[state] ?? waiting);
  }
}
