// What the 3D view is given: the shape at rest, or the deformed one, and beside it the pinned one.

export const GHOST = "pinned";
const GHOST_OPACITY = 0.28;
const GHOST_COLOUR = "#8a8f98";

/** `scene` with the surfaces of another one, pale and without values. */
export function withGhost(scene, other) {
  if (!other) return scene;
  const ghosts = other.surfaces.map((surface, number) => ({
    ...surface,
    name: number ? `${GHOST} ${number + 1}` : GHOST,
    fields: [],
    opacity: GHOST_OPACITY,
    colour: GHOST_COLOUR,
    visible: true,
  }));
  return { ...scene, surfaces: [...scene.surfaces, ...ghosts] };
}

/** Names of all values that the scene's surfaces carry. */
export function fieldNames(scene) {
  return [...new Set(scene.surfaces.flatMap((surface) => (surface.fields ?? []).map((field) => field.name)))];
}

/** Least and greatest coordinate of the scene along x, y and z, mm. */
export function extent(scene) {
  const along = (axis, bound, choose) => choose(...scene.surfaces.map((surface) => surface[bound][axis]));
  return [0, 1, 2].map((axis) => [along(axis, "low", Math.min), along(axis, "high", Math.max)]);
}
