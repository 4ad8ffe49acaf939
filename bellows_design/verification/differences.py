"""In what an export was made otherwise than it would be here: programs, processor, numbers."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.export.manifest import LARGEST, RUN, parsed
from bellows_design.files.guarded import read_file
from bellows_design.files.json_files import json_text
from bellows_design.validation.quoting import shown
from bellows_design.verification.record import Difference, Verification

MOST = 50
"""Differences that are named; where all numbers differ, more would say no more."""

LARGEST_INTEGER = 2**63
"""From here on a number is shown as text, as far as it has one."""

UNCOMPARED = {"files", "sha256"}
"""Keys of the manifest that follow from the others."""


def then(found: Verification, manifest: Mapping[str, Any]) -> dict[str, Any]:
    """Versions, slicer and processor of the export, as far as it states them."""
    stated = dict(_table(manifest.get("evaluation"), "versions"))
    if not found.quick:
        stated["slicer"] = _table(manifest, "leak_test").get("slicer")
    processor = _processor(found)
    return stated if processor is None else stated | {"processor": processor}


def now(found: Verification, slicer: str | None) -> dict[str, Any]:
    """The same of this version on this machine."""
    from bellows_design.machine import processor
    from bellows_design.versions import versions

    stated: dict[str, Any] = versions()
    if not found.quick:
        stated["slicer"] = slicer
    return stated if _processor(found) is None else stated | {"processor": processor()}


def version_differences(then: Mapping[str, Any], now: Mapping[str, Any]) -> tuple[Difference, ...]:
    """Programs, and the processor, that are others than those of the export."""
    found: list[Difference] = []
    _collect("", dict(then), dict(now), found)
    return tuple(found[:MOST])


def field_differences(
    manifest: Mapping[str, Any], statement: Mapping[str, Any]
) -> tuple[Difference, ...]:
    """Fields that differ between a manifest and what this version states, all of them.

    The statement is taken as it would be read from its file.
    """
    found: list[Difference] = []
    _collect("", _compared(manifest), _compared(json.loads(json_text(statement))), found)
    return tuple(found)


def quick_part(manifest: Mapping[str, Any]) -> dict[str, Any]:
    """What the manifest states that needs no evaluation, and whether it claims approval."""
    keys = ("design", "printer", "mesh_tolerance_mm", "check")
    approved = _table(manifest, "verdict").get("approved")
    return {key: manifest.get(key) for key in keys} | {"verdict.approved": approved}


def _compared(manifest: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in manifest.items() if key not in UNCOMPARED}


def _processor(found: Verification) -> str | None:
    """The processor that ``run.json`` names, if it is as it was written."""
    if not any(file.name == RUN and file.state == "as written" for file in found.files):
        return None
    try:
        run = parsed(read_file(found.folder / RUN, "run", LARGEST), found.folder / RUN)
    except DesignError:
        return None
    return shown(str(_table(run, "machine").get("processor")), 200)


def _table(content: Any, key: str) -> dict[str, Any]:
    """The table ``key`` of a table; an empty one for anything else."""
    inner = content.get(key) if isinstance(content, dict) else None
    return inner if isinstance(inner, dict) else {}


def _collect(name: str, then: Any, now: Any, found: list[Difference]) -> None:
    """Add what differs, table by table and entry by entry."""
    if isinstance(then, dict) and isinstance(now, dict):
        for key in dict.fromkeys((*then, *now)):
            _collect(f"{name}.{key}".lstrip("."), then.get(key), now.get(key), found)
    elif isinstance(then, list) and isinstance(now, list) and len(then) == len(now):
        for number, pair in enumerate(zip(then, now, strict=True)):
            _collect(f"{name}[{number}]", *pair, found)
    elif then != now:
        found.append(Difference(shown(name, 200), _short(then), _short(now)))


def _short(value: Any) -> Any:
    """A value that fits on a line, in printable characters."""
    if value is None or isinstance(value, bool | float):
        return value
    return value if isinstance(value, int) and abs(value) < LARGEST_INTEGER else _text(value)


def _text(value: Any) -> str:
    """Text of a value; a number of thousands of digits has none."""
    try:
        return shown(str(value), 200)
    except (ValueError, RecursionError):
        return "too much to show"
