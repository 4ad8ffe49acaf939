// One of several named things: a material, a printer.

import { element, option, setText } from "../parts/elements.js";
import { readable } from "../parts/words.js";

export class Choice {
  /** `choices`: names, or `{name, description}`. */
  constructor(session, name, label, choices) {
    this.name = name;
    this.choices = choices.map((each) =>
      typeof each === "string" ? { name: each, description: "" } : each,
    );
    const id = `choice-${name}`;
    this.select = element("select", {
      id,
      "aria-describedby": `${id}-meaning ${id}-problem`,
      change: () => session.move(name, this.select.value),
    });
    this.meaning = element("p", { class: "meaning shown", id: `${id}-meaning` });
    this.problem = element("p", { class: "problem", id: `${id}-problem`, hidden: true });
    this.element = element(
      "div",
      { class: "choice-row", "data-parameter": name },
      element("label", { for: id }, label),
      this.select,
      this.meaning,
      this.problem,
    );
  }

  show(values, opened) {
    const names = this.choices.map((each) => each.name);
    const own = [opened[this.name], values[this.name]].filter(
      (name) => name && !names.includes(name),
    );
    const all = [...new Set([...own, ...names])];
    if (this.select.options.length !== all.length) {
      this.select.replaceChildren(...all.map((name) => option(name, readable(name))));
    }
    this.select.value = values[this.name] ?? "";
    const chosen = this.choices.find((each) => each.name === values[this.name]);
    setText(this.meaning, chosen ? (chosen.description ?? "") : "from the file that was opened");
  }

  showProblem(text) {
    setText(this.problem, text);
    this.problem.hidden = !text;
    this.select.setAttribute("aria-invalid", String(Boolean(text)));
  }
}
