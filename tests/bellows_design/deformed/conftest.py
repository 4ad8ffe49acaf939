"""Coarse evaluations whose actuators are put together; each is computed once."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from kept import small

from bellows_design.analysis.models import choose
from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.evaluation import Evaluation, evaluation_of, started

EXAMPLES = Path(__file__).parents[3] / "examples"

DESIGNS: dict[str, Callable[[], Design]] = {
    "three bubbles": lambda: small("load.pressure=0.1"),
    "vacuum": lambda: with_overrides(load_design("prototype_1"), ["load.pressure=-0.05"]),
    "two bubbles": lambda: small("number_of_bubbles=2", "length=20", "load.pressure=0.1"),
    "nine bubbles": lambda: load_design(str(EXAMPLES / "finger_nine.toml")),
    "fingertip": lambda: load_design(str(EXAMPLES / "finger_gripping.toml")),
    "limit": lambda: small("material=ecoflex_00_30", "load.pressure=0.1"),
}
"""Unit cells but for the second, a half; under the vacuum bubbles without neighbours are the ends;
the last does not reach its pressure."""

MESHES, PRESSURES = {"three bubbles": 2}, {"nine bubbles": (0.05,)}


@pytest.fixture(scope="session")
def evaluated() -> Callable[[str], Evaluation]:
    """One of ``DESIGNS`` on its coarsest mesh, or on two."""

    @cache
    def found(name: str) -> Evaluation:
        design, meshes = DESIGNS[name](), MESHES.get(name, 1)
        asked = PRESSURES.get(name, ())
        return evaluation_of(started(design, *choose(design), asked, meshes=meshes))

    return found
