"""Constants of a law."""

from __future__ import annotations

from dataclasses import dataclass

from solver.arrays import Reals


@dataclass(frozen=True, eq=False)
class Constants:
    """A law by its ``number`` in the table of laws, and its constants as its functions take them.

    ``values`` (c,) may be of either sign: whether the material is stable is another question.
    """

    number: int
    values: Reals
