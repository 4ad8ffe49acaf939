/* The view with legend and scale bar: as a PNG, and on paper. */

import { niceTicks, shortNumber } from "./colours.js";

const PAPER = { stage: "#ffffff", ink: "#111111", fail: "#b3261e" };

/** A PNG, as a data: address. */
export function picture(viewer) {
  return drawn(viewer, ownColours(viewer)).toDataURL("image/png");
}

/** Put the picture in place of the view while the page is printed: a WebGL canvas that gets another
    size for it is empty on paper. Returns what ends that. */
export function printedAsPicture(viewer) {
  let shown = null;
  const end = () => shown?.remove();
  const begin = () => {
    end();
    if (viewer.lost || !viewer.stage.clientWidth) return;
    shown = drawn(viewer, PAPER);
    shown.className = "paper";
    viewer.box.append(shown);
  };
  addEventListener("beforeprint", begin);
  addEventListener("afterprint", end);
  return () => {
    removeEventListener("beforeprint", begin);
    removeEventListener("afterprint", end);
  };
}

function ownColours(viewer) {
  const style = getComputedStyle(viewer.host);
  const [stage, ink, fail] = ["stage", "ink", "fail"].map((name) => style.getPropertyValue(`--own-${name}`));
  return { stage, ink, fail };
}

function drawn(viewer, colours) {
  const { canvas, stage } = viewer;
  const made = document.createElement("canvas");
  [made.width, made.height] = [canvas.width, canvas.height];
  const context = made.getContext("2d");
  context.fillStyle = colours.stage;
  context.fillRect(0, 0, made.width, made.height);
  context.drawImage(canvas, 0, 0);
  const ratio = canvas.width / stage.clientWidth;
  context.scale(ratio, ratio);
  context.fillStyle = context.strokeStyle = colours.ink;
  context.font = "13px sans-serif";
  drawScaleBar(context, viewer);
  if (viewer.colouring) drawLegend(context, viewer, colours);
  return made;
}

function drawScaleBar(context, { stage, scaleBar, camera, frameLabel }) {
  const width = scaleBar.length * camera.pixelsPerMm;
  const [right, bottom] = [stage.clientWidth - 14, stage.clientHeight - 14];
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(right - width, bottom - 6);
  context.lineTo(right - width, bottom);
  context.lineTo(right, bottom);
  context.lineTo(right, bottom - 6);
  context.stroke();
  context.textAlign = "center";
  context.fillText(`${shortNumber(scaleBar.length, scaleBar.length)} mm`, right - width / 2, bottom - 8);
  context.textAlign = "left";
  context.fillText(frameLabel, 14, bottom);
}

function drawLegend(context, { stage, colouring, mapBytes }, colours) {
  const { name, unit, low, high, limit } = colouring;
  const [left, top, height] = [stage.clientWidth - 84, 36, Math.min(170, 0.38 * stage.clientHeight)];
  for (let y = 0; y < height; y += 1) {
    const at = 4 * Math.round((1 - y / (height - 1)) * 255);
    context.fillStyle = `rgb(${mapBytes[at]} ${mapBytes[at + 1]} ${mapBytes[at + 2]})`;
    context.fillRect(left, top + y, 14, 1.5);
  }
  context.fillStyle = colours.ink;
  context.textBaseline = "middle";
  const place = (value) => top + height * (1 - (value - low) / (high - low));
  for (const tick of niceTicks(low, high)) context.fillText(shortNumber(tick, high - low), left + 24, place(tick));
  context.textAlign = "right";
  context.fillText(unit ? `${name}, ${unit}` : name, stage.clientWidth - 14, 20);
  if (limit === null || limit < low || limit > high) return;
  context.fillStyle = colours.fail;
  context.fillRect(left - 5, place(limit) - 1, 24, 2);
  context.fillText(`limit ${shortNumber(limit, high - low)}`, left - 9, place(limit));
}
