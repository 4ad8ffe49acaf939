"""A mesh as a binary STL file, as slicers read it."""

from __future__ import annotations

import numpy as np

from printers.arrays import Floats, Ints

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def binary_stl(vertices: Floats, triangles: Ints) -> bytes:
    """The file's bytes: 80 of header, the number of triangles, 50 for each. Normals are zero.

    The header is empty, and normals follow from the corners: the same mesh gives the same bytes.
    """
    corners = np.asarray(vertices)[np.asarray(triangles)]
    records = np.zeros(len(corners), dtype=_TRIANGLE)
    records["corners"] = corners
    return bytes(80) + np.uint32(len(corners)).astype("<u4").tobytes() + records.tobytes()
