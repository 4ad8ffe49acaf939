// Numbers as people type and read them.

const NUMBER = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

/** The number of a text with a point or a comma, or NaN; a unit after it is passed over. */
export function parsed(text, unit = "") {
  let plain = text.trim().replace("−", "-");
  if (unit && plain.endsWith(unit)) plain = plain.slice(0, -unit.length).trim();
  return NUMBER.test(plain) ? Number(plain.replace(",", ".")) : NaN;
}

/** A value without the digits that are rounding. */
export function shown(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

/** A value with a fixed number of decimals. */
export function fixed(value, decimals) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** The same with its sign, for differences. */
export function signed(value, digits = 2) {
  if (value === 0) return "±0";
  const text = shown(Math.abs(value), digits);
  return (value > 0 ? "+" : "−") + text;
}

/** `value` on the grid of a step, freed of what binary fractions add. */
export function onGrid(value, step) {
  return Number((Math.round(value / step) * step).toFixed(6));
}

/** A number for speech and tables with its unit; degrees stand without a space. */
export function withUnit(text, unit) {
  if (!unit) return text;
  return unit === "°" ? text + unit : `${text} ${unit}`;
}
