/* Style of the viewer and its control bar. The page may set the custom properties --bellows-…; the
   values here are those of bellows_design/web/style.py. */

const LIGHT = {
  ink: "#1a222b",
  muted: "#55616e",
  stage: "#f3f5f8",
  card: "#ffffff",
  line: "#cfd6de",
  accent: "#0b62a8",
  surface: "#86aed2",
  edge: "#1d2b3a",
  cut: "#ffffff",
  wire: "#3c4a58",
  warn: "#7a4b00",
  fail: "#b3261e",
};

const DARK = {
  ink: "#e7ecf1",
  muted: "#a3afbb",
  stage: "#151b22",
  card: "#1d242d",
  line: "#3a4551",
  accent: "#6cb6f5",
  surface: "#7fa9cf",
  edge: "#0b1016",
  cut: "#10161d",
  wire: "#b6c2ce",
  warn: "#f2c163",
  fail: "#ff8a80",
};

const variables = (values) =>
  Object.entries(values)
    .map(([name, value]) => `--own-${name}: var(--bellows-${name}, ${value});`)
    .join(" ");

export const SHARED_STYLE = `
:host { display: block; ${variables(LIGHT)} color-scheme: light; }
@media (prefers-color-scheme: dark) { :host { ${variables(DARK)} color-scheme: dark; } }
:host([data-theme="light"]) { ${variables(LIGHT)} color-scheme: light; }
:host([data-theme="dark"]) { ${variables(DARK)} color-scheme: dark; }
:host([hidden]) { display: none; }
* { box-sizing: border-box; }
.frame {
  font: 400 13px/1.4 system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif;
  font-variant-numeric: tabular-nums; color: var(--own-ink); background: var(--own-card);
  border: 1px solid var(--own-line); border-radius: 8px; overflow: hidden;
}
.stage { position: relative; background: var(--own-stage); overflow: hidden; outline: none;
  user-select: none; -webkit-user-select: none; }
.stage:focus-visible { box-shadow: inset 0 0 0 3px var(--own-accent); }
.stage:focus-visible::after { content: ""; position: absolute; inset: 0; pointer-events: none;
  box-shadow: inset 0 0 0 3px var(--own-accent); }
canvas { display: block; width: 100%; height: 100%; position: absolute; inset: 0; cursor: grab; }
canvas:active { cursor: grabbing; }
.message { position: absolute; inset: 0; display: grid; place-content: center; text-align: center;
  padding: 24px; color: var(--own-ink); font-size: 14px; background: var(--own-stage); }
:is(.message, .legend, .help, .value, .place)[hidden] { display: none; }
.bar { display: flex; flex-wrap: wrap; gap: 8px 18px; align-items: center; padding: 8px 12px;
  border-top: 1px solid var(--own-line); background: var(--own-card); }
.bar:empty { display: none; }
.group { display: flex; align-items: center; gap: 8px; min-width: min-content; max-width: 100%; margin: 0; padding: 0; border: 0; }
.group.frames { flex: 1 1 260px; }
.place { display: contents; }
.group.section:has(.place:not([hidden])) { flex: 1 1 260px; }
.group input[type="range"] { flex: 1 1 90px; min-width: 60px; width: 60px; margin: 0; height: 26px;
  accent-color: var(--own-accent); }
.reading { min-width: 64px; font-weight: 600; white-space: nowrap; }
button, select { font: inherit; color: var(--own-ink); background: var(--own-card);
  border: 1px solid var(--own-line); border-radius: 6px; min-height: 30px; padding: 3px 10px;
  cursor: pointer; max-width: 100%; }
select { min-width: 0; flex: 0 1 auto; text-overflow: ellipsis; }
button:hover, select:hover { border-color: var(--own-accent); }
button[aria-pressed="true"] { background: var(--own-accent); border-color: var(--own-accent);
  color: var(--own-card); }
button:disabled, select:disabled, input:disabled { opacity: 0.5; cursor: default; }
button svg { display: block; width: 16px; height: 16px; fill: currentColor; }
.round { width: 30px; padding: 0; display: grid; place-content: center; flex: none; }
:is(button, select, input):focus-visible { outline: 3px solid var(--own-accent); outline-offset: 1px; }
label { display: inline-flex; align-items: center; gap: 6px; white-space: nowrap; }
label.check { cursor: pointer; }
input[type="checkbox"] { width: 16px; height: 16px; margin: 0; accent-color: var(--own-accent); }
.swatch { width: 12px; height: 12px; border-radius: 3px; border: 1px solid var(--own-line); }
.surfaces { flex-wrap: wrap; }
.scale-bar { position: absolute; right: 12px; bottom: 10px; text-align: center; font-size: 12px;
  line-height: 1.2; pointer-events: none; }
.scale-bar i { display: block; height: 6px; border: 1.5px solid var(--own-ink); border-top: 0; margin-top: 2px; }
.quiet { color: var(--own-muted); }
.hidden-text { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%);
  white-space: nowrap; }
@media print { .bar, .help-button, .help { display: none !important; } .frame { break-inside: avoid; }
  :is(.swatch, .legend-scale, .legend-missing i) { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
`;

export const VIEWER_STYLE = `${SHARED_STYLE}
.legend { position: absolute; top: 10px; right: 12px; display: grid; gap: 11px; justify-items: end;
  pointer-events: none; max-width: 60%;
  text-shadow: ${Array(4).fill("0 0 3px var(--own-stage)").join(", ")}; }
.legend-title { font-weight: 600; text-align: right; }
.legend-scale { position: relative; width: 14px; height: min(170px, 38cqh); margin-right: 58px;
  border-radius: 3px; box-shadow: 0 0 0 1px var(--own-line); }
.legend-tick { position: absolute; left: 100%; width: 58px; padding-left: 10px;
  transform: translateY(-50%); font-size: 12px; line-height: 1; white-space: nowrap; }
.legend-tick::before { content: ""; position: absolute; left: 1px; top: 50%; width: 6px;
  border-top: 1px solid var(--own-muted); }
.legend-limit { position: absolute; right: 100%; transform: translateY(-50%); padding-right: 11px;
  font-size: 12px; line-height: 1.1; font-weight: 600; color: var(--own-fail); white-space: nowrap; }
.legend-limit::before { content: ""; position: absolute; right: -16px; width: 24px; top: 50%;
  border-top: 2px solid var(--own-fail); }
.legend-missing { font-size: 12px; display: flex; gap: 6px; align-items: center; }
.legend-missing i { width: 12px; height: 12px; border-radius: 3px; background: #9e9e9e; }
.triad { position: absolute; left: 8px; bottom: 8px; width: 68px; height: 68px; pointer-events: none; }
.triad text { font-size: 12px; font-weight: 700; text-anchor: middle; dominant-baseline: central; }
.triad line { stroke-width: 2.4; stroke-linecap: round; }
.axis-x { stroke: #d1495b; } .axis-y { stroke: #2f9e5b; } .axis-z { stroke: #3578c9; }
.triad text { fill: var(--own-ink); stroke: none; }
.help-button { position: absolute; left: 10px; top: 10px; width: 28px; min-height: 28px; padding: 0;
  border-radius: 50%; font-weight: 700; }
.help { position: absolute; left: 10px; top: 46px; max-width: calc(100% - 20px); padding: 10px 14px;
  background: var(--own-card); border: 1px solid var(--own-line); border-radius: 8px;
  box-shadow: 0 4px 16px rgb(0 0 0 / 0.18); z-index: 2; }
.help dl { display: grid; grid-template-columns: auto 1fr; gap: 3px 12px; margin: 0; font-size: 12px; }
.help dt { font-weight: 600; } .help dd { margin: 0; }
.value { position: absolute; left: 0; top: 0; padding: 1px 8px; border-radius: 6px; font-weight: 600;
  background: var(--own-ink); color: var(--own-card); font-size: 12px; pointer-events: none; white-space: nowrap; }
.note { position: absolute; left: 50%; top: 12px; transform: translateX(-50%); padding: 4px 12px;
  border-radius: 14px; background: var(--own-ink); color: var(--own-card); font-size: 12px;
  opacity: 0; transition: opacity 0.2s; pointer-events: none; white-space: nowrap; }
.note.shown { opacity: 0.92; }
.stage { container-type: size; }
canvas.paper { display: none; position: static; width: 100%; height: auto; }
@media print { .frame:has(.paper) .stage { display: none; } canvas.paper { display: block; } }
@media (prefers-reduced-motion: reduce) { .note { transition: none; } }
`;

export const LAYERS_STYLE = `${SHARED_STYLE}
.stage { touch-action: pan-y; cursor: grab; }
.stage:active { cursor: grabbing; }
.kinds { position: absolute; left: 12px; top: 10px; display: flex; flex-wrap: wrap; gap: 2px 14px;
  max-width: calc(100% - 24px); font-size: 12px; pointer-events: none; }
.kinds span { display: inline-flex; align-items: center; gap: 5px; white-space: nowrap;
  text-shadow: 0 0 3px var(--own-stage), 0 0 3px var(--own-stage); }
.group.frames { flex: 1 1 300px; flex-wrap: wrap; }
.marks { flex-wrap: wrap; }
.mark { text-align: left; }
.mark.fail { color: var(--own-fail); } .mark.warn { color: var(--own-warn); }
`;
