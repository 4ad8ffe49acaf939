// The keys of the scenes that the page offers, as docs/design-file.md has them.

const GRAVITY = {
  name: "gravity",
  label: "Gravity",
  choices: ["none", "down", "up", "forward", "backward"],
  value: "none",
  meaning: "down: it lies as printed; forward: it hangs from its root",
};
const SIZES = {
  distance: { label: "Distance", unit: "mm", least: 0, most: 500 },
  friction: { label: "Friction", unit: "", least: 0, most: 3 },
};

/** What each scene is, and its keys with their first values. */
export const SCENES = {
  free: {
    label: "Free",
    meaning: "Nothing around the finger: how it bends, under its own weight if you like.",
    fields: [GRAVITY],
  },
  payload: {
    label: "Payload",
    meaning: "A mass hangs on the tip: how does the finger bend under it?",
    fields: [
      { name: "mass_g", label: "Mass", unit: "g", least: 0.1, most: 10000, value: 20 },
      { ...GRAVITY, choices: GRAVITY.choices.slice(1), value: "down" },
    ],
  },
  blocked: {
    label: "Blocked",
    meaning: "The tip presses on a load cell or a wall, or is held: how strong is it?",
    fields: [
      {
        name: "support",
        label: "What keeps the tip",
        choices: ["load_cell", "wall", "held"],
        value: "load_cell",
      },
      {
        name: "distance",
        ...SIZES.distance,
        value: 0,
        of: ["load_cell", "wall"],
        meaning: "from the lower side at rest down to it",
      },
      { name: "friction", ...SIZES.friction, value: 0, of: ["wall"] },
    ],
  },
  grip: {
    label: "Grip",
    meaning: "Two or three equal fingers close on an object: do they hold it?",
    fields: [
      { name: "fingers", label: "Fingers", choices: ["2", "3"], value: "2", number: true },
      {
        name: "object",
        label: "Object",
        choices: ["cylinder", "sphere", "box"],
        value: "cylinder",
      },
      {
        name: "size",
        label: "Size",
        unit: "mm",
        least: 1,
        most: 500,
        value: 30,
        meaning: "diameter, or of a box from face to face",
      },
      { name: "mass_g", label: "Mass", unit: "g", least: 0.1, most: 10000, value: 20 },
      { name: "friction", ...SIZES.friction, value: 0.5 },
      {
        name: "distance",
        ...SIZES.distance,
        least: 0.5,
        value: 16,
        meaning: "from a finger's lower side at rest to the gripper's axis",
      },
      {
        name: "place",
        label: "Place along the finger",
        unit: "mm",
        least: 0,
        most: 1000,
        value: 35,
        meaning: "of the object's middle, from the root",
      },
    ],
  },
};

/** Keys of a scene as the server takes them, of the fields that it has. */
export function keysOf(kind, read) {
  const keys = {};
  for (const field of SCENES[kind].fields) {
    if (field.of && !field.of.includes(keys.support)) continue;
    const value = read(field);
    keys[field.name] = field.choices && !field.number ? value : Number(value);
  }
  return keys;
}
