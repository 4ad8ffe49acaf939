"""MKL's PARDISO through ctypes."""

from __future__ import annotations

import ctypes
import os
import site
import sys
import weakref
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Integers, Reals
from solver.linear.interface import SingularMatrix, require_symmetric
from solver.linear.sparsity import Pattern, WholeMatrix

PARDISO_PARAMETERS = {
    1: 1,  # these values instead of the defaults
    2: 2,  # nested dissection (METIS)
    8: 0,  # iterative refinement only where pivots had to be perturbed
    10: 8,  # perturb pivots below 1e-8
    21: 1,  # Bunch-Kaufman pivots: the matrix is indefinite
    34: 2,  # the same bits in every run, whatever the threads do
    35: 1,  # indices start at 0
}
GENERAL_PARAMETERS = {
    1: 1,
    2: 2,
    8: 2,  # pivots are not searched outside supernodes: two steps of refinement
    10: 13,  # perturb pivots below 1e-13
    11: 1,  # scale rows and columns
    13: 1,  # permute large entries to the diagonal, which is zero for an incompressible body
    34: 2,
    35: 1,
}
SYMMETRIC, GENERAL = -2, 11
"""PARDISO's numbers for types of matrices: indefinite and real, any real one."""

ANALYSIS, ANALYSIS_AND_FACTORIZATION, FACTORIZATION, SOLUTION, RELEASE = 11, 12, 22, 33, -1
"""Its numbers for what to do."""

TRANSPOSED, NEGATIVE_EIGENVALUES = 12, 23
"""Its numbers for parameters."""

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
        self._store = PardisoStore(SYMMETRIC, PARDISO_PARAMETERS)

    @property
    def odd_negative(self) -> bool | None:
        """Whether the last matrix has an odd number of negative eigenvalues."""
        return None if self.negative_pivots is None else self.negative_pivots % 2 == 1

    def analyze(self, pattern: Pattern) -> None:
        """Fill-reducing ordering and symbolic factorization."""
        self._store.take(pattern.indptr, pattern.indices)
        self._store.call(ANALYSIS)

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Numerical factorization of the matrix with the given CSR values."""
        require_symmetric(self.name, skew)
        self._store.values = values
        self._store.call(FACTORIZATION)
        self.negative_pivots = self._store.parameter(NEGATIVE_EIGENVALUES)

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve with the last factorization."""
        return self._store.call(SOLUTION, right_hand_side)


class GeneralPardiso:
    """MKL's PARDISO, L U with pivoting within supernodes (mtype 11), for any matrix.

    Rows are permuted and scaled by the values (maximum weighted matching) for pivots to be large,
    so each matrix is analyzed anew. Tells nothing about eigenvalues.
    """

    name = "pardiso"
    negative_pivots: int | None = None
    odd_negative: bool | None = None

    def __init__(self) -> None:
        self._store = PardisoStore(GENERAL, GENERAL_PARAMETERS)

    def analyze(self, pattern: Pattern) -> None:
        """Both triangles of the pattern."""
        self._whole = WholeMatrix.of(pattern)
        self._store.take(self._whole.indptr, self._whole.indices)

    def factorize(self, values: Reals, skew: Reals | None = None) -> None:
        """Ordering, symbolic and numerical factorization."""
        self._store.values = self._whole.by_rows(values, skew)
        self._store.call(ANALYSIS_AND_FACTORIZATION)

    def solve(self, right_hand_side: Reals, transposed: bool = False) -> Reals:
        """Solve with the last factorization."""
        self._store.set_parameter(TRANSPOSED, 2 if transposed else 0)
        return self._store.call(SOLUTION, right_hand_side)


class PardisoStore:
    """A matrix of a type that PARDISO knows by number, and what PARDISO keeps about it."""

    def __init__(self, matrix_type: int, parameters: Mapping[int, int]) -> None:
        self._pardiso = _load_mkl().pardiso
        self._type = matrix_type
        self._handle = np.zeros(64, np.int64)
        self._parameters = np.zeros(64, np.int32)
        for number, value in parameters.items():
            self.set_parameter(number, value)
        self._indptr: Integers | None = None
        self._indices: Integers = np.zeros(0, np.int32)
        self.values: Reals = np.zeros(0)
        store = self._pardiso, self._type, self._handle, self._parameters
        weakref.finalize(self, _release, *store)

    def set_parameter(self, number: int, value: int) -> None:
        """Set one of the parameters, numbered from 1 as in PARDISO's manual."""
        self._parameters[number - 1] = value

    def parameter(self, number: int) -> int:
        """One of the parameters."""
        return int(self._parameters[number - 1])

    def take(self, indptr: Integers, indices: Integers) -> None:
        """Take a pattern, with values of zero."""
        self._indptr, self._indices = indptr, indices
        self.set_parameter(TWO_LEVEL, int(len(indptr) > LARGE))
        self.values = np.zeros(len(indices))

    def call(self, phase: int, rhs: Reals | None = None) -> Reals:
        """One phase; the solution if it is that. Raises ``SingularMatrix``, ``MemoryError``."""
        if self._indptr is None:
            raise RuntimeError("PARDISO needs analyze() before anything else.")
        solution = np.zeros(len(self._indptr) - 1)
        given = solution if rhs is None else np.ascontiguousarray(rhs, np.float64)
        error = _pardiso(
            self._pardiso, self._type, self._handle, phase, self.values, self._indptr,
            self._indices, self._parameters, given, solution,
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


@cache
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


@contextmanager
def threads_of_mkl(count: int) -> Iterator[None]:
    """Within the block, calls of MKL from this thread take so many threads, where MKL is there."""
    try:
        library = _load_mkl()
    except ImportError:
        yield
        return
    usual = library.MKL_Set_Num_Threads_Local(count)
    try:
        yield
    finally:
        library.MKL_Set_Num_Threads_Local(usual)


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
    matrix_type: int,
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
    integers = [
        ctypes.c_int32(value) for value in (1, 1, matrix_type, phase, len(indptr) - 1, 1, 0, 0)
    ]
    maxfct, mnum, mtype, c_phase, n, nrhs, verbosity, error = map(ctypes.byref, integers)

    def pointer(array: NDArray[Any]) -> ctypes.c_void_p:
        return array.ctypes.data_as(ctypes.c_void_p)

    function(
        pointer(handle), maxfct, mnum, mtype, c_phase, n, pointer(values), pointer(indptr),
        pointer(indices), None, nrhs, pointer(parameters), verbosity, pointer(rhs),
        pointer(solution), error,
    )  # fmt: skip
    return integers[-1].value


def _release(
    function: Any, matrix_type: int, handle: NDArray[np.int64], parameters: Integers
) -> None:
    nothing, no_index = np.zeros(1), np.zeros(1, np.int32)
    _pardiso(
        function, matrix_type, handle, RELEASE, nothing, no_index, no_index, parameters, nothing,
        nothing,
    )  # fmt: skip
