"""A slicer and the leak test put together: their record says each thing once."""

from __future__ import annotations

import json
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from bead_boxes import Box
from small_solids import arrays, hollow_box

from printers import PrintedModel, load_profile
from printers.gcode.reading import GCode
from printers.orientation.turning import AS_IN_FILE
from printers.rule_table import RULES
from printers.sliced_check import check_sliced
from printers.slicing.finding import Slicer
from printers.slicing.making import Sliced
from printers.slicing.placing import Placement


def sliced_box() -> Sliced:
    """The box of beads, as a slicer's; its part stands where the G-code has it."""
    code = GCode(Box().beads, "It", "1", 60.0, 1.75, "G-code", 9.0, 9.0, MappingProxyType({}), ())
    stays = Placement(0.0, np.zeros(3))
    return Sliced(code, "It", "1", "ab", 1.0, stays, True, ("Odd.",), ("Something is missing.",))


def test_rules_and_notes_stand_beside_the_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("printers.sliced_check.slice_mesh", lambda *_: sliced_box())
    model = PrintedModel(*arrays(hollow_box()), openings=(Box().opening,))
    slicer = Slicer(Path("it"), "It", "1")
    found = check_sliced(model, load_profile("prusa_i3"), AS_IN_FILE, slicer)
    record = found.to_dict()
    json.dumps(record, allow_nan=False)
    assert "notes" not in record and not {"rules", "notes"} & set(record["leak_test"])
    assert found.notes[:2] == ("Something is missing.", "the slicer warns: Odd.")
    rules = {result.rule: result for result in found.leaks.rules}
    assert rules["layer_height"].verdict == "fail", "its layers are 0.2 mm high"
    assert rules["printed_material"].verdict == "warn", "its solid is another one"
    for name, result in rules.items():
        assert (result.severity, result.source) == (RULES[name].severity, RULES[name].source)
