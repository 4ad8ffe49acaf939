"""How stiffly fingers and objects press against each other."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ContactModel:
    """How points of the finger's lower side press against objects.

    The pressure rises with the penetration: by ``stiffness`` once it exceeds ``onset``, and with
    its square before, so that the tangent is continuous.

    Attributes:
        spacing: of the points along the finger, at most, mm.
        stiffness: N/mm per mm of the finger's length.
        onset: mm.
    """

    spacing: float = 0.5
    stiffness: float = 400.0
    onset: float = 1e-3
