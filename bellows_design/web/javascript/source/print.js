/* Layers of a print as bellows_design/web/layers.py packs them, and how one is drawn. */

import { numbersAt, open } from "./unpack.js";

const FORMAT = "bellows-layers";

/** Colours of the kinds of beads, on light and on dark pages. */
const KINDS = {
  "external perimeter": ["#d3692a", "#e88a4a"],
  perimeter: ["#f0b483", "#a8683c"],
  "solid infill": ["#8cbf8f", "#4f8a5b"],
  infill: ["#bcdcbb", "#3d6547"],
  bridge: ["#9a8cc4", "#7d6fb0"],
  "gap fill": ["#d9609f", "#d9609f"],
};
const OTHER = ["#b9c2cc", "#66727e"];
const AIR = { "air of the cavity": "#7fb6de", plug: "#b4b4b4", "void between beads": "#e4574f" };

/** The layers in `buffer` (ArrayBuffer). */
export async function unpackLayers(buffer) {
  const { header, arrays } = await open(buffer, FORMAT);
  const { runs, beads, air } = header;
  const numbers = (name, points, components) => numbersAt(arrays, header[name], points, components);
  const layers = {
    ...header,
    points: numbers("points", runs + beads, 2),
    widths: numbers("widths", beads, 1),
    lengths: numbers("lengths", runs, 1),
    kinds: numbers("kinds", runs, 1),
    ofRun: numbers("layers", runs, 1),
    air: air && { ...air, cells: numbersAt(arrays, air.cells, air.rows * air.columns, 1) },
  };
  return { ...layers, begins: begins(layers), high: highest(layers) };
}

/** For each layer its first run, the first run's first bead and first point; one more at the end. */
function begins({ tops, runs, lengths, ofRun }) {
  const found = [];
  let [bead, point] = [0, 0];
  for (let run = 0; run <= runs; run += 1) {
    const layer = run < runs ? ofRun[run] : tops.length;
    while (found.length <= layer) found.push({ run, bead, point });
    if (run < runs) [bead, point] = [bead + lengths[run], point + lengths[run] + 1];
  }
  return found;
}

function highest({ points, low, step }) {
  const high = [0, 0];
  for (let i = 0; i < points.length; i += 1) high[i % 2] = Math.max(high[i % 2], points[i]);
  return high.map((steps, axis) => low[axis] + steps * step);
}

/** Runs of one layer: kind, places `[x, y, …]` in mm, widths in mm. */
export function* runsOf(layers, layer) {
  let { run, bead, point } = layers.begins[layer];
  const last = layers.begins[layer + 1].run;
  for (; run < last; run += 1) {
    const length = layers.lengths[run];
    const places = [];
    for (let i = 2 * point; i < 2 * (point + length + 1); i += 1) {
      places.push(layers.low[i % 2] + layers.points[i] * layers.step);
    }
    const widths = Array.from(layers.widths.subarray(bead, bead + length), (steps) => steps * layers.step);
    yield { kind: layers.kind_names[layers.kinds[run]], places, widths };
    bead += length;
    point += length + 1;
  }
}

export function colourOf(kind, dark) {
  return (KINDS[kind] || OTHER)[dark ? 1 : 0];
}

export const airColour = (name) => AIR[name] || null;

/** Draw all beads of a layer at their width; the context's unit is mm. */
export function drawBeads(context, layers, layer, { dark, rim, pixel }) {
  for (const { kind, places, widths } of runsOf(layers, layer)) {
    const colour = colourOf(kind, dark);
    for (const [style, thinner] of [[rim, 0], [colour, Math.min(0.05, 2 * pixel)]]) {
      context.strokeStyle = style;
      strokeRun(context, places, widths, thinner);
    }
  }
}

/** A line through places; a new one wherever the width changes. */
function strokeRun(context, places, widths, thinner) {
  let drawn = -1;
  for (let bead = 0; bead < widths.length; bead += 1) {
    if (widths[bead] !== drawn) {
      if (drawn >= 0) context.stroke();
      drawn = widths[bead];
      context.lineWidth = Math.max(drawn - thinner, 1e-3);
      context.beginPath();
      context.moveTo(places[2 * bead], places[2 * bead + 1]);
    }
    context.lineTo(places[2 * bead + 2], places[2 * bead + 3]);
  }
  context.stroke();
}

/** Draw the cells of air of a layer. */
export function drawAir(context, air) {
  const image = document.createElement("canvas");
  [image.width, image.height] = [air.columns, air.rows];
  const pixels = image.getContext("2d");
  for (let i = 0; i < air.cells.length; i += 1) {
    const colour = airColour(air.names[air.cells[i]]);
    if (!colour) continue;
    pixels.fillStyle = colour;
    pixels.fillRect(i % air.columns, Math.floor(i / air.columns), 1, 1);
  }
  const [corner, right, up] = air.corners;
  context.save();
  context.transform(
    (right[0] - corner[0]) / air.columns, (right[1] - corner[1]) / air.columns,
    (up[0] - corner[0]) / air.rows, (up[1] - corner[1]) / air.rows, corner[0], corner[1],
  );
  context.imageSmoothingEnabled = false;
  context.drawImage(image, 0, 0);
  context.restore();
}
