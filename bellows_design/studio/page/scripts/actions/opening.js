// Opening a shipped design or a TOML file: from a list, a file picker, or dropped on the page.

import { byId, element, setText } from "../parts/elements.js";
import { readable } from "../parts/words.js";

const LARGEST_BYTES = 1_000_000;

export class Opening {
  #session;

  constructor(session) {
    this.#session = session;
    this.dialog = byId("open-dialog");
    this.problem = byId("open-problem");
    byId("open").addEventListener("click", () => this.show());
    byId("open-file").addEventListener("change", (event) => this.#read(event.target.files[0]));
    session.addEventListener("start", () => this.#started());
    session.addEventListener("failed", (event) => this.#failed(event.detail.header));
    this.#listenToDrops();
  }

  show() {
    setText(this.problem, "");
    this.dialog.showModal();
  }

  #started() {
    this.dialog.close();
    const designs = this.#session.start.designs ?? [];
    byId("shipped").replaceChildren(...designs.map((each) => this.#entry(each)));
  }

  #entry(design) {
    const { name, description = "" } = typeof design === "string" ? { name: design } : design;
    const label = element("strong", {}, readable(name));
    return element(
      "li",
      {},
      element(
        "button",
        { type: "button", click: () => this.#session.open(name) },
        label,
        element("span", {}, description),
      ),
    );
  }

  async #read(file) {
    if (!file) return;
    byId("open-file").value = "";
    const text = file.size > LARGEST_BYTES ? null : await file.text();
    if (text === null || sentBytes(text) > LARGEST_BYTES)
      return this.#complain(`${file.name} has more than 1 MB and is no design.`);
    this.#session.openText(text);
  }

  #failed({ what, message }) {
    if (what === "open") this.#complain(message);
  }

  #complain(message) {
    if (!this.dialog.open) this.dialog.showModal();
    setText(this.problem, message);
  }

  #listenToDrops() {
    const body = document.body;
    const hasFile = (event) => event.dataTransfer?.types.includes("Files");
    body.addEventListener("dragover", (event) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      body.classList.add("dropping");
    });
    body.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) body.classList.remove("dropping");
    });
    body.addEventListener("drop", (event) => {
      body.classList.remove("dropping");
      if (!hasFile(event)) return;
      event.preventDefault();
      this.#read(event.dataTransfer.files[0]);
    });
  }
}

/** Bytes of a text in a message, where line ends and quotes take two: the studio ends a connection
 * that sends too much, and the page would send it again. */
function sentBytes(text) {
  return new TextEncoder().encode(JSON.stringify(text)).length;
}
