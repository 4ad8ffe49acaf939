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

  /** Objects that draw the caps of all closed groups among `shapes`; replaces those before. */
  rebuild(shapes, size) {
    this.dispose();
    this.caps = closedGroups(shapes, Math.max(1e-3, size * 1e-4)).map((group, number) => {
      const plane = new Mesh(new PlaneGeometry(4 * size, 4 * size), capMaterial());
      plane.frustumCulled = false;
      plane.renderOrder = -100 + 2 * number + 1;
      plane.onAfterRender = (renderer) => renderer.clearStencil();
      const counting = group.flatMap((shape) => shape.counting);
      for (const mesh of counting) {
        mesh.frustumCulled = false;
        mesh.renderOrder = -100 + 2 * number;
      }
      return { group, plane, counting };
    });
    this.update();
    return this.caps.flatMap((cap) => [...cap.counting, cap.plane]);
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
