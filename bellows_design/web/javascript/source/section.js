/* A plane that cuts the scene open, and caps that fill the cut solids. */

import { Mesh, PlaneGeometry } from "three";
import { capMaterial, sectionUniforms, vectorOf } from "./materials.js";
import { closedGroups } from "./shape.js";

const AXES = { x: 0, y: 1, z: 2 };

export class Section {
  constructor() {
    this.uniforms = sectionUniforms();
    this.axis = "y";
    this.offset = 0;
    this.on = false;
    this.flip = false;
    this.caps = [];
  }

  /** Objects that draw the caps of all closed groups among `shapes`, as far as they are new. */
  rebuild(shapes, size) {
    const groups = closedGroups(shapes, size);
    const known = this.caps.length === groups.length && this.caps.every(({ group }, i) => sameMembers(group, groups[i]));
    if (!known) {
      this.dispose();
      this.caps = groups.map((group, number) => capOf(group, -100 + 2 * number));
    }
    for (const { plane } of this.caps) plane.scale.setScalar(4 * size);
    this.update();
    return known ? [] : this.caps.flatMap((cap) => [...cap.counting, cap.plane]);
  }

  /** Which side is kept: the one below the offset, or with `flip` the one above. */
  update() {
    const sign = this.flip ? -1 : 1;
    const normal = [0, 0, 0];
    normal[AXES[this.axis]] = sign;
    this.uniforms.cutting.value = this.on;
    this.uniforms.plane.value.set(...normal, sign * this.offset);
    for (const cap of this.caps) {
      const shown = this.on && cap.group.every((shape) => shape.visible);
      for (const mesh of cap.counting) mesh.visible = shown;
      cap.plane.visible = shown;
      cap.plane.position.set(0, 0, 0).setComponent(AXES[this.axis], this.offset);
      cap.plane.rotation.set(0, 0, 0);
      if (this.axis === "x") cap.plane.rotation.y = Math.PI / 2;
      if (this.axis === "y") cap.plane.rotation.x = Math.PI / 2;
    }
  }

  setColours(colours, ratio) {
    for (const cap of this.caps) {
      const base = vectorOf(cap.group[0].data.colour || colours.surface);
      const towards = vectorOf(colours.cut);
      cap.plane.material.uniforms.colour.value = base.clone().lerp(towards, 0.62);
      cap.plane.material.uniforms.hatch.value = base.clone().lerp(towards, 0.15);
      cap.plane.material.uniforms.ratio.value = ratio;
    }
  }

  centreOn(middle) {
    for (const cap of this.caps) {
      for (const [name, axis] of Object.entries(AXES)) {
        if (name !== this.axis) cap.plane.position.setComponent(axis, middle[axis]);
      }
    }
  }

  get state() {
    return { axis: this.axis, offset_mm: this.offset, on: this.on, flip: this.flip, caps: this.caps.length };
  }

  dispose() {
    for (const cap of this.caps) {
      cap.plane.geometry.dispose();
      cap.plane.material.dispose();
      cap.plane.removeFromParent();
      for (const mesh of cap.counting) mesh.removeFromParent();
    }
    this.caps = [];
  }
}

const sameMembers = (one, other) => one.length === other.length && one.every((shape, i) => shape === other[i]);

/** What counts the surfaces of a group before the plane, and the plane, drawn in this order. */
function capOf(group, order) {
  const plane = new Mesh(new PlaneGeometry(1, 1), capMaterial());
  plane.frustumCulled = false;
  plane.renderOrder = order + 1;
  plane.onAfterRender = (renderer) => renderer.clearStencil();
  const counting = group.flatMap((shape) => shape.counting);
  for (const mesh of counting) {
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
  }
  return { group, plane, counting };
}
