// Run and download: the whole path to an approved part, with its progress, verdict and files.

import { byId, element, setText } from "../parts/elements.js";
import { capitalised } from "../parts/words.js";

export class Exporting {
  #session;
  #running = false;

  constructor(session) {
    this.#session = session;
    this.dialog = byId("run-dialog");
    this.status = byId("run-status");
    this.bar = byId("run-progress");
    byId("run").addEventListener("click", () => this.show());
    session.addEventListener("working", (event) => this.#working(event.detail.header));
    session.addEventListener("ran", (event) => this.#ran(event.detail.header));
    session.addEventListener("failed", (event) => this.#failed(event.detail.header));
    session.addEventListener("values", () => this.#changed());
    session.addEventListener("connection", (event) => this.#connection(event.detail));
  }

  show() {
    this.dialog.showModal();
    if (this.#running) return;
    if (!this.#session.ask({ type: "run" })) return this.#end("The studio is not connected.");
    this.#running = true;
    this.bar.hidden = false;
    this.bar.removeAttribute("value");
    for (const id of ["run-reasons", "run-files"]) byId(id).replaceChildren();
    delete this.status.dataset.level;
    setText(this.status, "Checking, solving, slicing and writing the files; this takes a while…");
  }

  #working({ what, fraction, message }) {
    if (what !== "run" || !this.#running) return;
    if (message) setText(this.status, `${capitalised(message)}…`);
    if (fraction === null || fraction === undefined) this.bar.removeAttribute("value");
    else this.bar.value = fraction;
  }

  #ran({ approved, reasons, warnings, not_judged: open, files }) {
    this.#end(
      approved
        ? "Approved. The part is ready to be printed."
        : "Not approved, and so nothing was written:",
    );
    this.status.dataset.level = approved ? "pass" : "fail";
    const lines = [reasons, open, warnings].flatMap((each) => each ?? []);
    byId("run-reasons").replaceChildren(...lines.map((line) => element("li", {}, line)));
    byId("run-files").replaceChildren(...(files ?? []).map(link));
  }

  #failed({ what, message }) {
    if (what === "run") this.#end(message);
  }

  #changed() {
    if (this.#running) this.#end("The design changed meanwhile; run again.");
  }

  #connection({ open }) {
    if (!open && this.#running)
      this.#end("The connection was lost meanwhile; run again once it is back.");
  }

  #end(text) {
    this.#running = false;
    this.bar.hidden = true;
    setText(this.status, text);
  }
}

function link({ name, href }) {
  return element("li", {}, element("a", { href: withToken(href), download: name }, name));
}

/** The token of the page's own address, where it has one still. */
function withToken(href) {
  return location.search && !href.includes("?") ? href + location.search : href;
}
