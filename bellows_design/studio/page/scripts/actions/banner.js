// Says when the connection is lost and why, and when it is back.

import { byId, setText } from "../parts/elements.js";

const GIVE_UP = 5; // failures, some ten seconds
const BACK_MS = 3000;

// Codes by which the studio closes a connection.
const ENDED = 1001;
const FULL = 1013;

const LOST = "The connection with the studio is lost. Trying again…";

const GONE =
  "If it was ended, start it again with “bellows studio” and open the address that it prints; " +
  "your changes stay here until this page is closed.";

export class Banner {
  #wasLost = false;
  #wasEnded = false;

  constructor(session) {
    this.element = byId("banner");
    session.addEventListener("connection", (event) => this.#show(event.detail));
  }

  #show({ open, failures, code, reason }) {
    if (open && !this.#wasLost) return;
    this.#wasLost = !open;
    this.#wasEnded = !open && (this.#wasEnded || code === ENDED);
    this.element.hidden = false;
    this.element.dataset.level = open ? "pass" : "fail";
    setText(this.element, open ? "Connected again." : this.#whyLost(failures, code, reason));
    if (open) setTimeout(() => (this.element.hidden = !this.#wasLost), BACK_MS);
  }

  #whyLost(failures, code, reason) {
    if (code === FULL) return `${reason}. Trying again…`;
    if (this.#wasEnded) return `The studio has ended. ${GONE}`;
    return failures < GIVE_UP ? LOST : `The studio does not answer. ${GONE}`;
  }
}
