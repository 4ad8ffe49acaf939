"""Membranes: films on surfaces of a body that stretch by their modulus and bend freely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.errors import SolverError
from solver.input_types import check_instance, check_number, members_of
from solver.mesh.elements import TETRAHEDRON_EDGES, TRIANGLE_EDGES
from solver.mesh.faces import FACES, edge_keys, face_keys, place_of
from solver.mesh.mesh import Mesh


@dataclass(frozen=True)
class Membrane:
    """A film glued to a surface: it resists stretching, and bends without any resistance.

    Its stress is plane and linear in its Green strain (St. Venant and Kirchhoff's law), so that it
    is for films that stretch little, however much they bend and turn. It bears tension only: where
    it is pressed together it wrinkles, and its strain and stress are means over the wrinkles
    (tension field). With ``wrinkles=False`` it bears compression too, as far as the body under it
    keeps its stability (``membrane_forces`` says where).

    Attributes:
        surface: name of the surface, outer or within the body.
        young_modulus: MPa.
        poisson_ratio: above -1, up to 0.5.
        thickness: of the undeformed film, mm.
        wrinkles: whether it wrinkles instead of bearing compression.

    Raises:
        SolverError: a number that is not one, or out of its bounds.

    Examples:
        >>> from solver import Membrane, Ogden, Problem, Supports, Traction, solve
        >>> from solver.mesh import block
        >>> bar, pull = block((30, 4, 4), (6, 1, 1)), Traction("x1", (0.01, 0, 0))
        >>> held, rubber = Supports(("x0",)), Ogden.neo_hooke(0.5)
        >>> film = Membrane("z0", young_modulus=500.0, poisson_ratio=0.3, thickness=0.05)
        >>> for films in ((), (film,)):
        ...     solution = solve(Problem(bar, rubber, held, loads=(pull,), membranes=films))
        ...     print(f"{solution.displacement[:, 2].min():.2f} mm")  # it bends towards the film
        -0.01 mm
        -0.66 mm
    """

    surface: str
    young_modulus: float
    poisson_ratio: float
    thickness: float
    wrinkles: bool = True

    def __post_init__(self) -> None:
        check_instance("membranes: surface", self.surface, str)
        check_instance("membranes: wrinkles", self.wrinkles, bool)
        for name, unit in (("young_modulus", " MPa"), ("poisson_ratio", ""), ("thickness", " mm")):
            check_number(f"membranes: {name}", value := getattr(self, name))
            if name == "poisson_ratio" and not -1 < value <= 0.5:
                raise SolverError(
                    f"membranes: poisson_ratio = {value:g} must be above -1 and at most 0.5."
                )
            if name != "poisson_ratio" and not 0 < value < np.inf:
                raise SolverError(
                    f"membranes: {name} = {value:g}{unit} must be positive and finite."
                )

    @property
    def stiffness(self) -> float:
        """Young's modulus times thickness, N/mm."""
        return self.young_modulus * self.thickness


def check_membranes(
    mesh: Mesh, membranes: Sequence[Membrane], moving_plane: str | None
) -> tuple[Membrane, ...]:
    """Membranes as a tuple.

    Raises ``SolverError`` for anything else, on surfaces that are not made of faces of tetrahedra,
    each once, and with a moving plane.
    """
    given = members_of("membranes", membranes, (Membrane,))
    found = tuple(each for each in given if isinstance(each, Membrane))
    if found and moving_plane is not None:
        raise SolverError("membranes: a cell with a moving plane takes none.")
    for membrane in found:
        _check_surface(mesh, membrane.surface)
    return found


def _check_surface(mesh: Mesh, surface: str) -> None:
    """Raise ``SolverError`` unless a surface is made of faces of the tetrahedra."""
    triangles, size = mesh.triangles(surface), len(mesh.nodes)
    if len(triangles) == 0:
        raise SolverError(f"membranes: the surface {surface!r} has no triangles.")
    faces = np.concatenate([mesh.tets[:, face] for face in FACES])
    sides = np.sort(triangles[:, :3], axis=1)
    wrong = ~np.isin(face_keys(sides, size), face_keys(np.sort(faces, axis=1), size))
    on_edges = np.isin(
        edge_keys(triangles, TRIANGLE_EDGES, size), edge_keys(mesh.tets, TETRAHEDRON_EDGES, size)
    )
    wrong |= ~on_edges.reshape(-1, 3).all(axis=1)
    if wrong.any():
        raise SolverError(
            f"membranes: a triangle of the surface {surface!r} at "
            f"{place_of(mesh.nodes, triangles[wrong][0])} mm is no face of a tetrahedron."
        )
    if len(np.unique(sides, axis=0)) < len(sides):
        raise SolverError(f"membranes: the surface {surface!r} has a triangle twice.")
