// The number of bubbles: given, or as many as fit.

import { element, setText } from "../parts/elements.js";

/** The row of the number with a box that leaves it to the length. */
export function countControl(session, row) {
  const box = element("input", {
    type: "checkbox",
    id: "as-many-as-fit",
    change: () => session.move(row.name, box.checked ? null : count),
  });
  const note = element("span", { class: "count-note" });
  let count = row.parameter.value ?? 1;
  row.range.before(element("label", { class: "check", for: "as-many-as-fit" }, box, " as many as fit", note));
  return {
    element: row.row,
    show() {
      const value = session.valueOf(row.name);
      box.checked = value === null;
      row.enable(value !== null);
      if (value !== null) count = value;
      setText(note, "");
    },
    /** How many bubbles the valid design has. */
    showCount(found) {
      count = found;
      if (!box.checked) return;
      setText(note, `: ${found}`);
      row.range.value = found;
      row.range.setAttribute("aria-valuetext", `${found}, as many as fit`);
      row.field.value = String(found);
    },
  };
}
