"""An evaluation as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.analysis.evaluation import Evaluation
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
    return [table, *curve, *notes, *([] if evaluation.converged else [_not_reached(evaluation)])]


def _results(evaluation: Evaluation) -> dict[str, str]:
    error = evaluation.error_estimate
    angle, stress = evaluation.bending_angle_deg, evaluation.max_von_mises_mpa
    return {
        "pressure": f"{evaluation.pressure_mpa:.4g} MPa",
        "bending angle": f"{angle:.4g}°{_error(error.bending_angle_percent)}",
        "highest von Mises stress": f"{stress:.4g} MPa{_error(error.max_von_mises_percent)}",
        "at (x, y, z)": _place(evaluation.max_von_mises_position_mm),
        "cavity volume": f"{evaluation.cavity_volume_mm3:.4g} mm³",
        "principal strains": _strains(evaluation.strain),
        "contact": _contact(evaluation.contact),
    }


def _effort(evaluation: Evaluation) -> dict[str, str]:
    mesh, solver = evaluation.mesh, evaluation.solver
    return {
        "model": f"{evaluation.model.name} ({evaluation.reason}), "
        f"{mesh.elements} tetrahedra, {mesh.unknowns} unknowns",
        "solver": f"{solver.load_steps} load steps, {solver.newton_iterations} iterations, "
        f"{solver.linear_solver}",
        "time": f"{evaluation.seconds.total:.1f} s",
    }


def _error(percent: float | None) -> str:
    return " (error not estimated)" if percent is None else f" (± {percent:.2g} % estimated)"


def _place(position: Sequence[float]) -> str:
    return f"({', '.join(f'{coordinate:.2f}' for coordinate in position)}) mm"


def _strains(strain: ReachedStrain) -> str:
    """The extremes, and the range of the material's tests."""
    text = f"{100 * strain.lowest:+.3g} … {100 * strain.highest:+.3g} %"
    if strain.valid is None:
        return text
    low, high = strain.valid
    return f"{text} (material tested {100 * low:+.3g} … {100 * high:+.3g} %)"


def _contact(contact: WallContact) -> str:
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


def _not_reached(evaluation: Evaluation) -> Text:
    message = evaluation.message or "the load was not reached"
    return Text(f"NOT CONVERGED: {message}", style="bold red")
