"""Lines of shell scripts that behave as a slicer may."""

from __future__ import annotations

ANSWER = 'case "$1" in --help) echo "PrusaSlicer-2.5.0+x based on Slic3r (with GUI)"; exit;; esac'

SETTINGS_BLOCK = "sed -e '/^#/d' -e '/^$/d' -e 's/^/; /' settings.ini >> part.gcode"
"""As PrusaSlicer does: what it used stands at the end of its G-code."""


def loop(x: float, y: float, width: float, depth: float) -> str:
    """G-code that follows a rectangle about (x, y), in the shell's `printf`."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    places = [(x + a * width / 2, y + b * depth / 2) for a, b in corners]
    moves = [f"G1 X{a} Y{b} E{0.03 * max(width, depth)}" for a, b in places[1:]]
    lines = ["M83", "G1 Z0.2", f"G0 X{places[0][0]} Y{places[0][1]}", *moves]
    return "printf '" + "\\n".join(lines) + "\\n' > part.gcode"
