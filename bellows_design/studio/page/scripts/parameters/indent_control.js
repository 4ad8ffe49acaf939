// The indent: whether there is one, on which side, of which shape, and its lengths.

import { element, option } from "../parts/elements.js";
import { onGrid } from "../model/numbers.js";

const LEAST_WALL = 0.4;
const FULL_DEPTH = 0.5;
const FULL_WIDTH = 2;

export class IndentControl {
  #session;
  #rows;
  #last = null; // the indent before it was switched off

  constructor(session, rows) {
    this.#session = session;
    this.#rows = rows;
    this.box = element("input", {
      type: "checkbox",
      id: "indent-on",
      change: () => this.#switch(),
    });
    this.side = this.#select("indent-side", ["outside", "inside"], () => this.#sideChosen());
    this.shape = this.#select("indent-shape", ["arc", "rectangular"], () => this.#shapeChosen());
    this.details = element(
      "div",
      { class: "indent-details" },
      element(
        "div",
        { class: "pair" },
        element("label", { for: "indent-side" }, "Side", this.side),
        element("label", { for: "indent-shape" }, "Shape", this.shape),
      ),
      ...rows.map((row) => row.row),
    );
    const label = element(
      "label",
      { class: "check", for: "indent-on" },
      this.box,
      " Indent in the bottom wall",
    );
    this.element = element("div", {}, label, this.details);
  }

  show() {
    const { indent } = this.#session.values;
    this.box.checked = indent !== null;
    this.details.hidden = indent === null;
    if (!indent) return;
    this.#last = indent;
    this.side.value = indent.side;
    this.shape.value = indent.shape;
    this.shape.querySelector("[value=arc]").disabled = indent.side === "inside";
    for (const row of this.#rows)
      row.row.hidden = row.name === "indent.fillet" && indent.shape === "arc";
  }

  #select(id, names, changed) {
    return element("select", { id, change: changed }, ...names.map((name) => option(name, name)));
  }

  #switch() {
    const { opened } = this.#session;
    this.#set(this.box.checked ? (this.#last ?? opened.indent ?? this.#first()) : null);
  }

  /** One that fits into the walls as they are. */
  #first() {
    const { values } = this.#session;
    const wall = Math.min(values.bubble_thickness, values.tendon_thickness);
    const width = Math.min(FULL_WIDTH, values.chamber_length + 2 * values.bubble_thickness);
    const depth = Math.min(FULL_DEPTH, width / 2, wall - LEAST_WALL);
    return {
      side: "outside",
      shape: "arc",
      depth: Math.max(0.05, onGrid(depth, 0.05)),
      width,
      fillet: 0,
    };
  }

  /** An inside indent is rectangular and lies within the chamber. */
  #sideChosen() {
    const { indent, chamber_length: room } = this.#session.values;
    const inside = { shape: "rectangular", width: Math.min(indent.width, room) };
    this.#set({
      ...indent,
      side: this.side.value,
      ...(this.side.value === "inside" ? inside : {}),
    });
  }

  /** An arc has no corners to round. */
  #shapeChosen() {
    const { indent } = this.#session.values;
    const shape = this.shape.value;
    this.#set({ ...indent, shape, fillet: shape === "arc" ? 0 : indent.fillet });
  }

  #set(indent) {
    this.#session.move("indent", indent);
  }
}
