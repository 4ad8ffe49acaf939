// The indent's lengths, which the page offers also for designs that have no indent yet.

const COMMON = { unit: "mm", step: 0.05, value: null, group: "Indent" };

const LENGTHS = [
  {
    name: "indent.depth",
    label: "Depth",
    lowest: 0.05,
    highest: 2,
    least: 0.05,
    most: 5,
    meaning: "greatest depth, along z",
  },
  {
    name: "indent.width",
    label: "Width",
    lowest: 0.2,
    highest: 6,
    least: 0.2,
    most: 50,
    meaning: "width at the wall's face, along x",
  },
  {
    name: "indent.fillet",
    label: "Fillet",
    lowest: 0,
    highest: 2,
    least: 0,
    most: 5,
    meaning: "radius in the corners of a rectangular profile",
  },
];

/** Parameters with those of an indent that are missing among them, before the load. */
export function withIndent(parameters) {
  const names = new Set(parameters.map((each) => each.name));
  const missing = LENGTHS.filter((each) => !names.has(each.name)).map((each) => ({
    ...COMMON,
    ...each,
  }));
  const place = parameters.findIndex((each) => each.group === "Indent" || each.group === "Load");
  const at = place < 0 ? parameters.length : place;
  return [...parameters.slice(0, at), ...missing, ...parameters.slice(at)];
}
