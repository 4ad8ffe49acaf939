"""Programs that behave as a slicer may."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from pretended_slicer import ANSWER

from printers.slicing.finding import Slicer


@pytest.fixture
def program(tmp_path: Path) -> Callable[..., Path]:
    """A shell script of the body, which answers `--help` as PrusaSlicer does."""

    def written(body: str, answer: str = ANSWER) -> Path:
        path = tmp_path / "slicer.sh"
        path.write_text(f"#!/bin/sh\n{answer}\n{body}\n")
        path.chmod(0o755)
        return path

    return written


@pytest.fixture
def pretended(program: Callable[..., Path]) -> Callable[[str], Slicer]:
    """The script as a slicer."""
    return lambda body: Slicer(program(body), "PrusaSlicer", "2.5.0")


@pytest.fixture
def box() -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """12 x 8 x 4 mm, its lowest corner at (40, 50, 60)."""
    import trimesh

    mesh = trimesh.creation.box((12, 8, 4))
    mesh.apply_translation((46, 54, 62))
    return np.array(mesh.vertices), np.array(mesh.faces)
