// A number that follows from others unless it is given, such as how many bubbles fit.

import { element } from "../parts/elements.js";
import { AUTOMATIC } from "../parts/words.js";

/** Puts a box into `row` that leaves the number to the program; `show` follows the session. */
export function optionalControl(session, row) {
  const id = `${row.id}-automatic`;
  const box = element("input", {
    type: "checkbox",
    id,
    change: () => session.move(row.name, box.checked ? null : row.value),
  });
  row.range.before(
    element("label", { class: "check", for: id }, box, AUTOMATIC[row.name] ?? "automatic"),
  );
  return {
    show() {
      box.checked = session.valueOf(row.name) === null;
      row.enable(!box.checked);
    },
  };
}
