// The design being changed: its values, revisions, and which answers belong to it.

import { History } from "./history.js";
import { Patience } from "./patience.js";
import { changedValues, openedValues, same, valueOf, withValue } from "./values.js";

export const REST_MS = 120;

// These speak of one revision only; once the sliders have moved on they say nothing any more.
const OF_ONE_REVISION = new Set([
  "problems",
  "lights",
  "shape_follows",
  "answer",
  "deformed",
  "sensitivities",
  "scene",
  "working",
  "failed",
  "ran",
]);

// What fails without a figure: nothing more comes for the design.
const ENDING = new Set(["change", "refine"]);

/**
 * States of the figures: "waiting" (no connection yet), "moving", "computing", "preview",
 * "refined", "invalid", "failed".
 *
 * Events: `start` (a design was opened), `values` (they changed), `state`, `rest`, `history`,
 * `asked_again` (no answer came in good time), `connection` with detail
 * `{open, failures, code, reason}`, and every message of the server under its type, with detail
 * `{header, payload}`.
 */
export class Session extends EventTarget {
  #connection;
  #history = new History();
  #restTimer = 0; // of a rest that is still to come, or 0
  #patience = new Patience(() => this.#askAgain());
  #frame = 0;
  #gesture = null;
  #gestures = 0;
  #shapeRevision = -1;
  #opening = null; // `{message, values}` of a design that was asked for, until it is open

  #current = {}; // numbers of the last valid design, by name

  start = null;
  opened = {};
  values = {};
  revision = 0;
  state = "waiting";
  answer = null; // of this revision
  problems = [];

  constructor(connection) {
    super();
    this.#connection = connection;
    connection.addEventListener("message", (event) => this.#receive(event.detail));
    connection.addEventListener("lost", (event) => this.#lost(event.detail));
  }

  get canUndo() {
    return this.#history.canUndo;
  }

  get canRedo() {
    return this.#history.canRedo;
  }

  get isConnected() {
    return this.#connection.isOpen;
  }

  get isChanged() {
    return Object.keys(changedValues(this.values, this.opened)).length > 0;
  }

  valueOf(name) {
    return valueOf(this.values, name);
  }

  /** The design's number, also where it follows from others, as full rounds of fillets do. */
  shownValue(name) {
    const value = this.valueOf(name);
    if (value !== null && value !== valueOf(this.opened, name)) return value;
    return this.#current[name] ?? value;
  }

  /** One value moved: the shape follows at once, the rest after the sliders have rested. */
  move(name, value) {
    this.moveAll(withValue(this.values, name, value));
  }

  moveAll(values) {
    if (same(values, this.values)) return;
    this.values = values;
    if (this.#opening?.message.text === this.start.toml) this.#opening.values = values;
    this.revision += 1;
    this.#forget();
    this.#setState("moving");
    this.#emit("values");
    this.#sendSoon();
    this.#patience.end();
    clearTimeout(this.#restTimer);
    this.#restTimer = setTimeout(() => this.#rest(), REST_MS);
  }

  /** From here to `endGesture` rests are one step of the history; what came before is another. */
  beginGesture() {
    this.settle();
    this.#gestures += 1;
    this.#gesture = this.#gestures;
  }

  endGesture() {
    // A rest that is still to come belongs to it as well.
    const ended = this.#gesture;
    setTimeout(() => {
      if (this.#gesture === ended) this.#gesture = null;
    }, 2 * REST_MS);
  }

  /** Back to the design that was opened; can be undone. */
  reset() {
    this.moveAll(this.opened);
    this.#restNow();
  }

  undo() {
    this.settle();
    this.#go(this.#history.undo());
  }

  redo() {
    this.settle();
    this.#go(this.#history.redo());
  }

  /** A design of before, such as a pinned one, as a new step. */
  takeUp({ start, values }) {
    if (start.toml !== this.start.toml)
      return this.#openBy({ type: "open_toml", text: start.toml }, values);
    this.moveAll(values);
    this.#restNow();
  }

  open(design) {
    this.#openBy({ type: "open", design });
  }

  openText(text) {
    this.#openBy({ type: "open_toml", text });
  }

  /**
   * Takes what the sliders say as their rest, should they not have rested yet; also what is known to
   * be invalid by then, or undo would go back by two steps.
   */
  settle() {
    if (this.#restTimer) this.#restNow();
  }

  /** Asks for something that belongs to the design as it is. */
  ask(message) {
    this.settle();
    return this.#connection.send({ ...message, revision: this.revision });
  }

  #go(entry) {
    if (!entry) return;
    if (entry.start.toml === this.start.toml) {
      this.moveAll(entry.values);
      this.#restNow(false);
    } else {
      this.#openBy({ type: "open_toml", text: entry.start.toml }, entry.values, false);
    }
    this.#emit("history");
  }

  /** Opens a design, and goes on with `values` of it unless they are null. */
  #openBy(message, values = null, isStep = true) {
    this.#endRestTimer();
    this.#patience.end();
    this.#opening = { message, values, isStep };
    this.revision += 1;
    this.#forget();
    this.#setState("computing");
    this.#connection.send({ ...message, revision: this.revision });
  }

  #restNow(isStep = true) {
    this.#rest(isStep);
  }

  #endRestTimer() {
    clearTimeout(this.#restTimer);
    this.#restTimer = 0;
  }

  #rest(isStep = true) {
    this.#endRestTimer();
    this.#flush();
    if (this.state === "moving") this.#setState("computing");
    this.#sendRest();
    this.#patience.begin();
    if (isStep && !same(this.#history.current?.values, this.values)) {
      this.#history.push({ start: this.start, values: this.values }, this.#gesture);
      this.#emit("history");
    }
    this.#emit("rest");
  }

  #sendRest() {
    return this.#connection.send({ type: "rest", revision: this.revision });
  }

  /** An answer should have come by now. A studio that is at it takes no notice of a second rest. */
  #askAgain() {
    if (this.state !== "computing" || !this.#sendRest()) return false;
    this.#emit("asked_again");
    return true;
  }

  /** One message a frame at most: what lies between is never seen. */
  #sendSoon() {
    if (!this.#frame) this.#frame = requestAnimationFrame(() => this.#flush());
  }

  #flush() {
    if (!this.#frame) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#sendValues();
  }

  #sendValues() {
    const values = changedValues(this.values, this.opened);
    this.#connection.send({ type: "change", revision: this.revision, values });
  }

  #receive({ header, payload }) {
    if (header.type === "start") return this.#started(header);
    if (OF_ONE_REVISION.has(header.type) && header.revision !== this.revision) return;
    if (header.type === "shape" && !this.#isNewShape(header)) return;
    this.#note(header);
    this.#patience.heard(this.state === "computing");
    this.#emit(header.type, { header, payload });
  }

  #isNewShape({ revision }) {
    if (revision < this.#shapeRevision || revision > this.revision) return false;
    this.#shapeRevision = revision;
    return true;
  }

  #note(header) {
    if (header.type === "problems") this.#noteProblems(header);
    if (header.type === "answer") this.#noteAnswer(header);
    if (header.type !== "failed") return;
    if (header.what === "open") this.#notOpened();
    else if (ENDING.has(header.what) && !this.answer) this.#setState("failed");
  }

  /** The design asked for cannot be opened: we go on with the one we have. */
  #notOpened() {
    if (!this.start || !this.#opening) return;
    this.#opening = null;
    this.#sendValues();
    this.#sendRest();
    this.#patience.begin();
  }

  #noteProblems({ problems, values, bubble_count: count }) {
    this.problems = problems;
    if (values) this.#current = withCount(values, count);
    if (problems.length) this.#setState("invalid");
  }

  #noteAnswer(answer) {
    if (this.answer?.state === "refined" && answer.state === "preview") return;
    this.answer = answer;
    this.#setState(answer.state);
  }

  #started(start) {
    if (this.start && start.revision !== this.revision) return this.#restore();
    const { values, isStep } = this.#opening ?? { values: null, isStep: true };
    this.#opening = null;
    this.#take(start);
    if (values && !same(values, this.values)) this.#continueWith(values, isStep);
    else if (isStep) this.#firstStep();
  }

  #take(start) {
    this.start = start;
    this.opened = openedValues(start);
    const values = start.parameters.map((each) => [each.name, each.value ?? null]);
    this.#current = withCount(Object.fromEntries(values), start.bubble_count);
    this.values = this.opened;
    this.#forget();
    this.#setState("computing");
    this.#patience.begin();
    for (const type of ["start", "values"]) this.#emit(type);
    this.#emit("connection", { open: true, failures: 0 });
  }

  #firstStep() {
    this.#history.push({ start: this.start, values: this.values });
    this.#emit("history");
  }

  #continueWith(values, isStep) {
    this.moveAll(values);
    this.#restNow(isStep);
  }

  /** A new connection knows nothing of us: it is told the design, and then the changes. */
  #restore() {
    const current = { message: { type: "open_toml", text: this.start.toml }, values: this.values };
    const { message, values, isStep } = this.#opening ?? { ...current, isStep: false };
    this.#openBy(message, values, isStep);
  }

  #lost(detail) {
    this.#patience.end();
    this.#emit("connection", { open: false, ...detail });
  }

  #forget() {
    this.answer = null;
    this.problems = [];
  }

  #setState(state) {
    this.state = state;
    this.#emit("state");
  }

  #emit(type, detail = null) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

/** The design's numbers; how many bubbles fit is told beside them. */
function withCount(values, count) {
  return { ...values, number_of_bubbles: values.number_of_bubbles ?? count ?? null };
}
