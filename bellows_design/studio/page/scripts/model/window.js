// The range that a slider spans: the one around the opened design's value, wider where needed.

/** `{low, high, step}` of a parameter. */
export function firstWindow({ lowest, highest, step }) {
  return { low: lowest, high: highest, step: step || (highest - lowest) / 200 };
}

/** The same window, wider where a value lies outside it or has come to its border. */
export function widened(window, { least, most }, value) {
  if (value === null || value === undefined) return window;
  const { step } = window;
  const span = Math.max(window.high - window.low, step);
  const low = value <= window.low ? Math.max(least, rounded(value - span / 2, step)) : window.low;
  const high = value >= window.high ? Math.min(most, rounded(value + span / 2, step)) : window.high;
  return { low, high, step };
}

function rounded(value, step) {
  return Number((Math.round(value / step) * step).toFixed(6));
}
