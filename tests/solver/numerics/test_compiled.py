"""The cache of compiled functions notices a change of any file they were compiled from."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from numba import config

from solver import compilation
from solver.numerics import compiled as cache

ROOT = Path(__file__).parents[3]

TWO_FILES = {
    "material/inner.py": """
from solver.numerics.compiled import compiled

@compiled()
def inner(x):
    return x + 1.0
""",
    "kernels/outer.py": """
from solver.numerics.compiled import compiled
from solver.material.inner import inner

@compiled()
def outer(x):
    return inner(x)
""",
}
ASK = """
from solver.kernels.outer import outer
print(outer(1.0), sum(outer.stats.cache_hits.values()))
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package ``solver`` of three files: one compiled function that calls another's."""
    solver = tmp_path / "solver"
    for folder in (solver, *(solver / name for name in cache.SOURCES)):
        folder.mkdir()
        (folder / "__init__.py").touch()
    shutil.copy(cache.__file__, solver / "numerics")
    shutil.copy(compilation.__file__, solver)
    for name, code in TWO_FILES.items():
        (solver / name).write_text(code)
    return solver


def answer(package: Path) -> tuple[float, int]:
    """What the outer function returns in a new process, and how often it came from the cache."""
    environment = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    done = subprocess.run(
        [sys.executable, "-c", ASK],
        cwd=package.parent,
        env={**environment, "PYTHONPATH": str(package.parent)},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    value, hits = done.stdout.split()
    return float(value), int(hits)


def test_a_change_of_a_called_function_in_another_file_is_noticed(package: Path) -> None:
    assert answer(package) == (2.0, 0)
    assert answer(package) == (2.0, 1)
    inner = package / "material/inner.py"
    before = inner.stat()
    inner.write_text(inner.read_text().replace("1.0", "5.0"))
    os.utime(inner, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert answer(package) == (6.0, 0)
    assert answer(package) == (6.0, 1)


def test_caches_of_other_versions_go_after_a_while(package: Path) -> None:
    answer(package)
    (used,) = (package / "numerics/__pycache__").glob("solver-*")
    recent, old = (used.with_name(f"solver-{name}") for name in ("recent", "old"))
    for folder in (recent, old):
        folder.mkdir()
    past = time.time() - 2 * cache.KEPT_SECONDS
    os.utime(old, (past, past))
    (package / "material/inner.py").touch()
    answer(package)
    assert recent.exists() and used.exists() and not old.exists()


def test_functions_of_others_are_cached_where_they_were() -> None:
    before = config.CACHE_DIR

    @cache.compiled()
    def twice(x: float) -> float:
        return 2 * x

    assert before == config.CACHE_DIR
    assert twice(2.0) == 4.0


def test_a_package_that_cannot_be_written_to_leaves_the_choice_to_numba(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "numerics").touch()  # a file where a folder would have to be
    monkeypatch.setattr(cache, "PACKAGE", tmp_path)
    assert cache.cache_folder.__wrapped__("") == ""


PACKAGES = ("solver", "printers", "bellows_design")


def names_of_other_files(tree: ast.Module) -> set[str]:
    """Names that compiled functions use and that another file of ours defines."""
    imported = {
        name.asname or name.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in PACKAGES
        for name in node.names
    }
    compiled = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
        and any("njit" in ast.unparse(each) for each in node.decorator_list)
    ]
    used = {
        node.id
        for function in compiled
        for statement in function.body
        for node in ast.walk(statement)
        if isinstance(node, ast.Name)
    }
    return used & imported


def test_names_of_other_files_are_seen_in_compiled_functions_alone() -> None:
    source = """
from printers.limits import LEAST, Floats, helper
from numba import njit

@njit(cache=True)
def inner(values: Floats) -> float:
    return helper(values) + LEAST

def outer(values: Floats) -> float:
    return helper(values)
"""
    assert names_of_other_files(ast.parse(source)) == {"LEAST", "helper"}


def test_elsewhere_compiled_functions_use_nothing_of_other_files() -> None:
    """Those use numba's own cache, which looks at one file only."""
    folders = [ROOT / package for package in PACKAGES]
    files = {path for folder in folders for path in folder.rglob("*.py")}
    keyed = {path for name in cache.SOURCES for path in (ROOT / "solver" / name).glob("*.py")}
    plain = {path for path in files - keyed if "@njit" in path.read_text("utf-8")}
    assert plain
    trees = {path: ast.parse(path.read_text("utf-8")) for path in plain}
    found = {path: names_of_other_files(tree) for path, tree in trees.items()}
    assert {path: names for path, names in found.items() if names} == {}
