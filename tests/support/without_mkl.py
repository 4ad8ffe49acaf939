"""Importing this hides MKL, as on machines that Intel ships none for: feral factorizes.

PYTHONPATH=tests/support pytest -p without_mkl

With ``-p without_mkl -p without_feral`` it is SuperLU that does.
"""

from __future__ import annotations

import ctypes

import solver.linear.pardiso


def _missing() -> ctypes.CDLL:
    raise ImportError("MKL is hidden.")


solver.linear.pardiso._load_mkl = _missing
