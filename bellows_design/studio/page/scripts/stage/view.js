// The 3D view: the shape while sliders move, and the deformed one once it is computed.

import { setText } from "../parts/elements.js";
import { differsMuch, firstField, withGhost } from "./scenes_shown.js";

const INFLATING_MS = 300;

/**
 * Shows the session's shapes with `viewer`, a `Bellows.Viewer`; `unpack` makes a scene of a
 * message's payload.
 *
 * Event: `scene`, when another scene or another share of the pressure is shown.
 */
export class View extends EventTarget {
  #session;
  #viewer;
  #unpack;
  #host;
  #note;
  #known = { rest: null, deformed: null }; // {scene, revision} each
  #fields = { rest: null, deformed: undefined }; // as chosen; undefined: the first there is
  #shown = null; // "rest" or "deformed"
  #ghost = null; // {rest, deformed}
  #box = null; // that the camera was turned to
  #frame = 0;
  #awaited = null; // revision whose shape at rest follows later

  mode = "pressure"; // or "printed"
  blend = 1;

  constructor(host, session, { viewer, unpack, note }) {
    super();
    this.#session = session;
    this.#viewer = viewer;
    this.#unpack = unpack;
    this.#host = host;
    this.#note = note;
    session.addEventListener("start", () => (this.#box = null));
    session.addEventListener("shape", (event) => this.#take(event.detail, "rest"));
    session.addEventListener("shape_follows", (event) => this.#wait(event.detail.header));
    session.addEventListener("deformed", (event) => this.#take(event.detail, "deformed"));
    session.addEventListener("state", () => this.#showState());
  }

  /** Whether the deformed shape of the design on the sliders is known. */
  get hasDeformed() {
    return this.#known.deformed?.revision === this.#session.revision;
  }

  /** What is known of the design on the sliders, to be pinned. */
  get snapshot() {
    const { rest, deformed } = this.#known;
    return { rest: rest?.scene ?? null, deformed: this.hasDeformed ? deformed.scene : null };
  }

  setMode(mode) {
    this.mode = mode;
    this.#show();
  }

  setBlend(blend) {
    cancelAnimationFrame(this.#frame);
    this.blend = blend;
    if (this.#shown === "deformed") this.#viewer.setFrame(blend);
    this.dispatchEvent(new CustomEvent("scene"));
  }

  setGhost(snapshot) {
    this.#ghost = snapshot;
    this.#show();
  }

  resetView() {
    this.#viewer.resetView();
  }

  toggleSection() {
    this.#viewer.setSection({ on: !this.#viewer.section.on });
  }

  async #take({ header, payload }, kind) {
    const { revision } = header;
    const scene = await this.#unpack(payload);
    if (revision < (this.#known[kind]?.revision ?? -1)) return;
    if (kind === "deformed" && revision !== this.#session.revision) return;
    const isFirst = kind === "deformed" && !this.hasDeformed;
    this.#known[kind] = { scene, revision };
    if (isFirst && this.mode === "pressure") this.#inflate();
    else this.#show();
  }

  #show() {
    const kind = this.mode === "pressure" && this.hasDeformed ? "deformed" : "rest";
    const { scene } = this.#known[kind] ?? {};
    if (!scene) return;
    this.#keepField();
    this.#shown = kind;
    const ghost = this.#ghost && (this.#ghost[kind] ?? this.#ghost.rest);
    this.#viewer.show(withGhost(scene, ghost), { keepView: true });
    const field = this.#fields[kind];
    this.#viewer.setField(field === undefined ? firstField(scene) : field, this.#scale(kind));
    if (kind === "deformed") this.#viewer.setFrame(this.blend);
    this.#fit();
    this.#showState();
    this.dispatchEvent(new CustomEvent("scene"));
  }

  /** Stress is coloured from zero to its limit, so that designs can be compared by their colours. */
  #scale(kind) {
    const limit = this.#session.answer?.stress_limit_mpa;
    return kind === "deformed" && limit ? { low: 0, high: limit, limit } : {};
  }

  /** Each of both shapes keeps the colours that were chosen for it in the viewer's own bar. */
  #keepField() {
    if (this.#shown) this.#fields[this.#shown] = this.#viewer.field;
  }

  /** The camera follows the part as long as nobody has turned it, but not at every small step. */
  #fit() {
    const { bounds } = this.#viewer;
    if (this.#box && (this.#viewer.touched || !differsMuch(bounds, this.#box))) return;
    if (this.#box && this.#shown === "rest" && this.mode === "pressure") return;
    this.#box = bounds;
    this.#viewer.resetView();
  }

  /** The finger bends from rest to the pressure, unless motion is unwanted. */
  #inflate() {
    cancelAnimationFrame(this.#frame);
    const target = this.blend;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches || target === 0) return this.#show();
    this.#show();
    const begin = performance.now();
    const step = (now) => {
      const share = Math.min(1, Math.max(0, (now - begin) / INFLATING_MS));
      this.#viewer.setFrame(target * share * (2 - share));
      if (share < 1) this.#frame = requestAnimationFrame(step);
    };
    step(begin);
  }

  /** The design has other faces than what is shown: it is pale until its own shape is there. */
  #wait({ revision }) {
    this.#awaited = revision;
    this.#showState();
  }

  get #isAwaited() {
    return this.#awaited === this.#session.revision && !this.#isKnown;
  }

  get #isKnown() {
    const { rest, deformed } = this.#known;
    return [rest, deformed].some((each) => each?.revision === this.#session.revision);
  }

  /** What is seen, and whether it is the design on the sliders. */
  #showState() {
    const { state } = this.#session;
    this.#host.classList.toggle("dimmed", state === "invalid" || this.#isAwaited);
    setText(this.#note, this.#noteText(state));
  }

  #noteText(state) {
    if (state === "invalid") return "the last valid shape";
    if (state === "failed") return "at rest: no deformed shape of this design is known";
    if (this.#isAwaited) return this.#shown ? "the shape before; this one follows" : "";
    const follows = this.mode === "pressure" && !this.hasDeformed && this.#shown;
    return follows ? "at rest; the deformed shape follows" : "";
  }
}
