"""An evaluation as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Seconds
    from bellows_design.analysis.evaluation import Evaluation, MeshSize, SolverEffort
    from bellows_design.analysis.material_range import ReachedStrain
    from bellows_design.analysis.wall_contact import WallContact
    from bellows_design.analysis.whole_actuator import Reading


def evaluation_table(evaluation: Evaluation) -> Sequence[RenderableType]:
    """The numbers asked for first, the curve, warnings, and why a load was not reached."""
    table = Table(title=evaluation.design.name, title_justify="left", box=SIMPLE, show_header=False)
    for name, value in (_results(evaluation) | _effort(evaluation)).items():
        table.add_row(name, Text(value))
    curve = [_curve(evaluation.curve)] if len(evaluation.curve) > 1 else []
    notes = [Text(f"warning: {text}", style="yellow") for text in evaluation.warnings]
    return [
        table,
        *curve,
        *notes,
        *([] if evaluation.converged else [not_reached(evaluation.message)]),
    ]


def _results(evaluation: Evaluation) -> dict[str, str]:
    error = evaluation.error_estimate
    angle, stress = evaluation.bending_angle_deg, evaluation.max_von_mises_mpa
    return {
        "pressure": f"{evaluation.pressure_mpa:.4g} MPa",
        "bending angle": f"{angle:.4g}°{error_text(error.bending_angle_percent)}",
        "highest von Mises stress": f"{stress:.4g} MPa{error_text(error.max_von_mises_percent)}",
        "at (x, y, z)": place_text(evaluation.max_von_mises_position_mm),
        "cavity volume": f"{evaluation.cavity_volume_mm3:.4g} mm³",
        "principal strains": strains_text(evaluation.strain),
        "contact": contact_text(evaluation.contact),
    }


def _effort(evaluation: Evaluation) -> dict[str, str]:
    return effort_rows(evaluation.model.name, evaluation.reason, evaluation)


class Solved(Protocol):
    """What an evaluation took."""

    @property
    def mesh(self) -> MeshSize:
        """The size of the finest mesh."""

    @property
    def solver(self) -> SolverEffort:
        """What all solves took together."""

    @property
    def seconds(self) -> Seconds:
        """Time spent, s."""


def effort_rows(model: str, reason: str, found: Solved) -> dict[str, str]:
    """Model, solver and time."""
    mesh, solver = found.mesh, found.solver
    return {
        "model": f"{model} ({reason}), {mesh.elements} tetrahedra, {mesh.unknowns} unknowns",
        "solver": f"{solver.load_steps} load steps, {solver.newton_iterations} iterations, "
        f"{solver.linear_solver}",
        "time": f"{found.seconds.total:.1f} s",
    }


def error_text(percent: float | None) -> str:
    """An estimated error behind its value."""
    return " (error not estimated)" if percent is None else f" (± {percent:.2g} % estimated)"


def place_text(position: Sequence[float]) -> str:
    """A place, or a displacement, mm."""
    return f"({', '.join(f'{coordinate:.2f}' for coordinate in position)}) mm"


def strains_text(strain: ReachedStrain) -> str:
    """The extremes, and the range of the material's tests."""
    text = f"{100 * strain.lowest:+.3g} … {100 * strain.highest:+.3g} %"
    if strain.valid is None:
        return text
    low, high = strain.valid
    return f"{text} (material tested {100 * low:+.3g} … {100 * high:+.3g} %)"


def contact_text(contact: WallContact) -> str:
    """Which walls touch or else the smallest gaps, and what that means."""
    note = f": {contact.note}" if contact.note else ""
    if contact.detected:
        return f"{', '.join(contact.where)} touch{note}"
    gaps = {"smallest gap": contact.min_gap_mm, "inside": contact.inner_gap_mm}
    known = [f"{name} {gap:.2f} mm" for name, gap in gaps.items() if gap is not None]
    return ", ".join(["none", *known]) + note


def _curve(readings: Sequence[Reading]) -> Table:
    """Angle, stress and volume over the pressure."""
    table = Table(box=SIMPLE)
    for heading in ("pressure, MPa", "angle, °", "stress, MPa", "cavity, mm³"):
        table.add_column(heading, justify="right")
    for reading in readings:
        table.add_row(
            f"{reading.pressure_mpa:.4g}",
            f"{reading.bending_angle_deg:.2f}",
            f"{reading.max_von_mises_mpa:.3f}",
            f"{reading.cavity_volume_mm3:.0f}",
        )
    return table


def not_reached(message: str) -> Text:
    """Why the load was not reached."""
    return Text(f"NOT CONVERGED: {message or 'the load was not reached'}", style="bold red")
