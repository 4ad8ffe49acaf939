"""The leak test with the slicer of this machine: the one place where both are put together."""

from __future__ import annotations

import time
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bellows_design.design.design import Design
from bellows_design.geometry.tessellation import ClosedMesh
from bellows_design.leak_test.record import LeakOutcome, LeakTester, Unavailable
from bellows_design.printability import port_opening, turned_to_fit
from printers.model import Opening

if TYPE_CHECKING:
    from printers.slicing.finding import Slicer
    from printers.slicing.placing import Placement


def usual_tester() -> LeakTester | Unavailable:
    """The leak test with the slicer of this machine, or why there is none.

    Raises ``PrintersError`` if the environment names a slicer that is none.
    """
    from printers.slicing.finding import VARIABLE, find_slicer

    slicer = find_slicer()
    if slicer is None:
        return Unavailable(f"there is no PrusaSlicer here (see {VARIABLE})")
    return partial(tested, slicer)


def tested(slicer: Slicer, design: Design, mesh: ClosedMesh) -> LeakOutcome:
    """What ``slicer`` makes of the printed part of ``design``, tested for leaks.

    Raises ``PrintersError`` if it cannot be sliced or tested.
    """
    from printers.leak_test.run import leak_test
    from printers.slicing.making import slice_mesh

    started, profile = time.perf_counter(), design.profile()
    rotation = 90.0 if turned_to_fit(mesh, profile) else 0.0
    sliced = slice_mesh(mesh.vertices, mesh.triangles, profile, slicer, rotation)
    found = leak_test(
        sliced.gcode.beads,
        [_placed(port_opening(design), sliced.placement)],
        profile,
        solid_volume=mesh.volume,
        transform=sliced.placement.to_part,
    )
    return LeakOutcome(
        slicer=sliced.slicer,
        version=sliced.version,
        profile_sha256=sliced.profile_digest,
        rules=found.rules,
        figures=found.to_dict() | {"slicer_warnings": list(sliced.warnings)},
        seconds=time.perf_counter() - started,
    )


def _placed(opening: Opening, placement: Placement) -> Opening:
    """The opening where it lies on the bed."""
    centre = np.array(opening.centre)
    points = placement.to_gcode(np.array([centre, centre + opening.direction]))
    there, direction = points[0].tolist(), (points[1] - points[0]).tolist()
    return replace(opening, centre=tuple(there), direction=tuple(direction))
