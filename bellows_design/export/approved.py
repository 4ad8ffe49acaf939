"""The folder of an approved design.

``exports/NAME/`` holds ``NAME.stl``, ``NAME.3mf``, ``NAME.step`` and ``manifest.json``. The folder
is written under a hidden name beside its place and renamed when it is complete: a reader finds all
of it or nothing. The manifest states the design, the verdict's grounds and the hash of every file.

A name has one current verdict. An export replaces the earlier one of its name, and a refusal
withdraws it, so that an outdated approval is never taken for the current one. Nothing is lost: the
design in a manifest rebuilds its files. Only files that a manifest of ours lists are ever removed,
never a file or folder that someone else put there.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bellows_design.errors import BellowsError, DesignError
from bellows_design.export.formats import WRITERS, Part
from bellows_design.files.atomic import open_to_readers, remove_leftovers, temporary_beside
from bellows_design.files.json_files import write_json
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from bellows_design.approval import Verdict

MANIFEST = "manifest.json"
MANIFEST_FORMAT = "bellows-design manifest 1"


def export_approved(
    part: Part, verdict: Verdict, grounds: Mapping[str, Any], output_root: Path
) -> Path:
    """Write the approved ``part`` into ``output_root/NAME`` and return that folder.

    ``grounds`` goes into the manifest (design, check, evaluation, versions).

    Raises:
        BellowsError: The verdict is no approval.
        DesignError: The folder holds files that are not ours.
        OSError: It cannot be written; then nothing has changed.
    """
    if not verdict.approved:
        raise BellowsError(f"{part.name} is not approved and cannot be exported")
    require_place(part.name, output_root)
    target = output_root / part.name
    output_root.mkdir(parents=True, exist_ok=True)
    remove_leftovers(target)
    fresh = temporary_beside(target)
    try:
        fresh.mkdir(mode=0o700)
        _fill(fresh, part, verdict, grounds)
        _swap(fresh, target)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return target


def require_place(name: str, output_root: Path) -> None:
    """Raise ``DesignError`` if ``output_root/name`` may not be written or replaced.

    Asked before the long computation that an export follows.
    """
    _require_plain(name)
    if output_root.exists() and not output_root.is_dir():
        raise DesignError(f"{quoted(str(output_root))} is a file, not a folder for exports.")
    _require_ours(output_root / name)


def withdraw(name: str, output_root: Path) -> Path | None:
    """Remove the earlier export called ``name``, if there is one; return its folder.

    Removes the manifest first and then the files it lists, so that a half-done withdrawal is
    never mistaken for an export; files of others stay where they are.
    """
    _require_plain(name)
    folder = output_root / name
    remove_leftovers(folder)
    listed = _listed_files(folder)
    if listed is None:
        return None
    for name_of_file in (MANIFEST, *listed):
        if (folder / name_of_file).is_file():
            (folder / name_of_file).unlink()
    with suppress(OSError):  # other people's files keep the folder
        folder.rmdir()
    return folder


def _fill(folder: Path, part: Part, verdict: Verdict, grounds: Mapping[str, Any]) -> None:
    open_to_readers(folder)
    for suffix, write in WRITERS.items():
        write(part, folder / f"{part.name}{suffix}")
    manifest = {
        "format": MANIFEST_FORMAT,
        "name": part.name,
        "digest": part.digest,
        "verdict": verdict.to_dict(),
        **grounds,
        "files": {file.name: _fingerprint(file) for file in sorted(folder.iterdir())},
    }
    write_json(manifest, folder / MANIFEST)


def _fingerprint(file: Path) -> dict[str, Any]:
    content = file.read_bytes()
    return {"sha256": hashlib.sha256(content).hexdigest(), "bytes": len(content)}


def _swap(fresh: Path, target: Path) -> None:
    """Put ``fresh`` in ``target``'s place; on failure or interruption ``target`` is as before."""
    retired = temporary_beside(target)
    try:
        with suppress(FileNotFoundError):
            os.rename(target, retired)
        os.rename(fresh, target)
    finally:
        if retired.exists() and not target.exists():
            os.rename(retired, target)
        shutil.rmtree(retired, ignore_errors=True)


def _require_ours(folder: Path) -> None:
    """Refuse to replace anything but a folder that holds nothing but an export of ours."""
    if not folder.exists() and not folder.is_symlink():
        return
    listed = _listed_files(folder)
    present = {file.name for file in folder.iterdir()} if folder.is_dir() else set()
    others = sorted(present - {MANIFEST, *(listed or ())})
    if listed is None or others:
        found = f" (it holds {', '.join(quoted(name) for name in others[:3])})" if others else ""
        raise DesignError(
            f"{quoted(str(folder))} is not an export of ours alone{found}; move it away or choose "
            "another --output."
        )


def _listed_files(folder: Path) -> tuple[str, ...] | None:
    """Plain file names that the manifest of ours in ``folder`` lists; None without such a one."""
    if folder.is_symlink() or not (folder / MANIFEST).is_file():
        return None
    try:
        manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    if not isinstance(manifest, dict) or manifest.get("format") != MANIFEST_FORMAT:
        return None
    files = manifest.get("files")
    names = files if isinstance(files, dict) else {}
    return tuple(name for name in names if _is_plain(name))


def _is_plain(name: str) -> bool:
    """True if ``name`` names an entry of a folder itself, neither above it nor further down."""
    return name == Path(name).name and name not in ("", "..", ".") and "\0" not in name


def _require_plain(name: str) -> None:
    """Refuse names that lead out; those of designs never do, unless made without their checks."""
    if not _is_plain(name):
        raise DesignError(f"{quoted(name)} is no name of a folder in the output folder.")
