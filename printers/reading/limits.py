"""How much a file may hold: more is refused before memory is taken for it."""

from __future__ import annotations

LARGEST_FILE = 256 * 2**20
"""Bytes of a file, and of everything that is unpacked from it."""

MOST_TRIANGLES = 1_000_000
"""Of a part, all its copies counted. What is measured on them takes some kilobytes for each."""

FARTHEST = 1e5
"""mm from the origin: farther out a binary STL cannot tell places 0.01 mm apart."""

STEP_SECONDS = 60.0
"""Time for a STEP file, whose reader may never end."""

STEP_MEMORY = 4 * 2**30
"""Bytes of address space for it; the CAD kernel's libraries alone take 0.6 GiB of that."""
