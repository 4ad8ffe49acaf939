"""Programs and machine: what decides the digits of a result besides the question.

Processors and numbers of threads round differently; the linear solver is the one that can be
loaded here, not the one that is installed.
"""

from __future__ import annotations

import os
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from bellows_design.machine import processor
from bellows_design.versions import versions

PACKAGES = ("bellows_design", "solver")
"""Ours, beside each other; the printers judge the part, not its evaluation."""

LIBRARIES = ("embreex", "llvmlite", "pydantic", "rtree")
"""Whose versions count besides those that a result names: ray tracers, the compiler."""

SETTINGS = ("KMP_", "MKL_", "NUMBA_", "OMP_", "OPENBLAS_", "RAYON_")
"""Beginnings of environment variables by which the libraries choose threads and instructions."""

NOT_DECISIVE = ("NUMBA_CACHE_DIR", "OMP_WAIT_POLICY")
"""Where files are, and how threads wait; the solver itself sets the latter."""


def surroundings() -> dict[str, Any]:
    """All of it as plain values."""
    from solver.linear.solvers import linear_solver

    return {
        "sources": sources_hash(),
        "versions": versions() | {name: _version(name) for name in LIBRARIES},
        "linear_solvers": [linear_solver().name, linear_solver(symmetric=False).name],
        "processor": processor(),
        "cores": _cores(),
        "settings": settings(os.environ),
    }


def sources_hash(root: Path = Path(__file__).parents[2]) -> str:
    """SHA-256 of our modules below ``root``, as 64 hexadecimal digits."""
    digest = sha256()
    for path in sorted(path for name in PACKAGES for path in (root / name).rglob("*.py")):
        name = path.relative_to(root).as_posix()
        digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def settings(environment: os._Environ[str] | dict[str, str]) -> dict[str, str]:
    """The environment variables that count."""
    return {
        name: value
        for name, value in environment.items()
        if name.startswith(SETTINGS) and name not in NOT_DECISIVE
    }


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _cores() -> int | None:
    """Those that this process may use: so many threads the libraries start."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count()
