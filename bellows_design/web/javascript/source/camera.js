/* The camera without perspective, so that the scale bar holds everywhere; z is up. */

import { OrthographicCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const STEP = (7.5 * Math.PI) / 180;
const MARGIN = 1.1;

/** Directions from the middle to the camera. */
export const VIEWS = {
  corner: [-0.42, -1, 0.48],
  front: [0, -1, 0],
  back: [0, 1, 0],
  left: [-1, 0, 0],
  right: [1, 0, 0],
  top: [0, -1e-3, 1],
  bottom: [0, -1e-3, -1],
};

export class Camera {
  constructor(canvas, changed, taken) {
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
    this.camera.up.set(0, 0, 1);
    this.width = this.height = 1;
    this.size = 1;
    this.middle = new Vector3();
    this.direction = new Vector3(...VIEWS.corner).normalize();
    this.camera.position.copy(this.direction);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = false;
    this.orbit.zoomToCursor = true;
    this.orbit.minZoom = 0.15;
    this.orbit.maxZoom = 60;
    this.orbit.addEventListener("change", changed);
    this.orbit.addEventListener("start", taken);
    canvas.style.touchAction = "pan-y"; // a finger that moves up or down scrolls the page
    canvas.addEventListener("pointerdown", ({ isPrimary }) => isPrimary && this.orbit.saveState());
    canvas.addEventListener("pointercancel", () => this.orbit.reset()); // it was a scroll
  }

  /** The canvas's size, pixels. */
  resize(width, height) {
    this.width = width;
    this.height = height;
    this.frustum();
  }

  frustum() {
    const half = this.half || 1;
    const aspect = this.width / this.height;
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.camera.near = -20 * this.size;
    this.camera.far = 20 * this.size;
    this.camera.updateProjectionMatrix();
  }

  /** See all `points` (of each surface, x, y, z behind each other) of a scene of `size` mm, from where
      the camera is or from `direction`, with `aside` pixels free at the right and the left. */
  fit(points, size, direction, aside) {
    this.size = Math.max(size, 1e-6);
    if (direction) this.direction.set(...direction).normalize();
    this.camera.zoom = 1;
    this.camera.position.copy(this.direction).multiplyScalar(this.size);
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrixWorld();
    const { low, high } = extentOf(points, this.camera.matrixWorldInverse);
    this.middle.set(...low.map((x, axis) => (x + high[axis]) / 2));
    this.middle.applyMatrix4(this.camera.matrixWorld);
    this.camera.position.copy(this.middle).addScaledVector(this.direction, this.size);
    this.orbit.target.copy(this.middle);
    const aspect = (this.width - 2 * aside) / this.height;
    this.half = (MARGIN / 2) * Math.max(high[1] - low[1], (high[0] - low[0]) / aspect, 1e-6);
    this.frustum();
    this.orbit.update();
  }

  rotate(right, up) {
    const arm = this.camera.position.clone().sub(this.orbit.target);
    const upright = new Vector3(arm.x, arm.z, -arm.y);
    const spherical = new Spherical().setFromVector3(upright);
    spherical.theta += right * STEP;
    spherical.phi = Math.min(Math.max(spherical.phi - up * STEP, 1e-3), Math.PI - 1e-3);
    upright.setFromSpherical(spherical);
    this.camera.position.copy(this.orbit.target).add(new Vector3(upright.x, -upright.z, upright.y));
    this.orbit.update();
  }

  pan(right, up) {
    const step = 0.08 * (this.camera.top - this.camera.bottom) / this.camera.zoom;
    const way = new Vector3(right * step, up * step, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(way);
    this.orbit.target.add(way);
    this.orbit.update();
  }

  zoom(factor) {
    const { minZoom, maxZoom } = this.orbit;
    this.camera.zoom = Math.min(Math.max(this.camera.zoom * factor, minZoom), maxZoom);
    this.camera.updateProjectionMatrix();
    this.orbit.update();
  }

  /** Pixels of one mm. */
  get pixelsPerMm() {
    return (this.height * this.camera.zoom) / (this.camera.top - this.camera.bottom);
  }

  /** Direction from the middle to the camera. */
  get towards() {
    return this.camera.position.clone().sub(this.orbit.target).normalize();
  }

  get state() {
    return {
      position: this.camera.position.toArray(),
      target: this.orbit.target.toArray(),
      zoom: this.camera.zoom,
      pixels_per_mm: this.pixelsPerMm,
    };
  }

  dispose() {
    this.orbit.dispose();
  }
}

/** Least and greatest coordinates of the points of surfaces as the camera sees them. */
function extentOf(surfaces, matrix) {
  const [low, high] = [[0, 0, 0].fill(Infinity), [0, 0, 0].fill(-Infinity)];
  const point = new Vector3();
  for (const points of surfaces) {
    for (let i = 0; i < points.length; i += 3) {
      point.fromArray(points, i).applyMatrix4(matrix);
      for (let axis = 0; axis < 3; axis += 1) {
        const x = point.getComponent(axis);
        if (x < low[axis]) low[axis] = x;
        if (x > high[axis]) high[axis] = x;
      }
    }
  }
  return { low, high };
}
