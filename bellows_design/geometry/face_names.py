"""What the faces of bodies are called; apart from the solids, so that nobody waits for CAD."""

from __future__ import annotations

OUTSIDE, CAVITY, ROOT, TIP, SYMMETRY, PORT, MOUNT = (
    "outside",
    "cavity",
    "root",
    "tip",
    "symmetry",
    "port",
    "mount",
)
BUBBLE_MIDDLE, GAP_MIDDLE = "bubble_middle", "gap_middle"
