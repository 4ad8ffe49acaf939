"""Finite elements for pressurised soft bodies: mixed quadratic tetrahedra, Ogden rubber.

    solution = solve(Problem(mesh, material, supports, ("cavity",)), pressure=0.1)

Units: mm, N, MPa, degrees. Names are imported when first used, so that a program that only needs
the data classes does not wait for the compiled kernels.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from solver.checkpoint import Checkpoint
    from solver.continuation import Limit, Trace, trace
    from solver.inflation import inflate
    from solver.interpolation import transfer
    from solver.loading import solve
    from solver.loads import BodyForce, Couple, PointForce, Traction
    from solver.materials import Ogden
    from solver.mesh import Mesh
    from solver.models import Contact, Problem, SlenderAxis, Supports
    from solver.motion import rotation
    from solver.newton import Event, SolverOptions
    from solver.reactions import Reaction, reaction
    from solver.results import PathPoint, Solution, cavity_volume, write_vtu
    from solver.stress import Peak, nodal_cauchy, nodal_von_mises, peak_von_mises

_MODULES = {
    "checkpoint": ("Checkpoint",),
    "continuation": ("Limit", "Trace", "trace"),
    "inflation": ("inflate",),
    "interpolation": ("transfer",),
    "loading": ("solve",),
    "loads": ("BodyForce", "Couple", "PointForce", "Traction"),
    "materials": ("Ogden",),
    "mesh": ("Mesh",),
    "models": ("Contact", "Problem", "SlenderAxis", "Supports"),
    "motion": ("rotation",),
    "newton": ("Event", "SolverOptions"),
    "reactions": ("Reaction", "reaction"),
    "results": ("PathPoint", "Solution", "cavity_volume", "write_vtu"),
    "stress": ("Peak", "nodal_cauchy", "nodal_von_mises", "peak_von_mises"),
}

__all__ = [
    "BodyForce",
    "Checkpoint",
    "Contact",
    "Couple",
    "Event",
    "Limit",
    "Mesh",
    "Ogden",
    "PathPoint",
    "Peak",
    "PointForce",
    "Problem",
    "Reaction",
    "SlenderAxis",
    "Solution",
    "SolverOptions",
    "Supports",
    "Trace",
    "Traction",
    "cavity_volume",
    "inflate",
    "nodal_cauchy",
    "nodal_von_mises",
    "peak_von_mises",
    "reaction",
    "rotation",
    "solve",
    "trace",
    "transfer",
    "write_vtu",
]


def __getattr__(name: str) -> object:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
