"""What an export's folder says about itself: which files it holds, and where their hashes stand.

``manifest.json`` states the design, the verdict's grounds and the hash of every other file but two:
``run.json``, which holds what differs between two runs of one design, times and the machine, and
the report, which shows such times. Manifest and ``run.json`` are sealed by themselves
(``seal.py``); the hash of the report stands in ``run.json``.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bellows_design.errors import DesignError
from bellows_design.export.seal import sealed
from bellows_design.files.guarded import read_file
from bellows_design.validation.quoting import quoted_path

MANIFEST, RUN = "manifest.json", "run.json"

MANIFEST_FORMAT = "bellows-design manifest 2"
FIRST_FORMAT = "bellows-design manifest 1"
"""Without a seal, and with the times in the manifest; its files are still ours."""

RUN_FORMAT = "bellows-design run 1"

REPORT_ENDING = "_report.html"
"""Of the report's name. The report shows seconds and what the leak test measured, which differ from
run to run: with its hash in the manifest two exports of one design would never be the same."""

LARGEST = 10_000_000
"""Bytes; a manifest has some 20 000."""


class NoObject(DesignError):
    """A file is JSON, and no object."""


def manifest_of(statement: Mapping[str, Any], files: Mapping[str, bytes]) -> bytes:
    """The manifest: a ``statement`` and the fingerprints of all ``files`` it answers for."""
    fingerprints = {name: fingerprint(files[name]) for name in sorted(files)}
    return sealed({"format": MANIFEST_FORMAT, **statement, "files": fingerprints})


def run_of(statement: Mapping[str, Any]) -> bytes:
    """The file of times and machine."""
    return sealed({"format": RUN_FORMAT, **statement})


def fingerprint(content: bytes) -> dict[str, Any]:
    """SHA-256 and length."""
    return {"sha256": hashlib.sha256(content).hexdigest(), "bytes": len(content)}


def report_name(name: str) -> str:
    """The file of the report on a design called ``name``."""
    return f"{name}{REPORT_ENDING}"


def listed_files(folder: Path) -> tuple[str, ...] | None:
    """Plain names of the files that the manifest of ours in ``folder`` answers for, but its own.

    None without such a manifest.
    """
    if folder.is_symlink() or (folder / MANIFEST).is_symlink():
        return None
    try:
        manifest = read_manifest(folder / MANIFEST)
    except DesignError:
        return None
    files = manifest["files"]
    own = _beside(folder, manifest) if manifest["format"] == MANIFEST_FORMAT else ()
    others = (*own, RUN, MANIFEST)
    return (*own, *(name for name in files if is_plain(name) and name not in others))


def _beside(folder: Path, manifest: Mapping[str, Any]) -> tuple[str, ...]:
    """Our files that no manifest lists: ``run.json``, and the report if it is there."""
    report = report_name(str(manifest.get("name")))
    there = is_plain(report) and (folder / report).is_file()
    return (RUN, report) if there and not (folder / report).is_symlink() else (RUN,)


def read_manifest(path: Path) -> dict[str, Any]:
    """The manifest of ours at ``path``: a table with the table ``files``.

    Raises ``DesignError`` for anything else. Whether its seal holds is not asked.
    """
    return parsed_manifest(read_file(path, "manifest", LARGEST), path)


def parsed_manifest(content: bytes, path: Path) -> dict[str, Any]:
    """The manifest of ours that ``content`` is; ``path`` is named in messages.

    Raises ``DesignError`` for anything else.
    """
    manifest = parsed(content, path)
    if manifest.get("format") not in (MANIFEST_FORMAT, FIRST_FORMAT):
        raise DesignError(f"{quoted_path(path)} is no manifest of bellows-design.")
    if not isinstance(manifest.get("files"), dict):
        raise DesignError(f"the manifest {quoted_path(path)} lists no files.")
    return manifest


def parsed(content: bytes, path: Path) -> dict[str, Any]:
    """The JSON object that ``content`` is. Raises ``DesignError`` if it is none."""
    try:
        found = json.loads(content.decode("utf-8"), parse_constant=_refused)
    except (ValueError, RecursionError) as error:
        why = "it is nested too deeply" if isinstance(error, RecursionError) else str(error)[:200]
        raise DesignError(f"{quoted_path(path)} is not readable as JSON: {why}.") from None
    if not isinstance(found, dict):
        raise NoObject(f"{quoted_path(path)} holds no JSON object.")
    return found


def _refused(constant: str) -> float:
    raise ValueError(f"{constant} is no number of JSON")


def is_plain(name: str) -> bool:
    """True if ``name`` names an entry of a folder itself, neither above it nor further down."""
    return name == Path(name).name and name not in ("", "..", ".") and "\0" not in name
