/* The value at the place that the mouse points at. */

import { Vector3 } from "three";

const MISSING = -1;

/** Points of shapes as the camera sees them, until something is drawn anew. */
export class Probe {
  constructor(viewer) {
    this.viewer = viewer;
    this.drawn = -1;
  }

  /** `{name, value, unit}` at a place of the stage in pixels; null where there is none. */
  at(x, y) {
    const { viewer } = this;
    if (!viewer.field || viewer.lost) return null;
    this.project();
    let nearest = null;
    for (const { shape, seen } of this.projected) {
      const hit = hitOf(shape, seen, x, y, this.plane);
      if (hit && (!nearest || hit.depth > nearest.depth)) nearest = { ...hit, shape };
    }
    if (!nearest || nearest.level < MISSING / 2) return null;
    const { field, name } = nearest.shape;
    if (!field) return null;
    return { name, value: field.low + nearest.level * (field.high - field.low), unit: field.unit };
  }

  project() {
    const { viewer } = this;
    if (this.drawn === viewer.renders) return;
    this.drawn = viewer.renders;
    const { clientWidth: width, clientHeight: height } = viewer.stage;
    const { camera } = viewer.camera;
    const matrix = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse);
    const { cutting, plane } = viewer.section.uniforms;
    this.plane = cutting.value ? plane.value : null;
    const point = new Vector3();
    this.projected = viewer.shapes
      .filter((shape) => shape.visible && !shape.lines)
      .map((shape) => {
        const { array, count } = shape.geometry.getAttribute("position");
        const seen = new Float32Array(3 * count);
        for (let i = 0; i < count; i += 1) {
          point.fromArray(array, 3 * i).applyMatrix4(matrix);
          seen[3 * i] = ((point.x + 1) / 2) * width;
          seen[3 * i + 1] = ((1 - point.y) / 2) * height;
          seen[3 * i + 2] = -point.z;
        }
        return { shape, seen };
      });
  }
}

/** Depth and value of the foremost triangle at a place, but for what the section takes away. */
function hitOf(shape, seen, x, y, plane) {
  const { index } = shape.topology;
  const positions = shape.geometry.getAttribute("position").array;
  const levels = shape.geometry.getAttribute("value").array;
  let best = null;
  for (let i = 0; i < index.length; i += 3) {
    const a = 3 * index[i], b = 3 * index[i + 1], c = 3 * index[i + 2];
    const ux = seen[b] - seen[a], uy = seen[b + 1] - seen[a + 1];
    const vx = seen[c] - seen[a], vy = seen[c + 1] - seen[a + 1];
    const area = ux * vy - uy * vx;
    if (area === 0) continue;
    const px = x - seen[a], py = y - seen[a + 1];
    const second = (px * vy - py * vx) / area;
    const third = (ux * py - uy * px) / area;
    if (second < 0 || third < 0 || second + third > 1) continue;
    const first = 1 - second - third;
    const mixed = (values, axis) => first * values[a + axis] + second * values[b + axis] + third * values[c + axis];
    const depth = mixed(seen, 2);
    if (best && depth <= best.depth) continue;
    if (plane && mixed(positions, 0) * plane.x + mixed(positions, 1) * plane.y + mixed(positions, 2) * plane.z > plane.w) continue;
    best = { depth, level: first * levels[a / 3] + second * levels[b / 3] + third * levels[c / 3] };
  }
  return best;
}
