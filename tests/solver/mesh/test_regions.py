"""Regions: sets of elements whose nodes have a side in each of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from two_materials import layered

from solver import Mesh, Supports
from solver.errors import SolverError
from solver.mesh.faces import elements_at
from solver.problem.unknowns import number_unknowns

Meshes = Callable[..., Mesh]


@pytest.mark.parametrize(
    ("regions", "said"),
    [
        ({"a": [0, 1], "b": [1, 2]}, "element 1 is in the regions 'a' and 'b'"),
        ({"a": [0, 6]}, "'a' names element 6, but the elements are numbered 0 to 5"),
        ({"a": [-1]}, "'a' names element -1"),
        ({"a": [3, 3]}, "'a' names element 3 twice"),
        ({"a": []}, "'a' has no elements"),
        ({"a": [2**32 + 1]}, "'a' names element 4294967297"),
        ({"": [0]}, "the name of a region must be a text"),
        ({7: [0]}, "the name of a region must be a text"),
        ({"a": [True, False]}, "must be numbers of elements"),
        ({"a": [0.5]}, "must be numbers of elements"),
        ({"a": [[0, 1]]}, "must be numbers of elements"),
        ({"a": [[0], [1, 2]]}, "must be numbers of elements"),
        (["a"], "regions must be a dict of name -> elements"),
    ],
)
def test_what_is_no_region_is_refused_in_one_sentence(
    box: Meshes, regions: object, said: str
) -> None:
    mesh = box((1, 1, 1))
    with pytest.raises(SolverError, match=said) as error:
        Mesh(mesh.nodes, mesh.tets, mesh.surfaces, regions)  # type: ignore[arg-type]
    assert "\n" not in str(error.value)


def test_a_node_has_one_pressure_in_each_region_around_it() -> None:
    mesh = layered()
    between = np.isin(mesh.vertices, mesh.vertices[:-1][np.diff(mesh.vertices) == 0])
    assert (mesh.nodes[mesh.vertices[between], 2] == 0.5).all()
    assert between.sum() == 2 * 9
    assert (np.diff(mesh.vertices) >= 0).all()
    assert np.array_equal(mesh.vertices[mesh.tet_vertices], mesh.tets[:, :4])
    assert np.array_equal(mesh.sides[mesh.tet_sides], mesh.tets)
    own = mesh.region_of_tet[:, None]
    assert (mesh.region_of_vertex[mesh.tet_vertices] == own).all()
    assert (mesh.region_of_side[mesh.tet_sides] == own).all()


def test_each_pressure_is_one_unknown_beside_those_of_its_node() -> None:
    mesh = layered()
    numbers = number_unknowns(mesh, Supports(clamped=("z0",)))
    everything = np.concatenate([numbers.displacement.ravel(), numbers.pressure])
    everything = np.sort(everything[everything >= 0])
    assert np.array_equal(everything, np.arange(numbers.size))
    twice = np.flatnonzero(np.diff(mesh.vertices) == 0)
    assert (numbers.pressure[twice + 1] == numbers.pressure[twice] + 1).all()
    last = numbers.displacement[mesh.vertices[twice], 2]
    assert (numbers.pressure[twice] == last + 1).all()


def test_naming_the_whole_body_changes_no_number(box: Meshes) -> None:
    mesh = box((2, 1, 1))
    named = mesh.with_regions({"body": np.arange(len(mesh.tets))})
    for name in ("vertices", "tet_vertices", "sides", "tet_sides"):
        assert np.array_equal(getattr(named, name), getattr(mesh, name)), name
    assert named.region_names == ("", "body")
    assert (named.region_of_tet == 1).all()


def test_meshes_made_from_one_another_keep_regions(box: Meshes) -> None:
    mesh = layered()
    moved = mesh.moved(2.0 * mesh.nodes)
    named = mesh.with_surfaces({"more": mesh.surfaces["x0"]})
    for each in (moved, named):
        assert np.array_equal(each.regions["hard"], mesh.regions["hard"])
        assert np.array_equal(each.vertices, mesh.vertices)
    rest = np.setdiff1d(np.arange(len(mesh.tets)), mesh.regions["hard"])
    other = mesh.with_regions({"soft": rest})
    assert other.region_names == ("", "hard", "soft")
    assert set(np.unique(other.region_of_tet)) == {1, 2}


def test_regions_cannot_be_written_to() -> None:
    with pytest.raises(ValueError, match="read-only"):
        layered().regions["hard"][0] = 1


def test_elements_at_a_surface_have_one_of_its_triangles(box: Meshes) -> None:
    mesh = box((2, 2, 2))
    found = elements_at(mesh.tets, mesh.triangles("x0"))
    on = (mesh.nodes[mesh.tets[:, :4], 0] == 0).sum(axis=1) == 3
    assert np.array_equal(found, np.flatnonzero(on))
    assert len(found) == len(mesh.surfaces["x0"])
