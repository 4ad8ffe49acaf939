"""Coarse evaluations to start neighbours from."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from bellows_design.analysis.models import choose
from bellows_design.design.shipped import load_design
from bellows_design.evaluation import Evaluation, evaluation_of, started


@pytest.fixture(scope="session")
def coarse() -> Callable[[str], Evaluation]:
    """A shipped design on its coarsest mesh, with its ends."""

    @cache
    def evaluated(name: str) -> Evaluation:
        design = load_design(name)
        return evaluation_of(started(design, *choose(design)))

    return evaluated
