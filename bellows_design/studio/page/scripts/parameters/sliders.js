// All parameters, grouped, with the choices that are no numbers.

import { element, setText } from "../parts/elements.js";
import { withIndent } from "../model/indent.js";
import { valueOf } from "../model/values.js";
import { Choice } from "./choice.js";
import { IndentControl } from "./indent_control.js";
import { optionalControl } from "./optional_control.js";
import { SliderRow } from "./slider_row.js";

const HINTS = {
  Bubbles: "the chambers that swell, and the gaps between them",
  Tendon: "the base that joins the bubbles; it makes the finger bend",
  Fillets: "rounded edges, inside and outside",
  Indent: "a groove under every chamber, which bends more easily there",
  Load: "what the actuator must carry",
  Limits: "what an approved design must keep",
};

const FOLDED = new Set(["Limits", "Port", "Mount", "Fingertip"]);

/** The panel of all parameters in `host`, bound to a session. */
export class Sliders {
  #session;
  #host;
  #rows = new Map();
  #choices = [];
  #indent = null;
  #optional = [];
  #sensitivityRevision = -1;
  #built = null; // the design, as TOML, that the rows are for

  constructor(host, session) {
    this.#session = session;
    this.#host = host;
    session.addEventListener("start", () => this.#started());
    session.addEventListener("values", () => this.#show());
    session.addEventListener("state", () => this.#dimSensitivities());
    session.addEventListener("problems", (event) => this.#showProblems(event.detail.header));
    session.addEventListener("sensitivities", (event) =>
      this.#showSensitivities(event.detail.header),
    );
  }

  /** The same design over a new connection keeps its rows: someone may be typing in one. */
  #started() {
    const { toml } = this.#session.start;
    if (toml !== this.#built) this.#rebuild();
    this.#built = toml;
  }

  #rebuild() {
    const { start } = this.#session;
    this.#rows.clear();
    this.#choices = [];
    this.#optional = [];
    const parameters = withIndent(start.parameters);
    for (const each of parameters) this.#rows.set(each.name, this.#newRow(each));
    const names = [...new Set(parameters.map((each) => each.group))];
    const groups = names.map((name) => this.#group(name, this.#groupBody(name, parameters)));
    this.#host.replaceChildren(
      ...groups,
      this.#group("Material and printer", this.#materialBody()),
    );
  }

  #newRow(parameter) {
    const row = new SliderRow(parameter, {
      onMove: (name, value) => this.#session.move(name, value),
      onGesture: (begins) => (begins ? this.#session.beginGesture() : this.#session.endGesture()),
    });
    if (parameter.optional) this.#optional.push(optionalControl(this.#session, row));
    return row;
  }

  #group(name, body) {
    const hint = HINTS[name];
    return element(
      "details",
      { class: "group", "data-group": name, open: !FOLDED.has(name) },
      element(
        "summary",
        {},
        element("h3", {}, name),
        hint ? element("span", { class: "hint" }, hint) : null,
      ),
      element("div", { class: "group-body", role: "group", "aria-label": name }, ...body),
    );
  }

  #groupBody(name, parameters) {
    const rows = parameters
      .filter((each) => each.group === name)
      .map((each) => this.#rows.get(each.name));
    if (name === "Indent") return this.#indentBody(rows);
    return rows.map((row) => row.row);
  }

  #indentBody(rows) {
    this.#indent = new IndentControl(this.#session, rows);
    return [this.#indent.element];
  }

  #materialBody() {
    const { start } = this.#session;
    this.#choices = [
      new Choice(this.#session, "material", "Material", start.materials ?? []),
      new Choice(this.#session, "printer", "Printer", start.printers ?? []),
    ];
    return this.#choices.map((choice) => choice.element);
  }

  #show() {
    const { values, opened } = this.#session;
    for (const [name, row] of this.#rows) {
      row.show(valueOf(values, name), valueOf(opened, name), this.#session.shownValue(name));
    }
    for (const choice of this.#choices) choice.show(values, opened);
    for (const control of [...this.#optional, this.#indent]) control.show();
  }

  #showProblems({ problems }) {
    const messages = grouped(problems);
    for (const [name, row] of this.#rows) row.showProblem(messages.get(name) ?? "");
    for (const choice of this.#choices) choice.showProblem(messages.get(choice.name) ?? "");
    const others = [...messages].filter(([name]) => !this.#isShown(name)).map(([, text]) => text);
    const summary = document.getElementById("problem-summary");
    setText(summary, problems.length ? summaryText(problems.length, others) : "");
    summary.hidden = !problems.length;
    if (!problems.length) this.#show();
  }

  #isShown(name) {
    return this.#rows.has(name) || this.#choices.some((choice) => choice.name === name);
  }

  #showSensitivities({ sensitivities, revision }) {
    this.#sensitivityRevision = revision;
    const found = new Map(sensitivities.map((each) => [each.parameter, each]));
    for (const [name, row] of this.#rows) row.showSensitivity(found.get(name) ?? null);
    this.#dimSensitivities();
  }

  /** Derivatives belong to the design they were computed for. */
  #dimSensitivities() {
    const stale = this.#sensitivityRevision !== this.#session.revision;
    this.#host.classList.toggle("stale-sensitivities", stale);
  }
}

function grouped(problems) {
  const messages = new Map();
  for (const { parameter, message } of problems) {
    const before = messages.get(parameter ?? "");
    messages.set(parameter ?? "", before && before !== message ? `${before} ${message}` : message);
  }
  return messages;
}

function summaryText(count, others) {
  const start = "These values do not go together; the last valid shape stays in view.";
  if (others.length) return `${start} ${others.join(" ")}`;
  const reasons = count === 1 ? "The reason stands" : "The reasons stand";
  return `${start} ${reasons} at the parameter concerned.`;
}
