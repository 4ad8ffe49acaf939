"""Errors whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class SolverError(ValueError):
    """Input that describes no problem the solver takes: one sentence on what is wrong with it."""


class MeshingError(RuntimeError):
    """Gmsh could not mesh the solid, or not well enough; the message says where."""
