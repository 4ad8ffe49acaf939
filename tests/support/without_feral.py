"""Importing this hides the package feral-solver, as where it is not installed.

PYTHONPATH=tests/support pytest -p without_mkl -p without_feral
"""

from __future__ import annotations

from typing import Any

import solver.linear.feral


def _missing() -> Any:
    raise ImportError("feral is hidden.")


solver.linear.feral._load_feral = _missing
