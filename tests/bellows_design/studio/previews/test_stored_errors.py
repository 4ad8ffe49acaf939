"""What previews were measured to be off by (`tests/benchmarks/preview_errors.py`)."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from preview_errors import Row, rows

STORED = Path(__file__).parents[3] / "benchmarks" / "preview_errors.json"


@pytest.fixture(scope="module")
def stored() -> list[Row]:
    return [Row(**row) for row in json.loads(STORED.read_text("utf-8"))["rows"]]


@pytest.mark.parametrize("quantity", ["angle", "stress"])
def test_no_preview_is_off_by_more_than_both_estimates(stored: list[Row], quantity: str) -> None:
    shares = [row.share(quantity) for row in stored]
    assert len(shares) > 80 and all(share is not None and share < 1 for share in shares)


@pytest.mark.slow
def test_previews_that_are_repeated_are_the_stored_ones(stored: list[Row]) -> None:
    """On another processor the mesher makes other meshes: angles and estimates agree, not bits."""
    again = list(rows(bases=1, count=2))
    assert again
    for row in again:
        known = [
            each
            for each in stored
            if (each.base, each.kind) == (row.base, row.kind)
            and each.distance == pytest.approx(row.distance, abs=1e-4)
        ]
        assert len(known) == 1
        assert row.angle == pytest.approx(known[0].angle, rel=0.01)
        assert row.angle_percent == pytest.approx(known[0].angle_percent, abs=1)
        assert row.share("angle") < 1 and row.share("stress") < 1
