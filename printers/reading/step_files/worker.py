"""The process that reads a STEP file: its arguments are a folder, a number of bytes, what to leave.

It reads `PART` in the folder and leaves `MESH` or `SHAPE`, as the last argument says, or one
sentence in `SENTENCE`. Whatever else becomes of it is its caller's to notice.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from printers.reading.limits import STEP_SECONDS

if TYPE_CHECKING:
    from printers.reading.step_files.cad_shape import CadShape

PART, MESH, SHAPE, SENTENCE = "part.step", "mesh.npz", "shape.brep", "sentence.txt"


def main(folder: Path, memory: int, wanted: str) -> None:
    """Read the part in `folder` with at most `memory` bytes of address space; leave `wanted`."""
    from printers.errors import PrintersError

    _limit(memory)
    try:
        _read(folder, wanted)
    except PrintersError as error:
        sentence = str(error)
    except MemoryError:
        sentence = f"it takes more than {memory / 2**30:.1f} GiB of memory to read"
    except Exception as error:  # the kernel's have many classes
        sentence = f"the CAD kernel could not read it: {type(error).__name__}: {error}"
    else:
        return
    (folder / SENTENCE).write_text(" ".join(sentence.split()), "utf-8")


def _read(folder: Path, wanted: str) -> None:
    from printers.reading.step_files.cad_shape import shape_in

    found = shape_in(folder / PART)
    if wanted == SHAPE:
        from OCP.BRepTools import BRepTools

        BRepTools.Write_s(found.shape, str(folder / SHAPE))
    else:
        _leave_mesh(folder, found)


def _leave_mesh(folder: Path, found: CadShape) -> None:
    import numpy as np

    from printers.reading.step_files.cad_mesh import mesh_of

    vertices, triangles, notes = mesh_of(found.shape)
    texts = np.array([found.units, *found.notes, *notes])
    np.savez(folder / MESH, vertices=vertices, triangles=triangles, texts=texts)


def _limit(memory: int) -> None:
    """No more address space than `memory` bytes; not every system can limit it.

    Nor more time of the processor than its caller waits, should that be killed meanwhile.
    """
    try:
        import resource
    except ImportError:
        return
    for kind, most in (
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_CPU, int(STEP_SECONDS) + 1),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(kind)[1]
        allowed = most if hard == resource.RLIM_INFINITY else min(most, hard)
        with suppress(ValueError, OSError):  # macOS limits no address space
            resource.setrlimit(kind, (allowed, hard))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
