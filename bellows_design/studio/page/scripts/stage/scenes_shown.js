// Scenes as the 3D view is given them.

const GHOST = "pinned";
const GHOST_OPACITY = 0.3;
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

/** Name of the first values that the scene's surfaces carry, or null. */
export function firstField(scene) {
  return scene.surfaces.flatMap((surface) => surface.fields ?? [])[0]?.name ?? null;
}

/** Whether a box has grown or shrunk so much that the camera should see it anew. */
export function differsMuch(box, other) {
  if (!other) return true;
  const size = Math.hypot(...box.high.map((high, axis) => high - box.low[axis]));
  const off = (bound) =>
    box[bound].some((value, axis) => Math.abs(value - other[bound][axis]) > 0.12 * size);
  return off("low") || off("high");
}
