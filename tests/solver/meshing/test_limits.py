"""What ends Gmsh whatever the solid is not blamed on the solid."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from solver.meshing import limits
from solver.meshing.limits import ENOUGH_STACK, cause_of_end

ROOT = Path(__file__).parents[3]
POSIX = pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")


@pytest.mark.parametrize(
    "how",
    [
        "SIGKILL",
        "exit status 0x1: MemoryError",
        "exit status 0x1: ImportError: libgmsh.so: failed to map segment from shared object",
        "exit status 0x1: terminate called after throwing an instance of 'std::bad_alloc'",
    ],
)
def test_want_of_memory_is_named(how: str) -> None:
    cause = cause_of_end(how)
    assert cause is not None and "want of memory" in cause and how in cause


def test_a_small_stack_is_named_where_it_is_small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "_hard_limit_of_stack", lambda: 256 * 1024)
    cause = cause_of_end("SIGSEGV")
    assert cause is not None and "limited to 256 KiB (ulimit -s); allow it 8192" in cause
    monkeypatch.setattr(limits, "_hard_limit_of_stack", lambda: ENOUGH_STACK)
    assert cause_of_end("SIGSEGV") is None


def test_anything_else_may_be_the_solids_fault() -> None:
    assert cause_of_end("SIGABRT") is None and cause_of_end("exit status 0x1") is None


@POSIX
def test_a_soft_limit_of_the_stack_is_raised() -> None:
    code = (
        "import resource as r\n"
        "from solver.meshing.limits import allow_stack\n"
        "_, hard = r.getrlimit(r.RLIMIT_STACK)\n"
        "r.setrlimit(r.RLIMIT_STACK, (262144, hard))\n"
        "allow_stack()\n"
        "print(r.getrlimit(r.RLIMIT_STACK)[0])"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, check=True)
    assert int(done.stdout) >= min(ENOUGH_STACK, limits._hard_limit_of_stack())
