"""The contacts of a problem on its mesh."""

from __future__ import annotations

import numpy as np

from solver.assembly.pairs.pair import ContactPair
from solver.assembly.pairs.planes import PlanePair
from solver.assembly.pairs.rounds import RoundPair
from solver.assembly.pairs.surfaces import SurfacePair
from solver.problem.contacts import AnyContact, SurfaceContact
from solver.problem.problem import Problem
from solver.problem.rigid_bodies import RigidCylinder, RigidSphere
from solver.problem.unknowns import Numbering


def contact_pair(problem: Problem, contact: AnyContact, numbering: Numbering) -> ContactPair:
    """A contact of the problem with its triangles' quadrature and numbers of unknowns."""
    if isinstance(contact, RigidCylinder | RigidSphere):
        return RoundPair.of(problem, contact, numbering)
    if isinstance(contact, SurfaceContact):
        return SurfacePair.of(problem, contact, numbering)
    return PlanePair.of(problem, contact, numbering)


def contact_pairs(problem: Problem) -> tuple[ContactPair, ...]:
    """The problem's contacts, with every displacement numbered, also where it is given."""
    size = len(problem.mesh.nodes)
    everything = np.arange(3 * size, dtype=np.int32).reshape(size, 3)
    none = np.full(2, -1, np.int32)
    numbering = Numbering(everything, np.zeros(0, np.int32), none, everything.size)
    return tuple(contact_pair(problem, each, numbering) for each in problem.contacts)
