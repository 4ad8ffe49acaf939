"""The builders of small solids, at hand in every test."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from manifold3d import CrossSection, JoinType, Manifold, Mesh64
from small_solids import arrays, bellows, block, bore, hollow_box, port_of, rounded_bar

from printers import PrintedModel, PrinterProfile, load_profile
from printers.measure.part import MeasuredPart


def model(solid: Manifold, **declared: Any) -> PrintedModel:
    return PrintedModel(*arrays(solid), **declared)


def part(solid: Manifold, profile: PrinterProfile, **declared: Any) -> MeasuredPart:
    return MeasuredPart(model(solid, **declared), profile)


@pytest.fixture(scope="session")
def solids() -> SimpleNamespace:
    """The builders above, by name."""
    return SimpleNamespace(
        block=block, bore=bore, rounded_bar=rounded_bar, hollow_box=hollow_box, port_of=port_of,
        arrays=arrays, model=model, part=part, bellows=bellows, Manifold=Manifold, Mesh64=Mesh64,
        CrossSection=CrossSection, JoinType=JoinType,
    )  # fmt: skip


@pytest.fixture(scope="session")
def prusa() -> PrinterProfile:
    return load_profile("prusa_i3")
