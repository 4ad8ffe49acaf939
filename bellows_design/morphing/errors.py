"""Why a mesh of one design is not moved to another one."""

from __future__ import annotations

from bellows_design.errors import BellowsError


class NoNeighbour(BellowsError):
    """The other design's body has other faces, so that no mesh of the one fits it.

    Attributes:
        reason: what differs.
    """

    def __init__(self, reason: str) -> None:
        super().__init__(f"no neighbouring design: {reason}")
        self.reason = reason


class ForeignMesh(BellowsError):
    """A mesh whose nodes do not lie on the surfaces of the design's body."""


class MorphFailed(BellowsError):
    """Moving the mesh's nodes to the other design folds an element.

    Attributes:
        reason: which element, and where.
        reached: how far along the straight way in parameters no element folds, as a fraction.
    """

    def __init__(self, reason: str, reached: float) -> None:
        super().__init__(f"{reason}; {100 * reached:.3g} % of the way can be gone")
        self.reason = reason
        self.reached = reached
