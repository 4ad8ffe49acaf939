// Says when the connection is lost, and when it is back.

import { byId, setText } from "../parts/elements.js";

const GIVE_UP = 5; // failures, some ten seconds
const BACK_MS = 3000;

export class Banner {
  #wasLost = false;

  constructor(session) {
    this.element = byId("banner");
    session.addEventListener("connection", (event) => this.#show(event.detail));
  }

  #show({ open, failures }) {
    if (open && !this.#wasLost) return;
    this.element.hidden = false;
    this.element.dataset.level = open ? "pass" : "fail";
    if (open) setText(this.element, "Connected again.");
    else if (failures < GIVE_UP)
      setText(this.element, "The connection with the studio is lost. Trying again…");
    else
      setText(
        this.element,
        "The studio does not answer. If it was ended, start it again with “bellows studio” and " +
          "open the address that it prints; your changes stay here until this page is closed.",
      );
    this.#wasLost = !open;
    if (open) setTimeout(() => (this.element.hidden = !this.#wasLost), BACK_MS);
  }
}
