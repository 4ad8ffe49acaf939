"""Layers for a page: beads of the part, the leak or the thinnest seal where they are."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from bead_boxes import HEIGHT, WIDTH, Box, joined_beads, with_gap

from bellows_design.leak_test.layers import print_layers
from bellows_design.web.layers import PrintLayers, packed_layers
from printers import load_profile
from printers.gcode.beads import SKIRT, Beads
from printers.leak_test import LeakTest, leak_test
from printers.slicing.placing import Placement

SHIFT = np.array([120.0, 100.0, 0.0])


class Sliced:
    """What `print_layers` takes of a sliced part: its beads, and where it lies on the bed."""

    def __init__(self, beads: Beads) -> None:
        self.gcode = self
        self.beads = beads
        self.placement = Placement(0.0, SHIFT)


def on_bed(beads: Beads) -> Beads:
    moved = [beads.start + SHIFT[:2], beads.end + SHIFT[:2]]
    rest = [getattr(beads, name) for name in list(beads.__dataclass_fields__)[2:]]
    return Beads(*moved, *rest)


def judged(box: Box, beads: Beads) -> LeakTest:
    """As `check_sliced` does: beads and openings on the bed, places in the part's coordinates."""
    x, y, z = (SHIFT + box.opening.centre).tolist()
    opening = replace(box.opening, centre=(x, y, z))
    profile = load_profile("prusa_i3")
    return leak_test(beads, [opening], profile, seams=False, transform=lambda at: at - SHIFT)


def layers_of(box: Box) -> tuple[LeakTest, PrintLayers]:
    beads = on_bed(box.beads)
    test = judged(box, beads)
    return test, print_layers(cast(Any, Sliced(beads)), test)


def test_a_leak_is_marked_in_its_layer_where_the_beads_part() -> None:
    test, layers = layers_of(Box(wall=with_gap(0.2)))
    mark = layers.marks[0]
    assert mark.severity == "fail" and f"{test.leaks[0].width:.2f} mm" in mark.text
    assert mark.x == pytest.approx(SHIFT[0] + test.leaks[0].place[0])
    top = layers.tops[mark.layer]
    assert top - HEIGHT <= test.leaks[0].place[2] <= top + 1e-6
    here = layers.layer == mark.layer
    ends = np.vstack([layers.start[here], layers.end[here]])
    nearest = np.linalg.norm(ends - [mark.x, mark.y], axis=1).min()
    assert nearest < 2 * WIDTH


def test_of_a_sealed_part_the_thinnest_seal_is_marked() -> None:
    test, layers = layers_of(Box())
    (mark,) = layers.marks
    assert mark.text == f"thinnest seal, {test.depth.lines:.2f} lines"
    verdict = next(rule.verdict for rule in test.rules if rule.rule == "printed_depth")
    assert mark.severity == {"pass": "info", "warn": "warn", "fail": "fail"}[verdict]


def test_the_air_that_was_looked_at_lies_in_its_layer() -> None:
    test, layers = layers_of(Box())
    assert test.view is not None and layers.air is not None
    assert layers.tops[layers.air.layer] == pytest.approx(test.view.top, abs=1e-6)
    low, high = layers.air.corners.min(axis=0), layers.air.corners.max(axis=0)
    assert high - low == pytest.approx(np.multiply(test.view.air.shape[::-1], test.view.voxel))
    (mark,) = layers.marks
    assert (low < (mark.x, mark.y)).all() and (high > (mark.x, mark.y)).all()


def test_skirts_are_no_part_of_it_and_it_can_be_packed() -> None:
    beads = on_bed(Box().beads)
    skirt = beads.chosen(np.arange(4))
    fields = {name: getattr(skirt, name) for name in skirt.__dataclass_fields__}
    skirt = Beads(**(fields | {"kind": np.full(4, SKIRT)}))
    layers = print_layers(cast(Any, Sliced(joined_beads([skirt, beads]))), judged(Box(), beads))
    assert len(layers.start) == len(beads)
    assert len(packed_layers(layers)) > 100
