"""What a part does whose pressure is raised slowly, where its pressure falls with its volume."""

from __future__ import annotations

import numpy as np

from solver.arrays import Reals

JUMP = 1e-3
"""Of the highest pressure: over so much of it a jump is drawn."""


def of_slow_rise(pressure: Reals, value: Reals) -> tuple[Reals, Reals]:
    """Points of a path along a growing volume, as a rising pressure goes through them.

    Where the pressure falls with the volume no rising pressure holds the part: it jumps to where
    the path has that pressure again. A path that ends before ends at its highest pressure.

    Args:
        pressure: Along the path, not negative, from its beginning. *Shape:* (n,).
        value: What is read there. *Shape:* (n,).

    Returns:
        Pressures that ascend, and values; both ends of a jump are there.
    """
    rising, step = [0], JUMP * float(pressure.max())
    points = [(float(pressure[0]), float(value[0]))]
    for k in range(1, pressure.size):
        highest = points[-1][0]
        if pressure[k] <= highest:
            continue
        if rising[-1] != k - 1:  # the path comes back from below to where it left
            part = (highest - pressure[k - 1]) / (pressure[k] - pressure[k - 1])
            landed = float(value[k - 1] + part * (value[k] - value[k - 1]))
            after = highest + min(step, 0.5 * (float(pressure[k]) - highest))
            points.append((after, landed))
        points.append((float(pressure[k]), float(value[k])))
        rising.append(k)
    ascending, read = np.array(points).T
    return ascending, read
