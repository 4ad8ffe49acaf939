/* One surface or one set of lines on the graphics card: its frames, normals, values. */

import { BufferAttribute, BufferGeometry, LineSegments, Mesh, Sphere, Vector3 } from "three";
import { enclose, topologyOf } from "./topology.js";
import { countingMaterials, lineMaterial, surfaceMaterial, vectorOf } from "./materials.js";

const EVERYWHERE = new Sphere(new Vector3(), Infinity);
const MISSING = 65535;

function equal(one, other) {
  return one.length === other.length && one.every((number, i) => number === other[i]);
}

/** A surface, its sharp edges, and what counts it for the section's cap. */
export class Shape {
  constructor(data, context) {
    this.context = context;
    this.lines = data.corners === 2;
    this.takeData(data);
    this.topology = this.lines ? pointsAsTheyAre(data) : topologyOf(data);
    this.frame = 0;
    this.field = null;
    this.buildObjects();
    this.setFrame(0);
    if (this.edges) this.markEdges();
  }

  takeData(data) {
    this.data = data;
    this.name = data.name;
    this.frames = data.frames;
  }

  buildObjects() {
    const { section, map } = this.context;
    const count = this.topology.source.length;
    const geometry = new BufferGeometry();
    geometry.boundingSphere = EVERYWHERE;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * count), 3));
    this.geometry = geometry;
    this.objects = [];
    this.counting = [];
    if (this.lines) {
      geometry.setIndex(new BufferAttribute(this.topology.index, 1));
      this.material = lineMaterial(section, 1);
      this.objects.push(new LineSegments(geometry, this.material));
      return;
    }
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("value", new BufferAttribute(new Float32Array(count), 1));
    geometry.setIndex(new BufferAttribute(this.topology.index, 1));
    this.material = surfaceMaterial(section, map, this.data.opacity);
    this.objects.push(new Mesh(geometry, this.material));
    this.buildEdges(section);
    this.counting = countingMaterials(section).map((material) => new Mesh(geometry, material));
  }

  buildEdges(section) {
    this.edgeGeometry = new BufferGeometry();
    this.edgeGeometry.boundingSphere = EVERYWHERE;
    this.edgeGeometry.setAttribute("position", this.geometry.getAttribute("position"));
    this.edgeMaterial = lineMaterial(section, 0.55 * this.data.opacity);
    this.edges = new LineSegments(this.edgeGeometry, this.edgeMaterial);
    this.objects.push(this.edges);
  }

  /** Sharp edges, and the rims of what is open; joints that are divided otherwise are no rims. */
  markEdges() {
    const { creases, open } = this.topology;
    const marked = this.closed ? creases : Uint32Array.from([...creases, ...open]);
    this.edgeGeometry.setIndex(new BufferAttribute(marked, 1));
  }

  /** Take other positions and values on the same cells; false if the cells differ. */
  replaceData(data) {
    const same =
      data.corners === this.data.corners &&
      data.points === this.data.points &&
      data.opacity === this.data.opacity &&
      equal(data.cells, this.data.cells);
    if (same) this.takeData(data);
    return same;
  }

  /** Whether it encloses a volume by itself. */
  get closed() {
    return !this.lines && enclose(this.openEdges(), this.size);
  }

  get size() {
    const { low, high } = this.data;
    return Math.hypot(...high.map((x, axis) => x - low[axis])) || 1;
  }

  /** Both ends of the edges that have one triangle only, x, y, z behind each other, mm. */
  openEdges() {
    const positions = this.geometry.getAttribute("position").array;
    return Array.from(this.topology.open).flatMap((i) => Array.from(positions.subarray(3 * i, 3 * i + 3)));
  }

  /** Show the frame `t`, from 0 to the last; between two frames a mix of both. */
  setFrame(t) {
    this.frame = Math.min(Math.max(t, 0), this.frames - 1);
    const from = Math.floor(this.frame);
    const to = Math.min(from + 1, this.frames - 1);
    this.mixPositions(from, to, this.frame - from);
    if (!this.lines) {
      this.computeNormals();
      this.mixValues();
    }
  }

  mixPositions(from, to, share) {
    const { levels, points, low, high, steps } = this.data;
    const attribute = this.geometry.getAttribute("position");
    const { source } = this.topology;
    const mixed = attribute.array;
    const [first, second] = [3 * points * from, 3 * points * to];
    const scale = [0, 1, 2].map((axis) => (high[axis] - low[axis]) / steps);
    for (let i = 0, at = 0; i < source.length; i += 1) {
      const point = 3 * source[i];
      for (let axis = 0; axis < 3; axis += 1, at += 1) {
        const a = levels[first + point + axis];
        const b = levels[second + point + axis];
        mixed[at] = low[axis] + (a + (b - a) * share) * scale[axis];
      }
    }
    attribute.needsUpdate = true;
  }

  computeNormals() {
    const p = this.geometry.getAttribute("position").array;
    const attribute = this.geometry.getAttribute("normal");
    const n = attribute.array.fill(0);
    const { index } = this.topology;
    for (let i = 0; i < index.length; i += 3) {
      const a = 3 * index[i], b = 3 * index[i + 1], c = 3 * index[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      n[a] += x; n[a + 1] += y; n[a + 2] += z;
      n[b] += x; n[b + 1] += y; n[b + 2] += z;
      n[c] += x; n[c + 1] += y; n[c + 2] += z;
    }
    attribute.needsUpdate = true;
  }

  /** Values from 0 to 1 between the field's own least and greatest; −1000 where there is none. */
  mixValues() {
    if (!this.field) return;
    const { levels, frames, steps } = this.field;
    const { source } = this.topology;
    const frame = Math.min(this.frame, frames - 1);
    const from = Math.floor(frame);
    const share = frame - from;
    const first = this.data.points * from;
    const second = this.data.points * Math.min(from + 1, frames - 1);
    const attribute = this.geometry.getAttribute("value");
    for (let i = 0; i < source.length; i += 1) {
      const a = levels[first + source[i]];
      const b = levels[second + source[i]];
      const missing = a === MISSING || b === MISSING;
      attribute.array[i] = missing ? -1000 : (a + (b - a) * share) / steps;
    }
    attribute.needsUpdate = true;
  }

  /** Colour by the field of this name, if it has one, from `low` to `high`. */
  setField(name, low, high) {
    if (this.lines) return;
    this.field = this.data.fields.find((field) => field.name === name) || null;
    this.material.uniforms.coloured.value = this.field !== null;
    if (!this.field) return;
    const span = this.field.high - this.field.low || 1;
    const least = (low - this.field.low) / span;
    const most = (high - this.field.low) / span;
    this.material.uniforms.range.value = [least, most > least ? most : least + 1e-6];
    this.mixValues();
  }

  setColours(colours) {
    const own = vectorOf(this.data.colour || colours.surface);
    if (this.lines) {
      this.material.uniforms.colour.value = vectorOf(this.data.colour || colours.line);
      return;
    }
    this.material.uniforms.colour.value = own;
    this.material.uniforms.inside.value = own.clone().multiplyScalar(0.72);
    this.edgeMaterial.uniforms.colour.value = vectorOf(colours.edge);
  }

  setVisible(visible) {
    this.visible = visible;
    for (const object of this.objects) object.visible = visible;
  }

  /** Least and greatest coordinates over all frames, mm. */
  get box() {
    return { low: this.data.low, high: this.data.high };
  }

  /**
   * The points of all frames, x, y, z behind each other, mm: all, as boxes have few and a view that
   * missed one would cut the box off.
   */
  allPoints() {
    const { levels, low, high, steps } = this.data;
    const found = new Float32Array(levels.length);
    for (let at = 0; at < levels.length; at += 1) {
      const axis = at % 3;
      found[at] = low[axis] + (levels[at] * (high[axis] - low[axis])) / steps;
    }
    return found;
  }

  dispose() {
    this.geometry.dispose();
    this.material.dispose();
    for (const mesh of this.counting) mesh.material.dispose();
    if (this.edgeGeometry) {
      this.edgeGeometry.dispose();
      this.edgeMaterial.dispose();
    }
  }
}

function pointsAsTheyAre(data) {
  return {
    index: Uint32Array.from(data.cells),
    source: Uint32Array.from({ length: data.points }, (_, i) => i),
    creases: new Uint32Array(0),
    open: new Uint32Array(0),
  };
}

/** Sets of shapes that enclose volumes: each by itself, or those that do not all together. */
export function closedGroups(shapes, size) {
  const surfaces = shapes.filter((shape) => !shape.lines && shape.data.opacity === 1);
  const open = surfaces.filter((shape) => !shape.closed);
  const groups = surfaces.filter((shape) => !open.includes(shape)).map((shape) => [shape]);
  if (open.length > 1 && enclose(open.flatMap((shape) => shape.openEdges()), size)) groups.push(open);
  return groups;
}
