"""A force curve as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve, ForceError, ForceReading


def force_tables(found: ForceCurve, by_distance: bool = False) -> Sequence[RenderableType]:
    """The highest pressure's numbers first, curves, warnings, and why a load was not reached.

    The curve over the distance of the support only if ``by_distance`` asks for it.
    """
    title = f"{found.design.name}: {found.scene}"
    table = Table(title=Text(title), title_justify="left", box=SIMPLE, show_header=False)
    for name, value in result_rows(found).items():
        table.add_row(name, Text(value))
    curves = [_curve(found.curve)] if len(found.curve) > 1 else []
    curves += [_by_distance(found.by_distance)] if found.by_distance and by_distance else []
    notes = [Text(f"warning: {text}", style="yellow") for text in found.warnings]
    failure = [] if found.converged else [Text(f"NOT REACHED: {found.message}", style="bold red")]
    return [table, *curves, *notes, *failure]


def result_rows(found: ForceCurve) -> dict[str, str]:
    """What was found at the highest pressure, of the stroke, and what it took, by names."""
    return _results(found) | _stroke(found) | _effort(found)


def _results(found: ForceCurve) -> dict[str, str]:
    last = found.last
    rows = {"pressure": f"{last.pressure_mpa:.4g} MPa"}
    if last.error is not None:
        x, z = last.components_n
        rows |= {
            "force": f"{last.force_n:.4g} N (± {_percent(last.error.total)} % estimated)",
            "error by causes": _causes(last.error),
            "along (x, z)": f"({x:.3g}, {z:.3g}) N",
            "moment at the tip's lower edge": f"{last.moment_n_mm:.4g} N mm",
        }
    if last.largest_payload_g is not None:
        rows["grip"] = _grip(last)
    x, z = last.tip_position_mm
    stress = last.max_von_mises_mpa
    return rows | {
        "tip": f"({x:.2f}, {z:.2f}) mm, turned by {last.tip_angle_deg:.4g}°",
        "neighbouring bubbles": "touch" if last.contact else "do not touch",
        "highest von Mises stress": "not known" if stress is None else f"{stress:.4g} MPa",
        "stable": "yes" if last.stable else "NO",
    }


def _grip(last: ForceReading) -> str:
    """Whether the object is held, and what would be."""
    held = {True: "holds", False: "SLIPS", None: "NOT KNOWN TO HOLD"}[last.holds]
    payload, percent = last.largest_payload_g, last.largest_payload_error_percent
    error = "" if percent is None else f" (± {_percent(percent)} % estimated)"
    return f"{held}; largest payload {payload:.4g} g{error}"


def _percent(error: float) -> str:
    """Beyond the force itself an error to first order is no more than that."""
    return f"{error:.2g}" if error < 100 else "over 100"


def _causes(error: ForceError) -> str:
    parts = {
        "interpolation": error.interpolation,
        "mesh": error.mesh,
        "ends": error.ends,
        "shear": error.shear,
        "neighbours": error.neighbours,
    }
    return ", ".join(f"{name} {_percent(value)} %" for name, value in parts.items())


def _stroke(found: ForceCurve) -> dict[str, str]:
    air = found.air
    rows = {
        "air": f"{air.volume_at_rest_mm3:.4g} mm³ at rest, {air.volume_change_mm3:+.4g} mm³ more",
        "free air of a stroke": f"{1000 * air.free_litres:.3g} mL at 1 bar, {air.seconds:.2g} s at "
        f"{air.flow_litres_per_minute:g} L/min",
        "pneumatic work": f"{found.pneumatic_work_mj:.4g} mJ",
    }
    if found.tip_stiffness_n_per_mm is not None:
        rows["stiffness of the tip"] = f"{found.tip_stiffness_n_per_mm:.3g} N/mm"
    if found.tip_work_mj is not None:
        rows["work of the tip"] = f"{found.tip_work_mj:.3g} mJ while its support gives way"
    return rows


def _effort(found: ForceCurve) -> dict[str, str]:
    seconds = found.seconds
    law = f"kept since {found.from_cache}" if found.from_cache else f"{seconds.law:.1f} s"
    return {"model": "chain of half bubbles", "time": f"law {law}, chain {seconds.chain:.2f} s"}


def _curve(readings: Sequence[ForceReading]) -> Table:
    """Force, its error, angle and stress over the pressure."""
    headings = ("pressure, MPa", "force, N", "± %", "moment, N mm", "tip, °", "stress, MPa", "")
    table = _right_aligned(headings)
    for each in readings:
        table.add_row(f"{each.pressure_mpa:.4g}", *_cells(each))
    return table


def _by_distance(readings: Sequence[ForceReading]) -> Table:
    """The same over the distance of the support."""
    headings = ("distance, mm", "force, N", "± %", "moment, N mm", "tip, °", "stress, MPa", "")
    table = _right_aligned(headings)
    for each in readings:
        table.add_row("" if each.distance_mm is None else f"{each.distance_mm:.4g}", *_cells(each))
    return table


def _right_aligned(headings: Sequence[str]) -> Table:
    table = Table(box=SIMPLE)
    for heading in headings:
        table.add_column(heading, justify="right")
    return table


def _cells(each: ForceReading) -> tuple[str, ...]:
    stress = each.max_von_mises_mpa
    return (
        f"{each.force_n:.3f}",
        "" if each.error is None else _percent(each.error.total),
        f"{each.moment_n_mm:.1f}",
        f"{each.tip_angle_deg:.1f}",
        "" if stress is None else f"{stress:.3f}",
        " ".join(["touch"] * each.contact + ["UNSTABLE"] * (not each.stable)),
    )
