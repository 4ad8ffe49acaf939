"""Reading a part: the suffix says the format, and the content must agree with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from printers.errors import PrintersError, quoted
from printers.reading.content import content_of
from printers.reading.part import ReadPart


def read_part(path: Path | str) -> ReadPart:
    """The surface of the part in a file, mm.

    Args:
        path: A file in STL, binary or text, 3MF or STEP.

    Returns:
        Its triangles, what its numbers were taken to mean, and notes.

    Raises:
        PrintersError: The file is no such part, or too large; one sentence that names it.
        OSError: It cannot be read.
    """
    path = Path(path)
    try:
        reader = _reader_for(path)
        content = content_of(path)
        _require_format(path, content)
        return reader(content)
    except PrintersError as error:
        raise PrintersError(f"{quoted(str(path))} cannot be taken as a part: {error}.") from None


def _reader_for(path: Path) -> Callable[[bytes], ReadPart]:
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise PrintersError(f"its name must end in {', '.join(READERS)}")
    return reader


def _require_format(path: Path, content: bytes) -> None:
    """What a content shows at its start decides more surely than what is named."""
    start = content[:64].removeprefix(b"\xef\xbb\xbf").lstrip()
    found = next((suffix for sign, suffix in _SIGNS.items() if start.startswith(sign)), None)
    wanted = path.suffix.lower().replace(".stp", ".step")
    if found is not None and found != wanted:
        raise PrintersError(f"its content is that of a {found} file")
    if found is None and wanted != ".stl":
        raise PrintersError(f"its content does not begin as that of a {wanted} file does")


def _stl(content: bytes) -> ReadPart:
    from printers.reading.stl import read_stl

    return read_stl(content)


def _3mf(content: bytes) -> ReadPart:
    from printers.reading.threemf.reader import read_3mf

    return read_3mf(content)


def _step(content: bytes) -> ReadPart:
    from printers.reading.step_files.reader import read_step

    return read_step(content)


READERS: Mapping[str, Callable[[bytes], ReadPart]] = MappingProxyType(
    {".stl": _stl, ".3mf": _3mf, ".step": _step, ".stp": _step}
)
"""Suffix -> reader of a content."""

_SIGNS = {b"PK\x03\x04": ".3mf", b"ISO-10303-21": ".step"}
