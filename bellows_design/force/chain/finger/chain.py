"""What a finger is for its equilibrium in the plane: pieces with a law between two rigid stubs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.force.chain.finger.weight import NO_WEIGHT, Weight, Weights
from bellows_design.force.section_law import SectionLaw, SectionResponse
from solver.arrays import Reals


@dataclass(frozen=True)
class Piece:
    """A piece of the chain.

    Attributes:
        law: of the piece; one of length zero is a hinge.
        backward: it goes from the gap to the bubble's middle, mirrored.
        weight: at the middle of its length.
    """

    law: SectionLaw
    backward: bool = False
    weight: Weight = NO_WEIGHT


@dataclass(frozen=True)
class Chain:
    """A finger: a rigid stub, pieces, a rigid stub.

    Attributes:
        pieces: from root to tip.
        root_length: of the stub at the root, mm.
        tip_length: of the stub at the tip, mm.
        tip_height: of the tip's face, mm.
        height: of the finger between the stubs, mm.
        root_weight: of the stub at the root, at the middle of its length.
        tip_weight: of the stub at the tip, likewise.
        root_frame: x, z (mm) and angle (rad) of the root's face.
    """

    pieces: tuple[Piece, ...]
    root_length: float = 0.0
    tip_length: float = 0.0
    tip_height: float = 1.0
    height: float = 1.0
    root_weight: Weight = NO_WEIGHT
    tip_weight: Weight = NO_WEIGHT
    root_frame: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @classmethod
    def of(
        cls,
        bellows: BellowsParameters,
        law: SectionLaw,
        *,
        root: SectionLaw | None = None,
        tip: SectionLaw | None = None,
        weights: Weights | None = None,
        root_frame: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> Chain:
        """The finger of a design: two pieces a bubble, that follow ``law``.

        The outer halves of the first and the last bubble follow ``root`` and ``tip``, if given.
        The stub at the root ends half a pitch before the first bubble's middle, in the gap's middle
        had it a neighbour; that at the tip begins likewise.
        """
        weights = weights or Weights()
        stub = bellows.first_gap_middle
        inner = [law] * (2 * bellows.bubble_count - 2)
        laws = (root or law, *inner, tip or law)
        pieces = (Piece(own, number % 2 == 0, weights.piece) for number, own in enumerate(laws))
        return cls(
            pieces=tuple(pieces),
            root_length=stub,
            tip_length=bellows.length - stub - bellows.bubble_count * bellows.pitch,
            tip_height=bellows.tendon_height,
            height=bellows.bubble_height,
            root_weight=weights.root,
            tip_weight=weights.tip,
            root_frame=root_frame,
        )

    @cached_property
    def lengths(self) -> Reals:
        """Of the pieces at rest (n,), mm."""
        return np.array([piece.law.length for piece in self.pieces], dtype=float)

    @cached_property
    def backward(self) -> Reals:
        """1 for a piece that goes backward, else 0: shape (n,)."""
        return np.array([piece.backward for piece in self.pieces], dtype=float)

    @cached_property
    def joints(self) -> Reals:
        """Places of the pieces' ends along the undeformed finger (n + 1,), mm."""
        return self.root_length + np.concatenate([[0.0], np.cumsum(self.lengths)])

    @property
    def length(self) -> float:
        """Of the undeformed finger, mm."""
        return float(self.joints[-1] + self.tip_length)

    @cached_property
    def softest(self) -> float:
        """Largest eigenvalue of the pieces' compliances at rest, rad and mm by N mm and N."""
        at_rest = self.response(0.0, np.zeros((len(self.pieces), 3)))
        return float(np.linalg.eigvalsh(at_rest.compliance).max())

    @cached_property
    def _laws(self) -> tuple[tuple[SectionLaw, Sequence[int]], ...]:
        """Every law and the numbers of the pieces that follow it."""
        laws = {id(piece.law): piece.law for piece in self.pieces}
        return tuple(
            (law, [number for number, piece in enumerate(self.pieces) if piece.law is law])
            for law in laws.values()
        )

    def response(self, pressure: float, loads: Reals) -> SectionResponse:
        """How all pieces answer to ``pressure`` (MPa) and section loads (n, 3)."""
        if len(self._laws) == 1:
            return self._laws[0][0].response(pressure, loads)
        n = len(self.pieces)
        whole = SectionResponse(
            np.empty(n), np.empty((n, 3)), np.empty((n, 3, 3)), np.empty(n), np.empty((n, 3))
        )
        for law, numbers in self._laws:
            part = law.response(pressure, loads[numbers])
            for name, values in vars(part).items():
                getattr(whole, name)[numbers] = values
        return whole
