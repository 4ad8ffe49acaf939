// Elements of the page. Text only ever enters as text, never as markup.

/**
 * A new element.
 * @param {string} tag
 * @param {Object<string, any>} attributes - `class`, `aria-…` and the like; listeners as
 *   functions under the event's name; `false`, `null` and `undefined` leave an attribute out.
 * @param {...(Node|string|null)} children
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined)
      made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** The element of the page with that identifier. */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element "${id}"`);
  return found;
}

/** Writes a text only where it changes, so that it is not read aloud twice. */
export function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/** An option of a list of choices. */
export function option(value, label, chosen = false) {
  const made = element("option", { value }, label);
  made.selected = chosen;
  return made;
}
