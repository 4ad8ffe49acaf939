"""Errors whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class SolverError(ValueError):
    """Invalid input: one sentence on what is wrong with it."""


class MeshingError(RuntimeError):
    """Gmsh could not mesh the solid, or only with invalid elements; the message says where."""
