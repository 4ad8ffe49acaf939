"""The layout: small folders, and public names that are where the packages say."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("bellows_design", "solver", "printers")
FOLDERS = [folder for name in PACKAGES for folder in ROOT.joinpath(name).rglob("**/")]

MOST_MODULES = 12
"""Beside each other in a folder: so many are found at a glance."""


def modules(folder: Path) -> list[str]:
    return [path.stem for path in folder.glob("*.py") if path.stem != "__init__"]


def test_no_folder_has_more_modules_than_are_found_at_a_glance() -> None:
    counts = {str(folder.relative_to(ROOT)): len(modules(folder)) for folder in FOLDERS}
    assert counts["solver/nonlinear"] > 0
    assert {name: count for name, count in counts.items() if count > MOST_MODULES} == {}


@pytest.mark.parametrize(
    "package",
    [
        *PACKAGES,
        "bellows_design.design",
        "bellows_design.evaluation",
        "bellows_design.geometry",
        "bellows_design.materials",
        "solver.mesh",
        "solver.meshing",
    ],
)
def test_every_public_name_of_a_package_is_there(package: str) -> None:
    facade = import_module(package)
    assert facade.__all__ and all(getattr(facade, name) is not None for name in facade.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        facade.nothing  # noqa: B018


PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS: dict[str, list[str]] = PROJECT["optional-dependencies"]

BROUGHT_BY = {
    "OCP": "cadquery",
    "PIL": "pyvista",
    "_pytest": "pytest",
    "dask": "distributed",
    "markupsafe": "jinja2",
    "pydantic_core": "pydantic",
    "pyparsing": "cadquery",
    "referencing": "jsonschema",
    "vtkmodules": "cadquery",
}
"""Modules, and the packages that bring them and cannot do without them."""

NOT_INSTALLED = (
    "tests/benchmarks/peers/",
    "tests/benchmarks/optimizers.py",
    "tests/bellows_design/cli/test_interruption.py",
)
"""Comparisons with other programs, which say themselves what they need; and a test that writes a
module before it imports it."""


def required(lines: list[str]) -> Iterator[str]:
    """Names of packages; those of this project's own extras, too."""
    for line in lines:
        own = re.match(r"bellows-design\[(.*)\]", line)
        if own:
            for extra in own[1].split(","):
                yield from required(EXTRAS[extra])
        else:
            yield re.split(r"[^A-Za-z0-9_.-]", line)[0].lower().replace("-", "_")


def imported(path: Path) -> Iterator[str]:
    """Packages that a file imports, within functions too."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield str(node.module).split(".")[0]


def foreign_imports(top: str) -> dict[str, str]:
    """Modules of others that files below a folder import, and a file that does."""
    ours = [path for name in (*PACKAGES, "docs", "tests") for path in ROOT.glob(f"{name}/**/*.py")]
    own = {path.stem for path in ours} | {path.parent.name for path in ours} | {*PACKAGES}
    found = {}
    for path in sorted(ROOT.joinpath(top).rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if not name.startswith(NOT_INSTALLED):
            found.update({module: name for module in imported(path)})
    return {m: name for m, name in found.items() if m not in own | sys.stdlib_module_names}


@pytest.mark.parametrize("top", [*PACKAGES, "docs", "examples", "tests"])
def test_what_is_imported_is_installed_with_the_extra_test(top: str) -> None:
    """The tests run whatever the product can do, on a machine on which nothing else is."""
    there = {*required(PROJECT["dependencies"]), *required(EXTRAS["test"])}
    missing = {
        module: name
        for module, name in foreign_imports(top).items()
        if BROUGHT_BY.get(module, module).lower() not in there
    }
    assert missing == {}
