"""The whole deformed actuator as a file for ParaView and the like."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from bellows_design.deformed.actuator import DeformedActuator, deformed_actuator
from bellows_design.deformed.solved import Found
from bellows_design.errors import DesignError
from bellows_design.exchange.formats import ACTUATOR_SUFFIXES
from bellows_design.files.atomic import replacing
from bellows_design.geometry.face_names import CAVITY
from bellows_design.validation.quoting import quoted
from solver.arrays import Reals


def write_actuator(found: DeformedActuator | Found, path: Path | str) -> None:
    """Write a deformed actuator, completely or not at all.

    The file holds the undeformed body, both halves, with the fields ``displacement_mm``,
    ``von_mises_mpa`` and ``pressure_mpa`` (on the cavity's nodes, zero elsewhere) at the nodes.

    Args:
        found: An evaluation, or what ``deformed_actuator`` has made of it.
        path: ``.vtu`` or ``.xdmf``, one file either way.

    Raises:
        DesignError: another ending.
        CannotWrite: the file cannot be written.
    """
    from solver.exchange.abaqus.cells import reordered
    from solver.exchange.xdmf import write_xdmf

    target = Path(path)
    if target.suffix.lower() not in ACTUATOR_SUFFIXES:
        raise DesignError(f"{quoted(str(target))} must end in {' or '.join(ACTUATOR_SUFFIXES)}.")
    deformed = found if isinstance(found, DeformedActuator) else deformed_actuator(found)
    cells = [("tetra10", reordered(deformed.mesh.tets))]
    with replacing(target) as temporary:
        if target.suffix.lower() == ".xdmf":
            write_xdmf(temporary, deformed.mesh.nodes, cells, _fields(deformed), {})
        else:
            import meshio

            meshio.vtu.write(temporary, meshio.Mesh(deformed.mesh.nodes, cells, _fields(deformed)))


def _fields(deformed: DeformedActuator) -> dict[str, Reals]:
    pressure = np.zeros(len(deformed.mesh.nodes))
    pressure[deformed.mesh.surface_nodes(CAVITY)] = deformed.pressure_mpa
    return {
        "displacement_mm": deformed.displacement,
        "von_mises_mpa": deformed.von_mises,
        "pressure_mpa": pressure,
    }
