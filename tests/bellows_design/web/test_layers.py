"""Layers of a print come back from their packing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from shapes_to_show import two_layers
from unpacking import unpacked

from bellows_design.web.layers import PrintLayers, layers_element, packed_layers
from bellows_design.web.scene import SceneError


def unpacked_beads(packed: bytes) -> tuple[np.ndarray, ...]:
    """Start, end, width, kind and layer of all beads."""
    found = unpacked(packed)
    header = found.header
    lengths = found.numbers(header["lengths"], header["runs"], 1)[:, 0].astype(int)
    points = found.numbers(header["points"], header["runs"] + header["beads"], 2)
    places = points * header["step"] + np.array(header["low"])
    first = np.cumsum(lengths + 1) - (lengths + 1)
    last = first + lengths
    start = np.delete(places, last, axis=0)
    end = np.delete(places, first, axis=0)
    width = found.numbers(header["widths"], header["beads"], 1)[:, 0] * header["step"]
    per_run = (found.numbers(header[name], header["runs"], 1)[:, 0] for name in ("kinds", "layers"))
    return start, end, width, *(np.repeat(each, lengths) for each in per_run)


def test_every_bead_comes_back_within_half_a_step() -> None:
    random = np.random.default_rng(7)
    count = 500
    start = random.uniform(0, 200, (count, 2))
    joined = random.random(count) < 0.7
    end = np.where(joined[:, None], np.roll(start, -1, axis=0), random.uniform(0, 200, (count, 2)))
    layers = PrintLayers(
        start, end, random.uniform(0.2, 0.6, count), random.integers(0, 3, count),
        np.sort(random.integers(0, 40, count)), np.arange(1, 41) * 0.1, ("a", "b", "c"),
    )  # fmt: skip
    found = unpacked_beads(packed_layers(layers))
    for got, given in zip(found, (start, end, layers.width), strict=False):
        assert np.abs(got - given).max() <= 0.005 + 1e-9
    np.testing.assert_array_equal(found[3], layers.kind)
    np.testing.assert_array_equal(found[4], layers.layer)


def test_beads_that_follow_each_other_are_one_run() -> None:
    header = unpacked(packed_layers(two_layers())).header
    assert (header["runs"], header["beads"]) == (3, 6)


def test_text_of_marks_is_no_markup_in_the_page() -> None:
    assert "<wide>" not in layers_element(two_layers())


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"start": np.zeros((0, 2))}, "no beads"),
        ({"width": np.ones(5)}, "6 beads but 5 width"),
        ({"width": np.full(6, np.nan)}, "not a finite number"),
        ({"layer": np.array([1, 0, 0, 0, 1, 1])}, "not in the order"),
        ({"tops": np.array([0.2])}, "in layer 1, of 1"),
        ({"start": two_layers().start * 8}, "longer than 655 mm"),
    ],
)
def test_what_cannot_be_shown_is_refused_with_a_sentence(
    changes: dict[str, np.ndarray], sentence: str
) -> None:
    with pytest.raises(SceneError, match=sentence):
        packed_layers(replace(two_layers(), **changes))


def test_a_layer_that_is_not_there_cannot_be_shown_first() -> None:
    with pytest.raises(SceneError, match="no layer 2: the last one is 1"):
        layers_element(two_layers(), layer=2)
