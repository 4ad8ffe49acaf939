"""A mesh as a binary STL file, as slicers read it."""

from __future__ import annotations

import numpy as np

from printers.arrays import Floats
from printers.reading.stl import FACET


def binary_stl(corners: Floats) -> bytes:
    """The file's bytes: 80 of header, the number of triangles, 50 for each. Normals are zero.

    `corners` are those of the triangles, (3 m, 3) mm, one triangle after the other. The header is
    empty, and normals follow from the corners: the same mesh gives the same bytes.
    """
    records = np.zeros(len(corners) // 3, dtype=FACET)
    records["corners"] = corners.reshape(-1, 3, 3)
    return bytes(80) + np.uint32(len(records)).astype("<u4").tobytes() + records.tobytes()
