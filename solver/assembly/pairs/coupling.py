"""Which triangles of two surfaces in contact the tangent's pattern couples.

Analysing a pattern costs as much as some factorizations. So the set of pairs only grows, and when
one is new, pairs of triangles two rings around it are added too: it then grows rarely. What a solve
has touched before thus decides the order of elimination, and the last digits.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from solver.arrays import Integers
from solver.assembly.pairs.surfaces import SurfacePair
from solver.kernels.closest_points import Numbers
from solver.linear.sparsity import Pattern, widened


class Coupling:
    """The pattern of the solid's tangent, widened by pairs of triangles that have touched."""

    def __init__(self, pattern: Pattern, count: int) -> None:
        """``pattern`` of the solid alone; ``count`` of the problem's contacts."""
        self._solid = pattern
        self._known = [np.empty(0, np.int64) for _ in range(count)]
        self._widened: tuple[Pattern, Integers] | None = None

    def widened(
        self, touching: Sequence[tuple[int, SurfacePair, Numbers]]
    ) -> tuple[Pattern, Integers]:
        """Pattern that also couples pairs of triangles, and positions of the solid's entries in it.

        ``touching``: number of a contact, the contact, and its pairs that touch.
        """
        grown = False
        for number, pair, pairs in touching:
            if not np.isin(pairs, self._known[number]).all():
                self._known[number] = np.union1d(
                    self._known[number], pair.around(pair.around(pairs))
                )
                grown = True
        if grown or self._widened is None:
            cells = [pair.pair_dofs(self._known[number]) for number, pair, _ in touching]
            self._widened = self._with(cells)
        return self._widened

    def _with(self, cells: Sequence[Integers]) -> tuple[Pattern, Integers]:
        """The widest pattern so far and more cells, with positions of the solid's entries."""
        if self._widened is None:
            return widened(self._solid, np.concatenate(cells))
        pattern, solid = self._widened
        wider, places = widened(pattern, np.concatenate(cells))
        return wider, places[solid]
