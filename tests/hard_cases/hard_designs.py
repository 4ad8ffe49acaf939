"""Designs."""

from __future__ import annotations

from functools import cache

from hard_case import Finding, HardCase, at_most, exactly, true, within

from bellows_design import load_design, with_overrides
from bellows_design.analysis.evaluate import evaluate
from bellows_design.analysis.mesh_plan import first_plan
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.budget import DEFAULT
from bellows_design.design.design import Design
from solver import Solution, solve


@cache
def _solved(name: str, *settings: str) -> tuple[Design, Solution]:
    """A shipped design with other numbers, its unit cell solved on the coarsest mesh."""
    design = with_overrides(load_design(name), list(settings))
    solid = UNIT_CELL.solid(design)
    problem = UNIT_CELL.problem(design, first_plan(solid, design).made(DEFAULT))
    return design, solve(problem, design.load.pressure)


def _angle(name: str, *settings: str) -> float:
    """Bending of all bubbles, degrees; NaN if the pressure is not reached."""
    design, solution = _solved(name, *settings)
    good = solution.converged and solution.stable
    return 2 * solution.rotation * design.bellows.bubble_count if good else float("nan")


def fillets() -> tuple[Finding, ...]:
    """From sharp over a twentieth of a millimetre to the full round."""
    usual = _angle("prototype_1")
    inside = [_angle("prototype_1", f"inner_fillet={r}") for r in (0, 0.05, 1.0)]
    outside = [_angle("prototype_1", f"outer_fillet={r}") for r in (0, 0.05, 2.49, 2.5)]
    return (
        within("inside 0, angle over that of Prototype 1", inside[0] / usual, 1.0, 1.15),
        at_most("inside 0.05 instead of 0", inside[1] / inside[0] - 1, 0.02),
        within("inside fully round", inside[2] / usual, 0.85, 1.0),
        within("outside 0", outside[0] / usual, 0.95, 1.05),
        at_most("outside 0.05 instead of 0", outside[1] / outside[0] - 1, 0.02),
        within("outside fully round", outside[3] / usual, 0.95, 1.15),
        at_most("outside 0.01 mm short of it", outside[2] / outside[3] - 1, 1e-3),
    )


def tiny_fillet() -> tuple[Finding, ...]:
    """The whole evaluation with the smallest and with no fillet: what is said of the stress."""
    sharp, full = (
        evaluate(with_overrides(load_design("prototype_1"), [f"inner_fillet={r}"]), "unit-cell")
        for r in (0, 1.0)
    )
    unsure = sharp.error_estimate.max_von_mises_percent or 0.0
    sure = full.error_estimate.max_von_mises_percent or 100.0
    angles = [e.error_estimate.bending_angle_percent or 100.0 for e in (sharp, full)]
    return (
        true("both reached", sharp.converged and full.converged),
        true("sharp edge: the stress is called uncertain by more than 15 %", unsure > 15, unsure),
        true("full round: by less than 5 %", sure < 5, sure),
        true("angles by less than 3 % in both", max(angles) < 3, angles),
    )


THIN = ("bubble_thickness=0.4", "tendon_thickness=0.4", "inner_fillet=0.2", "outer_fillet=0.5")
THICK = (
    "bubble_thickness=4", "tendon_thickness=4", "tendon_width=16", "tendon_height=16",
    "bubble_width=24", "bubble_height=28", "port.wall=4",
)  # fmt: skip


def walls() -> tuple[Finding, ...]:
    """Bubbles and tendon with walls of 0.4 mm and of 4 mm."""
    _, thin = _solved("prototype_1", *THIN, "load.pressure=0.01")
    _, thick = _solved("prototype_1", *THICK)
    _, hard = _solved("prototype_1", *THICK, "load.pressure=0.6")
    return (
        true("0.4 mm at 10 kPa: reached, stable", thin.converged and thin.stable, thin.message),
        within("its bubble bends by", 2 * thin.rotation, 48.0, 53.0, "°"),
        true("4 mm at 0.1 and 0.6 MPa: reached, stable", hard.converged and thick.converged),
        within("angle at 0.6 over 0.1 MPa", hard.rotation / thick.rotation, 5.5, 9.0),
    )


def five_times() -> tuple[Finding, ...]:
    """0.5 MPa instead of 0.1."""
    findings = []
    for name, low, high in (("prototype_1", 440, 480), ("finger", 620, 660)):
        _, solution = _solved(name, "load.pressure=0.5")
        loads = [point.pressure for point in solution.path]
        rotations = [point.rotation for point in solution.path]
        findings += [
            true(f"{name}: reached, stable", solution.converged and solution.stable),
            true("angle rises all the way", rotations == sorted(rotations) and loads[-1] == 0.5),
            within("to", _angle(name, "load.pressure=0.5"), low, high, "°"),
        ]
    return tuple(findings)


def five_turns() -> tuple[Finding, ...]:
    """Prototype 2 four times as long."""
    design, solution = _solved("prototype_2", "length=200")
    _, usual = _solved("prototype_2")
    return (
        exactly("bubbles", design.bellows.bubble_count, 39),
        within("bending", _angle("prototype_2", "length=200"), 1840, 1940, "°"),
        at_most(
            "a bubble bends otherwise than in the short one by",
            solution.rotation / usual.rotation - 1, 1e-3,
        ),
    )  # fmt: skip


CASES = (
    HardCase(
        "Tiny and full fillets",
        "sliver faces make sliver elements, which stall Newton",
        "fillets within 0.05 mm of a full round become one; sizes follow walls, not fillets",
        fillets,
        slow=True,
    ),
    HardCase(
        "A sharp inner edge",
        "the stress there grows with every refinement",
        "the error estimate says so; the angle is as sure as ever",
        tiny_fillet,
        slow=True,
    ),
    HardCase(
        "Walls from 0.4 to 4 mm",
        "thin walls lock or buckle; thick ones cross",
        "one quadratic element through a wall at first",
        walls,
        slow=True,
    ),
    HardCase(
        "Five times the design pressure",
        "a diverged state, or one of another branch",
        "reached along stable states",
        five_times,
        slow=True,
    ),
    HardCase(
        "Five turns",
        "angles jump by 360°",
        "the unit cell bends by its share",
        five_turns,
        slow=True,
    ),
)
