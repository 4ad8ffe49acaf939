"""What this version makes of the design in a manifest, and how it differs from the export."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from bellows_design.design.design import Design
from bellows_design.errors import BellowsError, DesignError
from bellows_design.export.contents import file_names
from bellows_design.export.manifest import LARGEST, MANIFEST, fingerprint
from bellows_design.export.part import Part
from bellows_design.export.read_back import READERS, NotThePart
from bellows_design.files.guarded import read_file
from bellows_design.validation.quoting import shown
from bellows_design.verification.agreement import Others, differing, text_judgement
from bellows_design.verification.folder import LARGEST_FILE
from bellows_design.verification.record import Difference, Rebuilt

PROSE = ("description", "source", "sources")
"""Keys of a design that hold sentences, and are never looked up."""


def design_of(manifest: Mapping[str, Any]) -> Design:
    """The design that the manifest states, of nothing but what stands there.

    Raises ``DesignError`` if it is none, or not that of the manifest's name and digest; also if
    anything in it is a file, as those of an export are tables or names.
    """
    table = manifest.get("design")
    if not isinstance(table, dict):
        raise DesignError("the manifest states no design.")
    for key in _files_named("", table):
        raise DesignError(f"the design's {key} is a file, which an export does not need.")
    design = Design.of(table)
    if design.digest != manifest.get("digest"):
        raise DesignError("its digest is another than the manifest's.")
    if design.name != manifest.get("name"):
        raise DesignError("its name is another than the manifest's.")
    return design


def _files_named(name: str, value: Any) -> Iterator[str]:
    """Keys of what would be opened as a file, at any depth."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in PROSE:
                yield from _files_named(shown(f"{name}.{key}".lstrip("."), 100), inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _files_named(name, inner)
    elif isinstance(value, str) and value.strip().lower().endswith(".toml"):
        yield name


def compared(
    folder: Path,
    manifest: Mapping[str, Any],
    part: Part,
    expected: Mapping[str, bytes],
    others: Others,
) -> tuple[Rebuilt, ...]:
    """Every file that this version makes, beside that which the manifest lists."""
    listed = manifest["files"]
    return tuple(
        _compared(folder / name, listed[name], part, content, others)
        for name, content in expected.items()
        if name in listed
    )


def unexpected(manifest: Mapping[str, Any], part: Part) -> tuple[Rebuilt, ...]:
    """Files that an export has and this one does not list, and the other way round."""
    names, listed = file_names(part), set(manifest["files"])
    lacking = (Rebuilt(name, False, "it is not listed") for name in sorted(names - listed))
    extra = sorted(name for name in listed - names)
    foreign = "an export of this design holds no such file"
    return (*lacking, *(Rebuilt(shown(name, 100), False, foreign) for name in extra))


def compared_manifest(same_bytes: bool, fields: tuple[Difference, ...], others: Others) -> Rebuilt:
    """The manifest, with the ``fields`` in which it differs from that which this version writes."""
    if same_bytes:
        return Rebuilt(MANIFEST, True)
    if not others.any:
        return Rebuilt(MANIFEST, False, _told(fields) or "the same versions do not write it so")
    found = differing(fields, others)
    return Rebuilt(MANIFEST, False, _told(found["is another"]), _names(found["not compared"]))


def _told(fields: Sequence[Difference]) -> str:
    """The first of the fields, and how many more there are."""
    if not fields:
        return ""
    first, more = fields[0], f", and {len(fields) - 1} more" if fields[1:] else ""
    return f"{first.name} is {first.then} instead of {first.now}{more}"


def _names(fields: Sequence[Difference]) -> str:
    first = ", ".join(each.name for each in fields[:3])
    return f"{first}, and {len(fields) - 3} more" if fields[3:] else first


def _compared(path: Path, listed: object, part: Part, content: bytes, others: Others) -> Rebuilt:
    if listed == fingerprint(content):
        return Rebuilt(path.name, True)
    if not path.is_file() or path.is_symlink():
        return Rebuilt(path.name, False)  # named already among the files of the folder
    if path.suffix in READERS:
        difference = _difference(path, part)
        if not difference and not others.any:
            difference = "the same versions do not write it so"
        return Rebuilt(path.name, False, difference)
    try:
        written = read_file(path, "text", LARGEST)
    except DesignError as error:
        return Rebuilt(path.name, False, str(error).rstrip("."))
    if not others.any:
        return Rebuilt(path.name, False, "the same versions do not write it so")
    judgement, why = text_judgement(path.name, written, content, others)
    known = judgement == "is another"
    return Rebuilt(path.name, False, why if known else "", "" if known else why)


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
        return f"not the part, {str(error).rstrip('.')}"
    return ""
