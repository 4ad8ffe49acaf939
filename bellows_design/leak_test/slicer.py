"""The leak test with the slicer of this machine."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

from bellows_design.design.conditions import LeakTestSetting
from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.leak_test.record import SWITCHED_OFF, LeakOutcome, LeakTester, Unavailable
from bellows_design.printability import printed_model

if TYPE_CHECKING:
    from printers.slicing.finding import Slicer


def usual_tester(setting: LeakTestSetting) -> LeakTester | Unavailable:
    """The leak test with the slicer of this machine, or why there is none.

    Nothing is looked for where the ``setting`` switches the test off.

    Raises ``PrintersError`` if the test is required and the slicer that is found cannot be used: it
    is too old, another program, or none.
    """
    from printers.errors import PrintersError
    from printers.slicing.finding import VARIABLE, find_slicer

    if setting == "off":
        return Unavailable(SWITCHED_OFF)
    try:
        slicer = find_slicer()
    except PrintersError as error:
        if setting == "required":
            raise
        return Unavailable(str(error).rstrip("."))
    if slicer is None:
        return Unavailable(f"there is no PrusaSlicer here (see {VARIABLE})")
    return partial(tested, slicer)


def tested(slicer: Slicer, design: Design, mesh: ClosedMesh) -> LeakOutcome:
    """What ``slicer`` makes of the printed part of ``design``, tested for leaks.

    Raises ``PrintersError`` if it cannot be sliced or tested.
    """
    from bellows_design.leak_test.layers import print_layers
    from printers.orientation.turning import AS_IN_FILE
    from printers.sliced_check import check_sliced

    started = time.perf_counter()
    found = check_sliced(printed_model(design, mesh), design.profile(), AS_IN_FILE, slicer)
    return LeakOutcome(
        slicer=found.sliced.slicer,
        version=found.sliced.version,
        profile_sha256=found.sliced.profile_digest,
        rules=found.leaks.rules,
        figures=found.leaks.figures() | {"notes": list(found.notes)},
        seconds=time.perf_counter() - started,
        layers=print_layers(found.sliced, found.leaks),
    )
