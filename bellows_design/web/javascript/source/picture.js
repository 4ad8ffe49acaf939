/* The view as a PNG, with legend and scale bar. */

import { niceTicks, shortNumber } from "./colours.js";

/** A data: address. */
export function picture(viewer) {
  const { canvas, stage } = viewer;
  const style = getComputedStyle(viewer.host);
  const made = document.createElement("canvas");
  [made.width, made.height] = [canvas.width, canvas.height];
  const context = made.getContext("2d");
  context.fillStyle = style.getPropertyValue("--own-stage");
  context.fillRect(0, 0, made.width, made.height);
  context.drawImage(canvas, 0, 0);
  const ratio = canvas.width / stage.clientWidth;
  context.scale(ratio, ratio);
  context.fillStyle = context.strokeStyle = style.getPropertyValue("--own-ink");
  context.font = "13px sans-serif";
  drawScaleBar(context, viewer);
  if (viewer.colouring) drawLegend(context, viewer, style);
  return made.toDataURL("image/png");
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

function drawLegend(context, { stage, colouring, mapBytes }, style) {
  const { name, unit, low, high, limit } = colouring;
  const [left, top, height] = [stage.clientWidth - 84, 36, Math.min(170, 0.38 * stage.clientHeight)];
  for (let y = 0; y < height; y += 1) {
    const at = 4 * Math.round((1 - y / (height - 1)) * 255);
    context.fillStyle = `rgb(${mapBytes[at]} ${mapBytes[at + 1]} ${mapBytes[at + 2]})`;
    context.fillRect(left, top + y, 14, 1.5);
  }
  context.fillStyle = style.getPropertyValue("--own-ink");
  context.textBaseline = "middle";
  const place = (value) => top + height * (1 - (value - low) / (high - low));
  for (const tick of niceTicks(low, high)) context.fillText(shortNumber(tick, high - low), left + 24, place(tick));
  context.textAlign = "right";
  context.fillText(unit ? `${name}, ${unit}` : name, stage.clientWidth - 14, 20);
  if (limit === null || limit < low || limit > high) return;
  context.fillStyle = style.getPropertyValue("--own-fail");
  context.fillRect(left - 5, place(limit) - 1, 24, 2);
  context.fillText(`limit ${shortNumber(limit, high - low)}`, left - 9, place(limit));
}
