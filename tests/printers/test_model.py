"""Parts and declarations that are refused."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from printers import DeclaredGap, DeclaredWall, Opening, PrintedModel, PrintersError


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: DeclaredWall("side", float("nan")), ["side", "nan mm"]),
        (lambda: DeclaredWall("side", -1.2), ["side", "-1.2 mm", "above 0"]),
        (lambda: DeclaredWall("side", 1200.0), ["side", "1200 mm", "100 mm"]),
        (lambda: DeclaredWall("side", 1.2, "rows"), ["side", "rows", "lines", "layers"]),  # type: ignore[arg-type]
        (lambda: DeclaredGap("slot", 0.0), ["slot", "0 mm"]),
        (lambda: Opening("port", (0, 0, 0), (-2, 0, 0), 1.0), ["port", "length 2"]),
        (lambda: Opening("port", (0, 0, np.inf), (-1, 0, 0), 1.0), ["port", "centre"]),
        (lambda: Opening("port", (0, 0, 0), (-1, 0, 0), 0.0), ["port", "radius", "0 mm"]),
    ],
)
def test_a_bad_declaration_is_named(build: Callable[[], object], words: list[str]) -> None:
    with pytest.raises(PrintersError) as error:
        build()
    assert all(word in str(error.value) for word in words), str(error.value)


def test_a_part_in_metres_is_refused(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box())
    with pytest.raises(PrintersError, match="units"):
        PrintedModel(vertices / 1000, triangles)
    with pytest.raises(PrintersError, match="units"):
        PrintedModel(vertices * 1000, triangles)


def test_malformed_arrays_are_refused(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box())
    with pytest.raises(PrintersError, match="finite"):
        PrintedModel(np.where(vertices == vertices.max(), np.nan, vertices), triangles)
    with pytest.raises(PrintersError, match="count from 0"):
        PrintedModel(vertices, triangles + len(vertices))
    with pytest.raises(PrintersError, match="shape"):
        PrintedModel(vertices[:, :2], triangles)


def test_the_model_cannot_be_changed_through_its_source(solids: SimpleNamespace) -> None:
    vertices, triangles = solids.arrays(solids.hollow_box())
    copy = np.array(vertices)
    model = PrintedModel(copy, triangles)
    copy[:] = 0
    assert np.array_equal(model.vertices, vertices)
    with pytest.raises(ValueError, match="read-only"):
        model.vertices[0, 0] = 1.0
