// Undo, redo, reset, save, and the design's name.

import { byId, setText } from "../parts/elements.js";

export class Toolbar {
  #session;

  constructor(session) {
    this.#session = session;
    byId("undo").addEventListener("click", () => session.undo());
    byId("redo").addEventListener("click", () => session.redo());
    byId("reset").addEventListener("click", () => session.reset());
    for (const type of ["start", "values", "history", "state", "connection"])
      session.addEventListener(type, () => this.#show());
    this.#show();
  }

  #show() {
    const { start, isChanged, canUndo, canRedo, state, isConnected } = this.#session;
    const isValid = start && state !== "invalid";
    byId("undo").disabled = !canUndo;
    byId("redo").disabled = !canRedo;
    byId("reset").disabled = !isChanged;
    for (const id of ["save", "run"]) byId(id).disabled = !isValid || !isConnected;
    byId("pin").disabled = !isValid;
    if (!start) return;
    setText(byId("design-name"), start.name);
    byId("design-changed").hidden = !isChanged;
    document.title = `${start.name}${isChanged ? " (changed)" : ""} – Bellows studio`;
  }
}
