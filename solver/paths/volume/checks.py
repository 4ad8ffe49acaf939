"""What volume control asks of a problem and of volumes; refusals in one sentence each."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from solver.arrays import Integers
from solver.assembly.free_rim import free_edges, place_of, rim
from solver.errors import SolverError
from solver.nonlinear.newton import Newton
from solver.paths.volume.held import HeldVolume, volume_of
from solver.problem.problem import Problem
from solver.problem.supports import given_displacements

FIXED_VOLUME = 1e-9
"""A volume that changes by less than this fraction at a pressure of the shear modulus, the largest
one of several materials, is fixed."""

SAME = 1e-12
"""Relative differences of volumes below this one are rounding."""

NO_VOLUME = 1e-12
"""Volume, of the cube of the body's diagonal, that counts as none, as beside a flat membrane."""


def check_volumes(volumes: Sequence[float]) -> None:
    """Raise ``SolverError`` unless all are finite numbers."""
    if not np.isfinite(volumes).all():
        raise SolverError(f"inflate: volumes must be finite numbers of mm³, got {[*volumes]}.")


def check_closed(problem: Problem) -> None:
    """Raise ``SolverError`` unless the pressurised surfaces enclose a volume.

    Every rim must be held or slide in a plane to which the volume's formula is indifferent.
    """
    if not problem.pressurised:
        raise SolverError("inflate: a surface must be pressurised, whose volume is controlled.")
    names = ", ".join(map(repr, problem.pressurised))
    free = free_edges(problem, np.zeros_like(problem.mesh.nodes))
    if len(free):
        raise SolverError(
            f"inflate: the surfaces {names} enclose no volume: their rim is free at "
            f"{place_of(problem.mesh, free)} mm."
        )
    across = _sliding_across_y(problem)
    if len(across):
        raise SolverError(
            f"inflate: the opening of the surfaces {names} at {place_of(problem.mesh, across)} mm "
            "slides in a plane normal to y: such a plane must be y = 0."
        )


def _sliding_across_y(problem: Problem) -> Integers:
    """Edges (k, 3) of openings that slide in a plane normal to y other than y = 0.

    There the integral of y n_y over the surface is not the volume.
    """
    mesh = problem.mesh
    edges = rim(mesh.triangles(*problem.pressurised))
    given = given_displacements(mesh, problem.supports, 1.0, problem.moving_plane)[edges]
    height = np.abs(mesh.nodes[edges, 1] + given[..., 1]).max(axis=1)  # NaN where y is free
    sliding = np.isnan(given[..., [0, 2]]).any(axis=(1, 2))
    across: Integers = edges[sliding & (height > 1e-9 * mesh.size)]
    return across


def seen_sign(rest: float, volume: float) -> float:
    """Sign of the volumes that a user gives against signed ones.

    -1 for surfaces that face outwards, around a negative volume, if the user's are positive.
    """
    return -1.0 if rest < 0 < volume else 1.0


def volume_at_start(newton: Newton) -> float:
    """Signed volume at no pressure, mm^3; exactly zero beside a flat membrane."""
    volume = volume_of(newton, newton.loading.start)
    return volume if abs(volume) > NO_VOLUME * newton.problem.mesh.size**3 else 0.0


def signed_targets(rest: float, sign: float, volumes: Sequence[float]) -> list[float]:
    """Signed volumes in order from the one at the start, ``rest``; ``sign``: of the given ones.

    Those that differ from ``rest`` by rounding are taken for it. Raises ``SolverError`` if one is
    of another sign than ``rest`` or out of order.
    """
    signed = [sign * volume for volume in volumes]
    signed = [rest if abs(each - rest) <= SAME * abs(rest) else each for each in signed]
    last = signed[-1]
    targets = sorted(set(signed), reverse=last < rest)
    inside = all(target * (rest or 1.0) > 0 for target in targets)
    if not inside or targets[-1] != last or (targets[0] - rest) * (last - rest) < 0:
        *stops, volume = volumes
        raise SolverError(
            f"inflate: volumes must be positive and lie between the {abs(rest):.6g} mm³ at no "
            f"pressure and the last one, got {stops} and {volume:g} mm³."
        )
    return targets


def check_changeable(newton: Newton, held: HeldVolume) -> None:
    """Raise ``SolverError`` if no pressure changes the volume at the start."""
    if held.failure:
        raise SolverError(f"inflate: at no pressure {held.failure}.")
    stiffness = newton.problem.distribution.moduli.max()
    if not abs(held.compliance) * stiffness > FIXED_VOLUME * newton.problem.mesh.size**3:
        raise SolverError(
            f"inflate: the {abs(held.volume):.6g} mm³ inside the pressurised surfaces cannot "
            "change, whatever the pressure: an incompressible body or supports fill them."
        )
