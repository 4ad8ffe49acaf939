"""Finite elements for pressurised soft bodies: mixed quadratic tetrahedra, Ogden rubber.

    solution = solve(Problem(mesh, material, supports, ("cavity",)), pressure=0.1)

Units: mm, N, MPa, degrees. Names are imported when first used, so that a program that only needs
the data classes does not wait for the compiled kernels.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from solver.lazy_names import imported_when_asked_for

if TYPE_CHECKING:
    from solver.adaptivity.transfer import transfer
    from solver.exchange.abaqus.deck import write_deck
    from solver.exchange.reading import read_mesh
    from solver.exchange.writing import write_mesh
    from solver.material.ogden import Ogden
    from solver.mesh.mesh import Mesh
    from solver.nonlinear.checkpoint import Checkpoint
    from solver.nonlinear.events import Event
    from solver.nonlinear.finite_motion import rotation
    from solver.nonlinear.options import SolverOptions
    from solver.paths.arc_length import Trace, trace
    from solver.paths.limits import Limit
    from solver.paths.load_stepping import solve
    from solver.paths.neighbouring import Neighbouring, neighbouring
    from solver.paths.volume.control import inflate
    from solver.problem.contacts import Contact, SurfaceContact
    from solver.problem.loads import AxialForce, BodyForce, Couple, EdgeForce, PointForce, Traction
    from solver.problem.membranes import Membrane
    from solver.problem.problem import Problem, SlenderAxis
    from solver.problem.rigid_bodies import RigidCylinder, RigidPlane, RigidSphere
    from solver.problem.springs import FoundationSpring, NodeSpring
    from solver.problem.supports import Supports
    from solver.results.contacts import ContactForce, contact_forces
    from solver.results.energy import Potential, potential, strain_energy
    from solver.results.folds import Folds
    from solver.results.membranes.forces import MembraneForces
    from solver.results.reactions import Reaction, reaction
    from solver.results.solution import (
        PathPoint,
        Solution,
        cavity_volume,
        folded_elements,
        membrane_forces,
    )
    from solver.results.stress import (
        Peak,
        nodal_cauchy,
        nodal_von_mises,
        peak_von_mises,
        peaks_by_region,
    )
    from solver.results.vtu import write_vtu
    from solver.results.work import Work, work
    from solver.sensitivity.gradients import Gradients, ResponseGradient, gradients
    from solver.sensitivity.materials import constant_changes, material_derivatives
    from solver.sensitivity.section.response import SectionDerivatives, section_response
    from solver.sensitivity.section.shear import shear_compliance
    from solver.sensitivity.sensitivities import Sensitivities, sensitivities
    from solver.sensitivity.smooth_peak import SmoothPeak

__all__ = [
    "AxialForce",
    "BodyForce",
    "Checkpoint",
    "Contact",
    "ContactForce",
    "Couple",
    "EdgeForce",
    "Event",
    "Folds",
    "FoundationSpring",
    "Gradients",
    "Limit",
    "Membrane",
    "MembraneForces",
    "Mesh",
    "Neighbouring",
    "NodeSpring",
    "Ogden",
    "PathPoint",
    "Peak",
    "PointForce",
    "Potential",
    "Problem",
    "Reaction",
    "ResponseGradient",
    "RigidCylinder",
    "RigidPlane",
    "RigidSphere",
    "SectionDerivatives",
    "Sensitivities",
    "SlenderAxis",
    "SmoothPeak",
    "Solution",
    "SolverOptions",
    "Supports",
    "SurfaceContact",
    "Trace",
    "Traction",
    "Work",
    "cavity_volume",
    "constant_changes",
    "contact_forces",
    "folded_elements",
    "gradients",
    "inflate",
    "material_derivatives",
    "membrane_forces",
    "neighbouring",
    "nodal_cauchy",
    "nodal_von_mises",
    "peak_von_mises",
    "peaks_by_region",
    "potential",
    "reaction",
    "read_mesh",
    "rotation",
    "section_response",
    "sensitivities",
    "shear_compliance",
    "solve",
    "strain_energy",
    "trace",
    "transfer",
    "work",
    "write_deck",
    "write_mesh",
    "write_vtu",
]


__getattr__ = imported_when_asked_for(
    __name__,
    {
        "adaptivity.transfer": ("transfer",),
        "exchange.abaqus.deck": ("write_deck",),
        "exchange.reading": ("read_mesh",),
        "exchange.writing": ("write_mesh",),
        "material.ogden": ("Ogden",),
        "mesh.mesh": ("Mesh",),
        "paths.arc_length": ("Trace", "trace"),
        "paths.limits": ("Limit",),
        "nonlinear.checkpoint": ("Checkpoint",),
        "nonlinear.finite_motion": ("rotation",),
        "paths.load_stepping": ("solve",),
        "paths.neighbouring": ("Neighbouring", "neighbouring"),
        "nonlinear.events": ("Event",),
        "nonlinear.options": ("SolverOptions",),
        "paths.volume.control": ("inflate",),
        "problem.loads": (
            "AxialForce",
            "BodyForce",
            "Couple",
            "EdgeForce",
            "PointForce",
            "Traction",
        ),
        "problem.contacts": ("Contact", "SurfaceContact"),
        "problem.rigid_bodies": ("RigidCylinder", "RigidPlane", "RigidSphere"),
        "problem.membranes": ("Membrane",),
        "problem.problem": ("Problem", "SlenderAxis"),
        "problem.springs": ("FoundationSpring", "NodeSpring"),
        "results.contacts": ("ContactForce", "contact_forces"),
        "results.energy": ("Potential", "potential", "strain_energy"),
        "results.folds": ("Folds",),
        "results.membranes.forces": ("MembraneForces",),
        "results.reactions": ("Reaction", "reaction"),
        "problem.supports": ("Supports",),
        "results.solution": (
            "PathPoint",
            "Solution",
            "cavity_volume",
            "folded_elements",
            "membrane_forces",
        ),
        "results.vtu": ("write_vtu",),
        "results.work": ("Work", "work"),
        "sensitivity.gradients": ("Gradients", "ResponseGradient", "gradients"),
        "sensitivity.materials": ("constant_changes", "material_derivatives"),
        "sensitivity.section.response": ("SectionDerivatives", "section_response"),
        "sensitivity.section.shear": ("shear_compliance",),
        "sensitivity.sensitivities": ("Sensitivities", "sensitivities"),
        "sensitivity.smooth_peak": ("SmoothPeak",),
        "results.stress": (
            "Peak",
            "nodal_cauchy",
            "nodal_von_mises",
            "peak_von_mises",
            "peaks_by_region",
        ),
    },
)
