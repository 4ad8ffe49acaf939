"""What this version makes of the design in a manifest, and how it differs from the export."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError, DesignError
from bellows_design.export.manifest import fingerprint
from bellows_design.export.part import Part
from bellows_design.export.read_back import READERS, NotThePart
from bellows_design.files.guarded import read_file
from bellows_design.validation.quoting import shown
from bellows_design.verification.folder import LARGEST_FILE
from bellows_design.verification.record import Rebuilt


def design_of(manifest: Mapping[str, Any]) -> Design:
    """The design that the manifest states, of nothing but what stands there.

    Raises ``DesignError`` if it is none; also if its material or printer is a file, as those of an
    export are tables or names.
    """
    table = manifest.get("design")
    if not isinstance(table, dict):
        raise DesignError("the manifest states no design.")
    for key in ("material", "printer"):
        given = table.get(key)
        if isinstance(given, str) and given.lower().endswith(".toml"):
            raise DesignError(f"the design's {key} is a file, which an export does not need.")
    design = Design.of(table)
    if design.digest != manifest.get("digest"):
        raise DesignError("its digest is another than the manifest's.")
    return design


def compared(
    folder: Path, manifest: Mapping[str, Any], part: Part, expected: Mapping[str, bytes]
) -> tuple[Rebuilt, ...]:
    """Every file that this version writes, beside that which the manifest lists."""
    listed = manifest["files"]
    return tuple(
        _compared(folder / name, listed.get(name), part, content)
        for name, content in expected.items()
    )


def unwritten(manifest: Mapping[str, Any], expected: Mapping[str, bytes]) -> tuple[Rebuilt, ...]:
    """Files that the manifest lists and this version does not write."""
    return tuple(
        Rebuilt(shown(name, 100), False) for name in manifest["files"] if name not in expected
    )


def _compared(path: Path, listed: object, part: Part, content: bytes) -> Rebuilt:
    same = listed == fingerprint(content)
    reread = not same and path.suffix in READERS and path.is_file() and not path.is_symlink()
    return Rebuilt(path.name, same, _difference(path, part) if reread else "")


def _difference(path: Path, part: Part) -> str:
    """In what the file is not the part; empty if it is.

    It is read within time and memory first, as parts of other programs are.
    """
    from printers.errors import PrintersError
    from printers.reading.read import read_part

    try:
        read_part(path)
        READERS[path.suffix](part, read_file(path, "part", LARGEST_FILE))
    except (PrintersError, BellowsError, NotThePart) as error:
        return str(error).rstrip(".")
    return ""
