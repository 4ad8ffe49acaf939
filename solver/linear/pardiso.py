"""MKL's PARDISO through ctypes."""

from __future__ import annotations

import ctypes
import os
import site
import sys
import weakref
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.linear.interface import SingularMatrix
from solver.linear.sparsity import Pattern

PARDISO_PARAMETERS = {
    1: 1,  # these values instead of the defaults
    2: 2,  # nested dissection (METIS)
    8: 0,  # iterative refinement only where pivots had to be perturbed
    10: 8,  # perturb pivots below 1e-8
    21: 1,  # Bunch-Kaufman pivots: the matrix is indefinite
    34: 2,  # the same bits in every run, whatever the threads do
    35: 1,  # indices start at 0
}
SINGULAR, NO_MEMORY, TOO_LARGE = (-4, -7), (-2, -9), (-8,)
"""PARDISO's error numbers that say so; all others are faults of a call."""

LP64, INTEL_THREADS = 0, 0
"""MKL's numbers for interfaces with integers of 32 bits, and for its own threads."""

TWO_LEVEL = 24
LARGE = 60_000
"""Unknowns from which on the two-level parallel factorization repays its longer analysis."""


class Pardiso:
    """MKL's PARDISO, L D L^T with Bunch-Kaufman pivoting (mtype -2), in double precision.

    In single precision a factorization takes three fifths of the time, but what its solutions get
    wrong is the softest mode of the body, which makes most of a step (``docs/linear-solves.md``).
    """

    name = "pardiso"

    def __init__(self) -> None:
        self.negative_pivots: int | None = None
        self._pardiso = _load_mkl().pardiso
        self._handle = np.zeros(64, np.int64)
        self._parameters = np.zeros(64, np.int32)
        for number, value in PARDISO_PARAMETERS.items():
            self._parameters[number - 1] = value
        self._pattern: Pattern | None = None
        self._values = np.zeros(0)
        weakref.finalize(self, _release, self._pardiso, self._handle, self._parameters)

    @property
    def odd_negative(self) -> bool | None:
        """Whether the last matrix has an odd number of negative eigenvalues."""
        return None if self.negative_pivots is None else self.negative_pivots % 2 == 1

    def analyze(self, pattern: Pattern) -> None:
        """Fill-reducing ordering and symbolic factorization."""
        self._pattern = pattern
        self._parameters[TWO_LEVEL - 1] = len(pattern.indptr) > LARGE
        self._values = np.zeros(len(pattern.indices))
        self._call(11)

    def factorize(self, values: Reals) -> None:
        """Numerical factorization of the matrix with the given CSR values."""
        self._values = values
        self._call(22)
        self.negative_pivots = int(self._parameters[22])

    def solve(self, right_hand_side: Reals) -> Reals:
        """Solve with the last factorization."""
        return self._call(33, right_hand_side)

    def _call(self, phase: int, rhs: Reals | None = None) -> Reals:
        pattern = self._pattern
        if pattern is None:
            raise RuntimeError("PARDISO needs analyze() before anything else.")
        solution = np.zeros(len(pattern.indptr) - 1)
        given = solution if rhs is None else np.ascontiguousarray(rhs, np.float64)
        error = _pardiso(
            self._pardiso, self._handle, phase, self._values, pattern.indptr,
            pattern.indices, self._parameters, given, solution,
        )  # fmt: skip
        if error:
            raise _failure(error, phase)
        return solution


def _failure(error: int, phase: int) -> Exception:
    """What a number of PARDISO's means."""
    if error in NO_MEMORY:
        return MemoryError("PARDISO found no memory for the factors of the matrix")
    if error in TOO_LARGE:
        return MemoryError("the factors of the matrix are too large for PARDISO's 32-bit integers")
    text = f"PARDISO failed with error {error} in phase {phase}"
    return SingularMatrix(text) if error in SINGULAR else RuntimeError(text)


def _load_mkl() -> ctypes.CDLL:
    """MKL's single dynamic library, as its wheel or conda installs it, or the system's.

    Raises ``ImportError`` when there is none that loads.
    """
    roots = (Path(sys.prefix), Path(site.getuserbase()))
    patterns = ("lib/libmkl_rt.so*", "Library/bin/mkl_rt*.dll")
    found = [str(path) for root in roots for glob in patterns for path in sorted(root.glob(glob))]
    for name in (*found, "libmkl_rt.so", "mkl_rt.dll"):
        try:
            library = ctypes.CDLL(name)
        except OSError:
            continue
        return _with_our_interface(library)
    raise ImportError("MKL (mkl_rt) cannot be loaded; install the package mkl.")


def _with_our_interface(library: ctypes.CDLL) -> ctypes.CDLL:
    """``library``, set to integers of 32 bits and to threads that come with it.

    Variables of the environment that another program needs (``MKL_INTERFACE_LAYER``,
    ``MKL_THREADING_LAYER``) choose layers that read our integers wrongly or are not installed,
    which ends the process. Raises ``ImportError`` where another interface is in use already.
    """
    if library.MKL_Set_Interface_Layer(LP64) != LP64:
        raise ImportError("MKL is in use already with an interface that is not LP64.")
    if os.environ.get("MKL_THREADING_LAYER", "INTEL").upper() != "SEQUENTIAL":
        library.MKL_Set_Threading_Layer(INTEL_THREADS)
    return library


def _pardiso(
    function: Any,
    handle: NDArray[np.int64],
    phase: int,
    values: Reals,
    indptr: Integers,
    indices: Integers,
    parameters: Integers,
    rhs: Reals,
    solution: Reals,
) -> int:
    """One call of MKL's ``pardiso``; returns its error number."""
    integers = [ctypes.c_int32(value) for value in (1, 1, -2, phase, len(indptr) - 1, 1, 0, 0)]
    maxfct, mnum, mtype, c_phase, n, nrhs, verbosity, error = map(ctypes.byref, integers)

    def pointer(array: NDArray[Any]) -> ctypes.c_void_p:
        return array.ctypes.data_as(ctypes.c_void_p)

    function(
        pointer(handle), maxfct, mnum, mtype, c_phase, n, pointer(values), pointer(indptr),
        pointer(indices), None, nrhs, pointer(parameters), verbosity, pointer(rhs),
        pointer(solution), error,
    )  # fmt: skip
    return integers[-1].value


def _release(function: Any, handle: NDArray[np.int64], parameters: Integers) -> None:
    nothing, no_index = np.zeros(1), np.zeros(1, np.int32)
    _pardiso(function, handle, -1, nothing, no_index, no_index, parameters, nothing, nothing)
