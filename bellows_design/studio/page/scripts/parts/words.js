// Names and sentences of the program as people write them.

/** What stands for a number that follows from others, by the parameter's name. */
export const AUTOMATIC = {
  number_of_bubbles: "as many as fit",
  "limits.max_von_mises": "the material's own limit",
};

/** A name as people write it. */
export function readable(name) {
  return name.replaceAll("_", " ");
}

/** A sentence that begins with a capital, unless it begins with a parameter's name. */
export function capitalised(text) {
  const first = text.split(/\s/, 1)[0];
  return first.includes("_") ? text : text.charAt(0).toUpperCase() + text.slice(1);
}
