"""Which material is where in a mesh, and the stiffness that follows for its parts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from solver.arrays import Integers, Reals
from solver.errors import SolverError
from solver.input_types import check_instance, mapping
from solver.material.law import Hyperelastic
from solver.mesh.faces import elements_at
from solver.mesh.mesh import Mesh


@dataclass(frozen=True)
class Distribution:
    """Materials over a mesh.

    ``main`` is the one of all elements whose regions the names of ``others`` do not have. Numbers
    of materials: 0 for the main one, then in the order of the others.
    """

    mesh: Mesh
    main: Hyperelastic
    others: Mapping[str, Hyperelastic]

    @property
    def materials(self) -> tuple[Hyperelastic, ...]:
        """All of them by their numbers; the main one need not be anywhere."""
        return (self.main, *self.others.values())

    @cached_property
    def of_region(self) -> Integers:
        """Number of each region's material, in the order of ``Mesh.region_names``. (r,)"""
        numbers = {name: number for number, name in enumerate(self.others, start=1)}
        return np.array([numbers.get(name, 0) for name in self.mesh.region_names], np.int32)

    @cached_property
    def of_tet(self) -> Integers:
        """Number of each element's material. (e,)"""
        return self.of_region[self.mesh.region_of_tet]

    @property
    def region_moduli(self) -> Reals:
        """Initial shear modulus of each region, in the order of ``Mesh.region_names``, MPa. (r,)"""
        return np.array([each.shear_modulus for each in self.materials])[self.of_region]

    @property
    def tet_moduli(self) -> Reals:
        """Initial shear modulus of each element, MPa. (e,)"""
        return self.region_moduli[self.mesh.region_of_tet]

    @property
    def moduli(self) -> Reals:
        """Initial shear moduli of the materials that some element has, MPa."""
        return np.array([self.materials[number].shear_modulus for number in np.unique(self.of_tet)])

    def softest_at(self, *surfaces: str) -> int:
        """Number of the softest material of the elements whose faces named surfaces have."""
        if not self.others:
            return 0
        elements = elements_at(self.mesh.tets, self.mesh.triangles(*surfaces))
        return int(self.of_tet[elements[self.tet_moduli[elements].argmin()]])

    def changed(self, number: int, material: Hyperelastic) -> tuple[Hyperelastic, ...]:
        """All materials with another one under a number."""
        return (*self.materials[:number], material, *self.materials[number + 1 :])


def checked_materials(mesh: Mesh, given: Mapping[str, Hyperelastic]) -> dict[str, Hyperelastic]:
    """Materials by region; ``SolverError`` for an unknown region or anything but a material."""
    materials = mapping("materials", given, "region -> material")
    for region, material in materials.items():
        if not isinstance(region, str) or region not in mesh.regions:
            known = ", ".join(sorted(mesh.regions)) or "none"
            raise SolverError(
                f"materials: the mesh has no region {region!r}; known regions: {known}."
            )
        check_instance(f"materials: that of {region!r}", material, Hyperelastic)
    return materials
