"""An evaluation of a small body, computed once, and a place to keep it."""

from __future__ import annotations

from pathlib import Path

import pytest
from kept import small

from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.budget import LONGEST, Budget
from bellows_design.store import Store


@pytest.fixture(scope="package")
def evaluation() -> Evaluation:
    """Of one mesh and its ends, at two pressures: all that a store must keep, in little time."""
    unhurried = Budget(seconds=LONGEST)  # on a busy machine, too, there is time for a finer mesh
    solved = started(small(), UNIT_CELL, "as asked for", (0.01, 0.02), budget=unhurried)
    return evaluation_of(solved)


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "store")
