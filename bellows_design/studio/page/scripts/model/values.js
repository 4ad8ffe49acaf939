// The values of a design as the page changes them, relative to the design that was opened.

/** Values of an opened design, by dotted name: numbers or null, names, and the indent's table. */
export function openedValues(start) {
  const values = {};
  for (const each of start.parameters) {
    if (each.name.startsWith("indent.")) continue;
    values[each.name] = each.automatic ? null : (each.value ?? null);
  }
  values.material = start.material ?? null;
  values.printer = start.printer ?? null;
  values.indent = start.indent ?? null;
  return values;
}

/** What differs from the opened design: all that the server needs to know. */
export function changedValues(values, opened) {
  const changed = Object.entries(values).filter(([name, value]) => !same(value, opened[name]));
  return Object.fromEntries(changed);
}

/** Whether two values, or two sets of them, are the same. */
export function same(one, other) {
  if (one === other) return true;
  if (!isTable(one) || !isTable(other)) return false;
  const names = Object.keys(one);
  return (
    names.length === Object.keys(other).length &&
    names.every((name) => same(one[name], other[name]))
  );
}

/** The value of a dotted name; those of an absent indent are null. */
export function valueOf(values, name) {
  if (!name.startsWith("indent.")) return values[name];
  return values.indent ? (values.indent[name.slice("indent.".length)] ?? null) : null;
}

/** `values` with another value of a dotted name. */
export function withValue(values, name, value) {
  if (!name.startsWith("indent.")) return { ...values, [name]: value };
  return { ...values, indent: { ...values.indent, [name.slice("indent.".length)]: value } };
}

function isTable(value) {
  return typeof value === "object" && value !== null;
}
