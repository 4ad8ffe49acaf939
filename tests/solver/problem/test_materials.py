"""Materials of regions: which is where, and what the supports must leave to incompressible ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from two_materials import HARD, OTHER, SOFT, layered

from solver import Contact, Ogden, Problem, Supports
from solver.assembly.pairs.made import contact_pairs
from solver.errors import SolverError

ALL = ("x0", "x1", "y0", "y1", "z0", "z1")
CLAMPED = Supports(("z0",))


@pytest.mark.parametrize(
    ("materials", "said"),
    [
        ({"stiff": HARD}, "materials: the mesh has no region 'stiff'; known regions: hard"),
        ({"": HARD}, "materials: the mesh has no region ''"),
        ({"hard": 3.0}, "materials: that of 'hard' must be a Hyperelastic, got 3.0"),
        ([HARD], "materials must be a dict of region -> material"),
    ],
)
def test_what_is_no_material_of_a_region_is_refused(materials: object, said: str) -> None:
    with pytest.raises(SolverError, match=said):
        Problem(layered(), SOFT, CLAMPED, materials=materials)  # type: ignore[arg-type]


def test_elements_that_no_material_is_named_for_have_the_main_one() -> None:
    mesh = layered()
    mesh = mesh.with_regions({"also": np.setdiff1d(np.arange(4), mesh.regions["hard"])})
    found = Problem(mesh, SOFT, CLAMPED, materials={"hard": HARD}).distribution
    assert found.materials == (SOFT, HARD)
    assert np.array_equal(np.flatnonzero(found.of_tet), np.sort(mesh.regions["hard"]))
    assert np.array_equal(found.moduli, [1.0, 10.0])


def compressible(material: Ogden) -> Ogden:
    return replace(material, bulk_modulus=100.0)


def test_an_incompressible_region_may_push_into_a_compressible_one() -> None:
    Problem(layered(), compressible(SOFT), Supports(ALL), materials={"hard": HARD})
    Problem(layered(), SOFT, Supports(ALL), materials={"hard": compressible(HARD)})


def test_incompressible_regions_that_fill_their_supports_are_refused() -> None:
    with pytest.raises(SolverError, match=r"whole surface of an incompressible (body|region)"):
        Problem(layered(), SOFT, Supports(ALL), materials={"hard": HARD})
    Problem(layered(), SOFT, Supports(ALL[:-1]), materials={"hard": HARD})


def test_the_region_that_supports_enclose_is_named() -> None:
    mesh = layered()
    middle = mesh.nodes[:, 2] == 0.5
    triangles = mesh.tets[mesh.regions["hard"]][:, [0, 2, 1, 6, 5, 4]]
    others = mesh.tets[mesh.regions["hard"]][:, [1, 2, 3, 5, 8, 9]]
    both = np.concatenate([triangles, others])
    between = both[middle[both].all(axis=1)]
    enclosed = mesh.with_surfaces({"between": between})
    with pytest.raises(SolverError, match="incompressible region 'hard'"):
        Problem(
            enclosed,
            SOFT,
            Supports(("between", "z1"), symmetry={"x0": 0, "x1": 0, "y0": 1, "y1": 1}),
            materials={"hard": HARD},
        )


def test_contacts_are_as_stiff_as_the_softest_material_at_their_surfaces() -> None:
    contacts = tuple(Contact(name, 0.1, axis=0) for name in ("x1", "z1", "z0"))
    mesh = layered().moved(layered().nodes + np.array([0.1, 0.0, 0.0]))
    problem = Problem(mesh, SOFT, CLAMPED, contacts=contacts, materials={"hard": OTHER})
    stiffness = [pair.face.stiffness for pair in contact_pairs(problem)]
    modulus = OTHER.shear_modulus
    assert stiffness == pytest.approx([10.0, 10.0 * modulus, 10.0])
