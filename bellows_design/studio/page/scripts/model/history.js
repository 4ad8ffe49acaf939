// The states in which the sliders have rested, and where we are among them.

const LONGEST = 200;

/**
 * Entries `{start, values}`: the opened design and the values. A gesture's later rests replace its
 * first one.
 */
export class History {
  #entries = [];
  #place = -1;
  #gesture = null;

  get canUndo() {
    return this.#place > 0;
  }

  get canRedo() {
    return this.#place < this.#entries.length - 1;
  }

  /** Keeps a rest. Rests of one and the same drag are one step. */
  push(entry, gesture = null) {
    const replaces = gesture !== null && gesture === this.#gesture && this.canUndo;
    const kept = this.#entries.slice(0, replaces ? this.#place : this.#place + 1);
    this.#entries = [...kept, entry].slice(-LONGEST);
    this.#place = this.#entries.length - 1;
    this.#gesture = gesture;
  }

  /** The entry we are at, or null. */
  get current() {
    return this.#entries[this.#place] ?? null;
  }

  undo() {
    return this.#move(-1);
  }

  redo() {
    return this.#move(1);
  }

  #move(by) {
    const entry = this.#entries[this.#place + by];
    if (!entry) return null;
    this.#place += by;
    this.#gesture = null;
    return entry;
  }
}
