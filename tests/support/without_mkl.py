"""Importing this hides MKL, as on machines that Intel ships none for: SuperLU factorizes.

PYTHONPATH=tests/support pytest -p without_mkl
"""

from __future__ import annotations

import ctypes

import solver.linear.pardiso


def _missing() -> ctypes.CDLL:
    raise ImportError("MKL is hidden.")


solver.linear.pardiso._load_mkl = _missing
