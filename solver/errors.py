"""Errors whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class SolverError(ValueError):
    """Invalid input: one sentence on what is wrong with it."""


class MeshingError(RuntimeError):
    """Gmsh could not mesh the solid, or only with invalid elements; the message says where.

    Examples:
        >>> from io import BytesIO
        >>> import cadquery as cq
        >>> from solver.meshing import MeshingError, MeshOptions, mesh_solid
        >>> content = BytesIO()
        >>> cq.Solid.makeBox(20, 20, 20).exportBrep(content)
        True
        >>> try:
        ...     mesh_solid(content.getvalue(), ["outside"] * 6, MeshOptions(size=0.2), seconds=0.1)
        ... except MeshingError as error:
        ...     print(str(error)[:53])
        Gmsh did not mesh the solid within 0.1 s and was stop
    """
