"""Small meshes built by hand, and materials."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from meshes import (
    bellows_cell_mesh,
    bellows_mesh,
    box_mesh,
    cell_mesh,
    doubled_mesh,
    sphere_mesh,
)

from solver import Mesh, Ogden


@pytest.fixture(scope="session")
def box() -> Callable[..., Mesh]:
    return box_mesh


@pytest.fixture(scope="session")
def bellows() -> Callable[..., Mesh]:
    return bellows_mesh


@pytest.fixture(scope="session")
def cells() -> Callable[..., Mesh]:
    return cell_mesh


@pytest.fixture(scope="session")
def cell() -> Mesh:
    return bellows_cell_mesh()


@pytest.fixture(scope="session")
def doubled() -> Callable[[Mesh], Mesh]:
    return doubled_mesh


@pytest.fixture(scope="session")
def sphere() -> Callable[..., Mesh]:
    return sphere_mesh


@pytest.fixture(scope="session")
def ninjaflex() -> Ogden:
    """NinjaFlex, Curkovic & Jambresic 2020, table 3."""
    return Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054))
