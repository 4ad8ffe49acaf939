// Keys for what the buttons do, and the list of them.

import { byId, element } from "../parts/elements.js";

/** Binds keys. `actions` by key: `{keys, what, act}`; keys like "Ctrl+Z" or "P". */
export function bindShortcuts(actions) {
  const byKey = new Map();
  for (const action of actions) for (const key of action.keys) byKey.set(key, action.act);
  document.addEventListener("keydown", (event) => {
    const act = byKey.get(keyOf(event));
    if (!act || isOccupied(event)) return;
    event.preventDefault();
    act();
  });
  byId("shortcuts").append(...actions.map(row));
}

function keyOf(event) {
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const control = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
  return control + (event.shiftKey && control ? "Shift+" : "") + key;
}

/** Plain letters belong to the fields in which one types; an open dialog keeps all keys. */
function isOccupied(event) {
  if (document.querySelector("dialog[open]")) return true;
  if (event.altKey) return true;
  const { tagName, type, dataset } = event.target;
  if (dataset.typing) return true; // the field's own undo
  const typing = tagName === "SELECT" || (tagName === "INPUT" && type === "text");
  return typing && !event.ctrlKey && !event.metaKey;
}

function row({ keys, what }) {
  const shown = keys.flatMap((key, number) => [number ? " or " : null, element("kbd", {}, key)]);
  return element("div", {}, element("dt", {}, ...shown), element("dd", {}, what));
}
