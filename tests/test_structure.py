"""The layout: small folders, and public names that are where the packages say."""

from __future__ import annotations

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
