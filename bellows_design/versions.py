"""Versions of what a result depends on."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

from bellows_design import __version__

DEPENDENCIES = (
    "cadquery",
    "cadquery-ocp",
    "feral-solver",
    "gmsh",
    "lib3mf",
    "manifold3d",
    "meshio",
    "mkl",
    "numba",
    "numpy",
    "scipy",
    "trimesh",
)


def versions() -> dict[str, str]:
    """Package -> version, for the packages that are installed."""
    found = {"bellows-design": __version__, "python": platform.python_version()}
    for name in DEPENDENCIES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue  # MKL, for one, does not exist everywhere
    return found
