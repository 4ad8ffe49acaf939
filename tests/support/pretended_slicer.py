"""Lines of shell scripts that behave as a slicer may."""

from __future__ import annotations

ANSWER = 'case "$1" in --help) echo "PrusaSlicer-2.5.0+x based on Slic3r (with GUI)"; exit;; esac'

SETTINGS_BLOCK = "sed -e '/^#/d' -e '/^$/d' -e 's/^/; /' settings.ini >> part.gcode"
"""As PrusaSlicer does: what it used stands at the end of its G-code."""


def loop(x: float, y: float, width: float, depth: float, layers: int = 20) -> str:
    """G-code that follows a rectangle about (x, y) in layers of 0.2 mm, in the shell's `printf`."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    places = [(x + a * width / 2, y + b * depth / 2) for a, b in corners]
    moves = [f"G1 X{a} Y{b} E{0.03 * max(width, depth)}" for a, b in places[1:]]
    start = f"G0 X{places[0][0]} Y{places[0][1]}"
    heights = [f"G1 Z{0.2 * layer:.1f}" for layer in range(1, layers + 1)]
    lines = ["M83", *(line for height in heights for line in (height, start, *moves))]
    return "printf '" + "\\n".join(lines) + "\\n' > part.gcode"
