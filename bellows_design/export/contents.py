"""What the files of an approved design hold, from the part and what its approval rests on.

A pure function: the same part and grounds give the same bytes, which are written by ``approved``
and expected by ``bellows verify``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from bellows_design.export.formats import WRITERS
from bellows_design.export.manifest import MANIFEST, manifest_of
from bellows_design.export.part import Part

if TYPE_CHECKING:
    from bellows_design.approval import Verdict


def contents(
    part: Part,
    verdict: Verdict,
    grounds: Mapping[str, Any],
    companions: Mapping[str, bytes],
) -> dict[str, bytes]:
    """Name -> content of all files that do not differ between two runs: all but ``run.json``.

    ``companions`` are the files that go with the part; ``grounds`` stand in the manifest.
    """
    files = part_files(part) | dict(companions)
    statement = {
        "name": part.name,
        "digest": part.digest,
        "verdict": verdict.to_dict(),
        **grounds,
    }
    return files | {MANIFEST: manifest_of(statement, files)}


def file_names(part: Part) -> frozenset[str]:
    """Names of all files that the manifest of an export of ``part`` lists."""
    from bellows_design.export.companions import LEAK_TEST, settings_files
    from bellows_design.print_sheet.names import sheet_names

    of_part = {f"{part.name}{suffix}" for suffix in WRITERS}
    return frozenset({*of_part, *settings_files(part), LEAK_TEST, *sheet_names(part.name)})


def part_files(part: Part) -> dict[str, bytes]:
    """The part in every format."""
    return {f"{part.name}{suffix}": write(part) for suffix, write in WRITERS.items()}
