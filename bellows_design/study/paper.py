"""The tables of the paper as data.

P. Ćurković, A. Jambrečić: Improving structural design of soft actuators using finite element
method analysis. INDECS 18(4), 2020, DOI 10.7906/indecs.18.4.8. Its angles look read off to 5°.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bellows_design.design.design import Design

DOI = "10.7906/indecs.18.4.8"


@dataclass(frozen=True)
class Result:
    """One computed design of the paper (Table 4 and the text below it)."""

    label: str
    design: str
    """Name of the shipped design it starts from."""
    overrides: tuple[str, ...]
    """What was changed, as ``--set`` takes it."""
    bending_angle_deg: float
    max_stress_mpa: float
    angle_change_percent: float
    """Change against Prototype 1, as printed."""
    stress_change_percent: float

    def build(self) -> Design:
        """The design itself."""
        from bellows_design.design.overrides import with_overrides
        from bellows_design.design.shipped import load_design

        return with_overrides(load_design(self.design), self.overrides)


@dataclass(frozen=True)
class Erratum:
    """A number the paper prints against its own text, and the one its text implies."""

    parameter: str
    printed: float
    corrected: float
    reason: str


@dataclass(frozen=True)
class Requirements:
    """What the paper asks of a design."""

    pressure_mpa: float = 0.1
    max_stress_mpa: float = 4.0
    cross_section_mm: tuple[float, float] = (20.0, 20.0)
    nozzle_diameter_mm: float = 0.4
    minimum_lines: int = 3


@dataclass(frozen=True)
class Filament:
    """NinjaFlex as its manufacturer describes it (Table 1)."""

    yield_strength_mpa: float = 4.0
    youngs_modulus_mpa: float = 12.0
    ultimate_strength_mpa: float = 26.0
    elongation_at_break_percent: float = 660.0


REQUIREMENTS = Requirements()
FILAMENT = Filament()


def _table(*rows: tuple[str, float, float]) -> Mapping[str, tuple[float, float]]:
    return MappingProxyType({name: (first, second) for name, first, second in rows})


PARAMETERS = _table(
    ("bubble_width", 20, 20),
    ("bubble_height", 20, 20),
    ("bubble_thickness", 1.5, 1.2),
    ("tendon_width", 12, 6),
    ("tendon_height", 5, 6),
    ("tendon_thickness", 1.5, 1.6),
    ("chamber_length", 2, 6),
    ("bubble_distance", 1.5, 1.6),
    ("inner_fillet", 0.5, 0.7),
    ("outer_fillet", 1.5, 1.9),
    ("length", 50, 50),
    ("offset", 5, 5),
)
"""Table 2 as printed, mm: parameter -> (Prototype 1, Prototype 2), misprints included."""

ERRATA = (
    Erratum(
        "chamber_length",
        printed=6,
        corrected=1.4,
        reason="the inner fillet, 0.7 mm, is said to be half of it; the outer fillet, 1.9 mm, is "
        "then exactly half of the bubble's length",
    ),
    Erratum(
        "bubble_distance",
        printed=1.6,
        corrected=1.2,
        reason="it is said to be decreased from 1.5 mm to fit two more bubbles; 1.2 mm makes nine "
        "bubbles exactly 45 mm",
    ),
)
"""Misprints of Prototype 2 in Table 2."""

TABLE_4 = (
    Result("Prototype 1", "prototype_1", (), 220, 4.547, 0, 0),
    Result("bubble width 16", "prototype_1", ("bubble_width=16",), 100, 3.150, -54.3, -30.7),
    Result("bubble height 16", "prototype_1", ("bubble_height=16",), 175, 4.142, -20.5, -8.9),
    Result(
        "bubble thickness 1.2", "prototype_1", ("bubble_thickness=1.2",), 335, 5.211, 52.3, 14.6
    ),
    Result("chamber length 1.2", "prototype_1", ("chamber_length=1.2",), 240, 4.720, 9.1, 3.8),
    Result("bubble distance 1", "prototype_1", ("bubble_distance=1",), 230, 4.544, 4.5, -0.1),
    Result("tendon width 6", "prototype_1", ("tendon_width=6",), 290, 3.607, 31.8, -20.7),
    Result("tendon height 4", "prototype_1", ("tendon_height=4",), 230, 4.713, 4.5, 3.7),
    Result("tendon thickness 1.2", "prototype_1", ("tendon_thickness=1.2",), 230, 5.678, 4.5, 24.9),
    Result("inner fillet 1", "prototype_1", ("inner_fillet=1",), 200, 2.742, -9.1, -39.7),
    Result("outer fillet 2", "prototype_1", ("outer_fillet=2",), 220, 4.530, 0, -0.4),
    Result("Prototype 2", "prototype_2", (), 420, 3.947, 90.9, -13.2),
    Result("Prototype 2 with indent", "prototype_2_indent", (), 470, 3.692, 113.6, -18.8),
)
"""Every design the paper computed, in its order."""
