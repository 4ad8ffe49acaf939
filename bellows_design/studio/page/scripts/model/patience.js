// How long nothing may be heard of an answer that is waited for.

export const PATIENCE_MS = 6000;
const LONGEST_MS = 60_000;

/** Calls `ask` after a silence, and again after ever longer ones, as long as it returns true. */
export class Patience {
  #ask;
  #timer = 0;
  #wait = PATIENCE_MS;

  constructor(ask) {
    this.#ask = ask;
  }

  /** An answer is waited for from now on. */
  begin() {
    this.#wait = PATIENCE_MS;
    this.#restart();
  }

  /** Something came; whether more is waited for. */
  heard(waits) {
    if (!waits) this.end();
    else if (this.#timer) this.begin();
  }

  end() {
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  #restart() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#ended(), this.#wait);
  }

  #ended() {
    this.#timer = 0;
    this.#wait = Math.min(LONGEST_MS, 2 * this.#wait);
    if (this.#ask()) this.#restart();
  }
}
