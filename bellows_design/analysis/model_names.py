"""The names of the analysis models. Imports nothing heavy, so that ``--help`` can list them."""

from __future__ import annotations

from enum import StrEnum


class ModelName(StrEnum):
    """A model to evaluate with; ``auto`` is the smallest that answers."""

    AUTO = "auto"
    UNIT_CELL = "unit-cell"
    HALF = "half"
    FULL = "full"
