// Saving the design on the sliders as a TOML file.

import { byId, element } from "../parts/elements.js";

export class Saving {
  #session;

  constructor(session) {
    this.#session = session;
    byId("save").addEventListener("click", () => this.save());
  }

  save() {
    if (byId("save").disabled) return;
    const { start, revision } = this.#session;
    this.#session.settle();
    const query = new URLSearchParams(location.search);
    query.set("session", start.session ?? "");
    query.set("revision", String(revision));
    element("a", { href: `/design.toml?${query}`, download: `${start.name}.toml` }).click();
  }
}
