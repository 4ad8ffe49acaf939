"""The picture of the layer."""

from __future__ import annotations

import sys

import pytest
from bead_boxes import Box, with_gap

from printers import PrintersError, load_profile
from printers.leak_test import leak_test
from printers.leak_test.picture import leak_picture


def test_it_shows_the_layer_of_the_leak_or_of_the_thinnest_seal() -> None:
    profile = load_profile("prusa_i3")
    for box in (Box(), Box(wall=with_gap(0.2))):
        test = leak_test(box.beads, [box.opening], profile, seams=False)
        assert test.view is not None
        assert test.view.bottom < test.view.place[2] < test.view.top
        assert len(test.view.beads)
        picture = leak_picture(test)
        assert picture.startswith(b"\x89PNG") and len(picture) > 10_000
        assert picture == leak_picture(test)


def test_the_air_of_the_cavity_and_that_outside_are_told_apart() -> None:
    box = Box(wall=with_gap(0.2))
    view = leak_test(box.beads, [box.opening], load_profile("prusa_i3"), seams=False).view
    assert view is not None
    row = view.air[round((0.0 - view.corner[1]) / view.voxel)]
    row = row[row != 4]  # three gaps are alike: what lies between the narrowest ones is of neither
    changes = row[[0, *(index for index in range(1, len(row)) if row[index] != row[index - 1])]]
    assert changes.tolist() == [2, 0, 1, 2]


def test_without_matplotlib_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    box = Box()
    test = leak_test(box.beads, [box.opening], load_profile("prusa_i3"), seams=False)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(PrintersError, match="pictures need Matplotlib"):
        leak_picture(test)
