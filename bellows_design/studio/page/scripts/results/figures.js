// The large figures: angle, stress against its limit, air; and how current they are.

import { element, setText } from "../parts/elements.js";
import { fixed, shown, signed, withUnit } from "../model/numbers.js";
import { capitalised } from "../parts/words.js";

const BADGES = {
  waiting: "waiting for the studio",
  moving: "out of date",
  computing: "computing…",
  preview: "preview",
  refined: "refined",
  invalid: "no valid design",
  failed: "not computed",
};

const CURRENT = new Set(["preview", "refined"]);

const ENDING = new Set(["change", "refine"]);

const ASKED_AGAIN = "No answer has come yet: the studio was asked for it again.";

export class Figures {
  #session;
  #shown = null; // the answer that stands in the figures
  #pinned = null;

  constructor(host, session) {
    this.#session = session;
    this.badge = element("span", { class: "state-badge", id: "state" });
    this.how = element("p", { class: "how", id: "how" });
    this.angle = figure("angle", "Bending angle");
    this.stress = figure("stress", "Highest stress");
    this.bar = new StressBar();
    this.air = figure("air", "Air inside");
    this.live = element("p", { class: "for-readers", role: "status", "aria-live": "polite" });
    this.angle.row.classList.add("leading");
    this.stress.row.append(this.bar.element);
    this.host = host;
    host.append(
      element("div", { class: "state-line" }, element("h2", {}, "Under pressure"), this.badge),
      this.angle.row,
      this.stress.row,
      this.air.row,
      this.how,
      this.live,
    );
    session.addEventListener("state", () => this.#state());
    session.addEventListener("working", (event) => this.#working(event.detail.header));
    session.addEventListener("failed", (event) => this.#failed(event.detail.header));
    session.addEventListener("asked_again", () => setText(this.how, ASKED_AGAIN));
    session.addEventListener("connection", () => this.#state());
    this.#state();
  }

  /** Compares with the answer of a pinned design, or with none. */
  compare(answer) {
    this.#pinned = answer;
    this.#show();
  }

  #state() {
    const { state, answer, problems } = this.#session;
    const current = CURRENT.has(state);
    this.host.dataset.state = state;
    this.host.classList.toggle("stale", !current);
    setText(this.badge, this.#badgeText(state));
    if (current) this.#take(answer);
    else setText(this.how, explanation(state, problems, this.#shown, this.#session.isConnected));
    this.#show();
  }

  #badgeText(state) {
    const lost = !this.#session.isConnected && ["moving", "computing"].includes(state);
    return lost ? "not connected" : BADGES[state];
  }

  #take(answer) {
    this.#shown = answer;
    setText(this.how, sentence(answer));
    setText(this.live, spoken(answer));
  }

  #show() {
    const answer = this.#shown;
    if (!answer) return;
    const { bending_angle_deg: angle, max_von_mises_mpa: stress, cavity_volume_mm3: air } = answer;
    const pinned = this.#pinned ?? {};
    this.angle.show(fixed(angle, 1), "°", margin(angle, answer.angle_error_percent, 1));
    this.angle.compare(difference(angle, pinned.bending_angle_deg, "°"));
    this.stress.show(fixed(stress, 2), "MPa", margin(stress, answer.stress_error_percent, 2));
    this.stress.compare(difference(stress, pinned.max_von_mises_mpa, "MPa"));
    this.air.show(fixed(air / 1000, 2), "ml", "");
    this.air.compare(difference(air / 1000, (pinned.cavity_volume_mm3 ?? NaN) / 1000, "ml"));
    this.bar.show(answer);
    this.#mark(answer);
  }

  /** Which revision the figures belong to, and whether it is the design on the sliders. */
  #mark(answer) {
    const { dataset } = this.angle.value;
    const current = CURRENT.has(this.#session.state);
    dataset.deg = String(answer.bending_angle_deg);
    dataset.revision = String(answer.revision);
    dataset.state = current ? answer.state : "old";
    const note = current ? reached(answer) : "out of date";
    for (const each of [this.angle, this.stress, this.air]) each.note(note && ` – ${note}`);
  }

  #working({ what, fraction, message }) {
    const { state } = this.#session;
    const share = fraction && fraction < 1 ? ` ${Math.round(100 * fraction)} %` : "";
    if (what === "preview" && state === "computing") setText(this.badge, `computing…${share}`);
    if (what === "preview" && message && state === "computing") setText(this.how, capitalised(message));
    if (what === "refine" && state === "computing") setText(this.badge, `refining…${share}`);
    if (what !== "refine" || state !== "preview") return;
    setText(this.badge, `preview, refining…${share}`);
  }

  #failed({ what, message }) {
    if (this.#session.state === "failed" && ENDING.has(what)) setText(this.how, message);
    else if (what === "refine") {
      setText(this.badge, BADGES[this.#session.state]);
      setText(this.how, `${sentence(this.#shown)} It was not refined: ${message}`);
    }
  }
}

function figure(id, label) {
  const note = element("span", { class: "outdated" });
  const value = element("span", { class: "value", id }, "–");
  const unit = element("span", { class: "value-unit" });
  const error = element("span", { class: "margin" });
  const compared = element("span", { class: "compared", id: `${id}-compared`, hidden: true });
  const row = element(
    "div",
    { class: "reading", role: "group", "aria-label": label },
    element("span", { class: "figure-label" }, label, note),
    element("span", { class: "figure-value" }, value, unit, error),
    compared,
  );
  return {
    row,
    value,
    show(text, unitText, errorText) {
      setText(value, text);
      setText(unit, unitText === "°" ? "°" : ` ${unitText}`);
      setText(error, errorText);
    },
    note: (text) => setText(note, text),
    compare(text) {
      setText(compared, text);
      compared.hidden = !text;
    },
  };
}

/** Stress against its limit, with the band of its error. */
class StressBar {
  constructor() {
    this.fill = element("div", { class: "bar-fill" });
    this.band = element("div", { class: "bar-band" });
    this.limit = element("div", { class: "bar-limit" });
    this.text = element("span", { class: "bar-text" });
    this.track = element(
      "div",
      { class: "bar-track", "aria-hidden": "true" },
      this.fill,
      this.band,
      this.limit,
    );
    this.element = element("div", { class: "stress-bar" }, this.track, this.text);
  }

  show({ max_von_mises_mpa: stress, stress_error_percent: percent, stress_limit_mpa: limit }) {
    this.element.hidden = !limit;
    if (!limit) return;
    const error = (stress * (percent ?? 0)) / 100;
    const whole = Math.max(1.25 * limit, 1.08 * (stress + error));
    const share = (value) => `${Math.max(0, (100 * value) / whole)}%`;
    this.fill.style.width = share(stress);
    this.limit.style.left = share(limit);
    this.band.style.left = share(stress - error);
    this.band.style.width = `calc(${share(stress + error)} - ${share(stress - error)})`;
    this.element.dataset.level =
      stress + error <= limit ? "good" : stress <= limit ? "near" : "over";
    setText(
      this.text,
      `${Math.round((100 * stress) / limit)} % of the limit, ${shown(limit, 3)} MPa`,
    );
  }
}

/** How the figures were found, and that they are of a lower pressure where they are. */
function sentence({ how, converged, message }) {
  const found = how ? `${capitalised(how)}.` : "";
  return converged === false && message ? `${found} ${capitalised(message)}` : found;
}

/** The pressure that figures are of where the design's own was not reached. */
function reached({ converged, pressure_mpa: pressure }) {
  return converged === false ? `at ${shown(pressure, 3)} MPa only` : "";
}

function margin(value, percent, decimals) {
  if (percent === null || percent === undefined) return " error not yet known";
  return ` ± ${fixed(Math.abs((value * percent) / 100), decimals)}`;
}

function difference(value, pinned, unit) {
  if (pinned === null || pinned === undefined || Number.isNaN(pinned)) return "";
  const text = signed(value - pinned, unit === "°" ? 3 : 2);
  return `${withUnit(text, unit)} against the pinned design`;
}

function spoken(answer) {
  const angle = `${fixed(answer.bending_angle_deg, 1)} degrees`;
  const stress = `${fixed(answer.max_von_mises_mpa, 2)} megapascals`;
  return `${answer.state}: bending angle ${angle}, highest stress ${stress}`;
}

function explanation(state, problems, shownAnswer, connected) {
  if (state === "waiting") return "";
  if (!connected) return "The figures follow once the studio answers again.";
  const old = shownAnswer ? " The figures are those of an earlier design." : "";
  if (state === "invalid") return (problems[0]?.message ?? "") + old;
  if (state === "failed") return `This design could not be computed.${old}`;
  return old.trim();
}
