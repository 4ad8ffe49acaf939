// The printability rules as lights, and the verdict in a sentence.

import { element, setText } from "../parts/elements.js";
import { readable } from "../parts/words.js";

const ORDER = ["fail", "warn"];
const FOLDED = new Set(["info", "pass"]);
const SIGNS = { fail: "✕", warn: "!", info: "i", pass: "✓" };
const NAMES = { pass: ["rule kept", "rules kept"], info: ["note", "notes"] };

const SENTENCES = {
  pass: (preview) =>
    preview ? "Holds, as far as the preview can say." : "Fit to be printed and to hold.",
  fail: (preview) => (preview ? "Would not be approved, by the preview:" : "Not approved:"),
  undecided: (preview) =>
    preview
      ? "Too close to a limit for the preview; the refined answer decides:"
      : "Too close to a limit to be decided at this accuracy:",
  unknown: () => "Not yet known.",
};

const SOURCES = {
  true: "measured on the part",
  false: "by the declared numbers; the part itself is measured once the sliders rest",
};
const WORDS = { fail: "fails", warn: "warning", info: "note", pass: "passes" };

export class Lights {
  #session;
  #sets = new Map(); // "declared" and "measured" → {revision, lights}

  constructor(host, session) {
    this.#session = session;
    this.verdict = element("p", { class: "verdict", id: "verdict", role: "status" });
    this.reasons = element("ul", { class: "reasons", id: "reasons" });
    this.lights = element("div", { class: "lights", id: "lights" });
    this.source = element("p", { class: "how", id: "lights-source" });
    host.append(
      element("h2", {}, "Verdict"),
      this.verdict,
      this.reasons,
      element("h2", {}, "Can it be printed?"),
      this.source,
      this.lights,
    );
    session.addEventListener("start", () => this.#sets.clear());
    session.addEventListener("lights", (event) => this.#take(event.detail.header));
    session.addEventListener("state", () => this.#show());
    session.addEventListener("working", (event) => this.#part(event.detail.header, "measuring…"));
    session.addEventListener("failed", (event) => this.#part(event.detail.header, "not measured:"));
    this.#show();
  }

  #take({ source, lights, revision }) {
    if (source === "declared") this.#sets.delete("measured");
    this.#sets.set(source, { lights, revision });
    const { lights: found } = this.#current();
    const isOpen = (verdict) =>
      this.lights.querySelector(`details[data-verdict="${verdict}"]`)?.open ?? false;
    const notes = [...FOLDED].map((verdict) => folded(found, verdict, isOpen(verdict)));
    this.lights.replaceChildren(...sorted(found), ...notes);
    this.#show();
  }

  /** How far the measured rules are, while the declared ones are shown. */
  #part({ what, message }, text) {
    if (what !== "part" || this.#sets.has("measured")) return;
    setText(this.source, `by the declared numbers; the part itself: ${text} ${message ?? ""}`);
  }

  #current() {
    return this.#sets.get("measured") ?? this.#sets.get("declared");
  }

  #show() {
    this.#showVerdict();
    const found = this.#current();
    if (!found) return;
    const old = found.revision !== this.#session.revision;
    this.lights.classList.toggle("stale", old);
    setText(this.source, old ? "out of date" : SOURCES[this.#sets.has("measured")]);
  }

  /** Reasons that stand among the rules below are told in one line. */
  #withoutRules(reasons) {
    const rules = new Set((this.#current()?.lights ?? []).map((light) => light.message));
    const others = reasons.filter((reason) => !rules.has(reason));
    const count = reasons.length - others.length;
    if (!count) return reasons;
    return [
      `It cannot be printed as it is: ${count} ${count === 1 ? "finding" : "findings"} below.`,
      ...others,
    ];
  }

  #showVerdict() {
    const { answer, state, problems } = this.#session;
    const { level, text, reasons } = verdictOf(answer, state, problems);
    this.verdict.dataset.level = level;
    setText(this.verdict, text);
    this.reasons.replaceChildren(
      ...this.#withoutRules(reasons).map((reason) => element("li", {}, reason)),
    );
  }
}

function verdictOf(answer, state, problems) {
  if (state === "invalid") {
    return {
      level: "fail",
      text: "No valid design.",
      reasons: problems.map((each) => each.message),
    };
  }
  if (!answer) return { level: "unknown", text: "Not yet known.", reasons: [] };
  const reasons = [
    ...(answer.reasons ?? []),
    ...(answer.warnings ?? []).map((each) => `Note: ${each}`),
  ];
  const level = answer.verdict in SENTENCES ? answer.verdict : "unknown";
  return { level, text: SENTENCES[level](answer.state === "preview"), reasons };
}

function sorted(lights) {
  const shown = lights.filter((light) => !FOLDED.has(light.verdict));
  shown.sort((one, other) => ORDER.indexOf(one.verdict) - ORDER.indexOf(other.verdict));
  return shown.map(row);
}

/** Rules that are kept, or notes, folded away. */
function folded(lights, verdict, isOpen) {
  const found = lights.filter((light) => light.verdict === verdict);
  if (!found.length) return "";
  const count = new Set(found.map((light) => light.rule)).size;
  const [one, more] = NAMES[verdict];
  return element(
    "details",
    { class: "folded", "data-verdict": verdict, open: isOpen },
    element("summary", {}, sign(verdict), `${count} ${count === 1 ? one : more}`),
    ...found.map(row),
  );
}

function row(light) {
  return element(
    "div",
    { class: "light", "data-verdict": light.verdict, "data-rule": light.rule },
    sign(light.verdict),
    element("span", { class: "light-rule" }, readable(light.rule)),
    element("span", { class: "light-message" }, light.message ?? ""),
  );
}

function sign(verdict) {
  const word = element("span", { class: "for-readers" }, WORDS[verdict] ?? verdict);
  return element(
    "span",
    { class: "sign", "data-verdict": verdict },
    element("span", { "aria-hidden": "true" }, SIGNS[verdict] ?? "?"),
    word,
  );
}
