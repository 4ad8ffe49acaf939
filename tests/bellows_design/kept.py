"""A small design, and keys of what is asked about it."""

from __future__ import annotations

from collections.abc import Sequence

from bellows_design import load_design, with_overrides
from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.store import Key
from bellows_design.store.key import key_of

LOW_BUBBLES = (
    "bubble_width=14", "bubble_height=12", "tendon_width=8", "number_of_bubbles=3", "length=26",
    "load.pressure=0.02",
)  # fmt: skip


def small(*settings: str) -> Design:
    """Prototype 1 with three low bubbles, under a fifth of the pressure."""
    return with_overrides(load_design("prototype_1"), [*LOW_BUBBLES, *settings])


def key(
    design: Design,
    model: str = "auto",
    accuracy: float | None = None,
    pressures: Sequence[float] = (),
    budget: Budget = DEFAULT,
    further_meshes: int = 0,
) -> Key:
    return key_of(design, model, accuracy, pressures, budget, further_meshes)
