"""Constants of a law."""

from __future__ import annotations

from dataclasses import dataclass

from solver.arrays import Reals


@dataclass(frozen=True, eq=False)
class Constants:
    """A law by its ``number`` in the table of laws, and the constants that its functions take.

    ``values`` (c,) may be of either sign; ``solver.material.stability`` checks them.
    """

    number: int
    values: Reals
