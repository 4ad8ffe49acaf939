"""File formats of a part: one writer, and one reader that checks it, for each suffix.

Lengths are millimetres in all of them. STL and 3MF hold the checked triangle mesh itself, STEP
the exact solid. All are made in memory: libraries that write files themselves know not every name
that a file may have, and abort on a full disk. The same part gives the same bytes. A new format is
two functions, of which the second stands in ``read_back``, and one line in ``WRITERS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from bellows_design.errors import DesignError
from bellows_design.export.part import Part as Part
from bellows_design.export.read_back import require_same
from bellows_design.export.step_file import step_file
from bellows_design.export.three_mf import three_mf
from bellows_design.files.atomic import replacing
from bellows_design.validation.quoting import near, quoted

Writer = Callable[[Part], bytes]
"""Makes the content of a file."""


def write_part(part: Part, path: Path | str, writer: Writer | None = None) -> None:
    """Write ``part`` in the format of ``path``'s suffix, completely or not at all.

    What was written is read back and compared.

    Args:
        part: What ``build_part`` made, mm.
        path: Of the file; ``.stl`` and ``.3mf`` hold the mesh, ``.step`` the exact solid.
        writer: Makes the content instead of the format's usual one.

    Raises:
        DesignError: An unknown suffix.
        CannotWrite: An ``OSError``: the file cannot be written, or does not hold the part.

    Examples:
        >>> from bellows_design import build_part, load_design, write_part
        >>> part = build_part(load_design("prototype_1"))
        >>> for name in ("part.stl", "part.3mf"):
        ...     write_part(part, name)
    """
    path = Path(path)
    content = (writer or writer_for(path))(part)
    with replacing(path) as temporary:
        temporary.write_bytes(content)
        require_same(part, temporary, content)


def writer_for(path: Path) -> Writer:
    """The writer for ``path``'s suffix. Raises ``DesignError`` if there is none."""
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise DesignError(
            f"{quoted(str(path))} must end in {', '.join(WRITERS)}: the suffix chooses the format"
            f"{near(path.suffix.lower(), WRITERS) or '.'}"
        )
    return writer


def _stl(part: Part) -> bytes:
    """Binary STL; its 80-byte header names the design."""
    import trimesh
    from trimesh.exchange.stl import export_stl

    mesh = trimesh.Trimesh(part.mesh.vertices, part.mesh.triangles, process=False)
    header = f"bellows-design {part.name} {part.digest[:16]} mm".encode("ascii")[:80].ljust(80)
    return header + export_stl(mesh)[80:]


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {".stl": _stl, ".3mf": three_mf, ".step": step_file}
)
"""Suffix -> writer."""
