"""The folder of an approved design.

``exports/NAME/`` holds ``NAME.stl``, ``NAME.3mf``, ``NAME.step``, what ships with the part,
``manifest.json``, ``run.json`` and, if one was made, the report. The folder is written under a
hidden name beside its place, read back and compared, and renamed when it is complete: a reader
finds all of it or nothing. Runs that export to one folder take turns: each finishes, or withdraws,
a whole export before the next begins.

A name has one current verdict. An export replaces the earlier one of its name, and a refusal
withdraws it, so that an outdated approval is never taken for the current one. Nothing is lost: the
design in a manifest rebuilds its files. Only files that a manifest of ours lists are ever removed,
never a file or folder that someone else put there.
"""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from bellows_design.errors import BellowsError, DesignError
from bellows_design.export.contents import contents
from bellows_design.export.manifest import (
    MANIFEST,
    RUN,
    fingerprint,
    is_plain,
    listed_files,
    report_name,
    run_of,
)
from bellows_design.export.part import Part
from bellows_design.export.read_back import require_same
from bellows_design.files.atomic import (
    at_work,
    open_to_readers,
    remove_leftovers,
    require_writable,
    temporary_beside,
)
from bellows_design.files.errors import CannotWrite
from bellows_design.files.locks import locked
from bellows_design.validation.quoting import quoted

if TYPE_CHECKING:
    from bellows_design.approval import Verdict

NOTHING: Mapping[str, Any] = MappingProxyType({})

Report = Callable[[Mapping[str, bytes]], bytes | None]
"""Makes the report that stands beside these files, name -> content; None if it cannot."""

PATIENCE = 60.0
"""s, for which a run waits for others that export to the same folder; each takes some two."""


def export_approved(
    part: Part,
    verdict: Verdict,
    grounds: Mapping[str, Any],
    output_root: Path,
    companions: Mapping[str, bytes] = NOTHING,
    run: Mapping[str, Any] = NOTHING,
    report: Report | None = None,
) -> Path:
    """Write the approved ``part`` into ``output_root/NAME`` and return that folder.

    ``grounds`` goes into the manifest (design, check, evaluation, versions), ``companions`` are
    further files by their names, ``run`` (times, machine) goes into ``run.json``, and ``report``
    makes the page beside all of them.

    Raises:
        BellowsError: The verdict is no approval.
        DesignError: The folder holds files that are not ours.
        CannotWrite: It cannot be written, an ``OSError``; then nothing has changed.
    """
    if not verdict.approved:
        raise BellowsError(f"{part.name} is not approved and cannot be exported")
    target = output_root / part.name
    try:
        require_place(part.name, output_root)
        files = contents(part, verdict, grounds, companions)
        page = _page(part.name, files, report)
        with _folder(output_root), locked(output_root, PATIENCE):
            require_place(part.name, output_root)
            _replace(target, part, files | page | {RUN: _run_file(files, page, run)})
    except OSError as error:
        reason = error.strerror or str(error)
        raise CannotWrite(target, f"{reason}; it is approved, but not exported") from error
    return target


def require_place(name: str, output_root: Path) -> None:
    """Refuse ``output_root/name`` if it may not, or cannot, be written or replaced.

    Asked before the long computation that an export follows. Raises ``DesignError`` if something
    of others stands there, and ``CannotWrite`` if nothing can be written there.
    """
    _require_plain(name)
    if output_root.exists() and not output_root.is_dir():
        raise DesignError(f"{quoted(str(output_root))} is a file, not a folder for exports.")
    _require_ours(output_root / name)
    require_writable(_nearest_folder(output_root) / name)


def withdraw(name: str, output_root: Path) -> Path | None:
    """Remove the earlier export called ``name``, if there is one; return its folder.

    Removes the manifest first and then the files it lists, so that a half-done withdrawal is
    never mistaken for an export; files of others stay where they are.
    """
    _require_plain(name)
    folder = output_root / name
    if not output_root.is_dir():
        return None
    with locked(output_root, PATIENCE):
        remove_leftovers(output_root)
        listed = listed_files(folder)
        if listed is None:
            return None
        for name_of_file in (MANIFEST, *listed):
            if (folder / name_of_file).is_file():
                (folder / name_of_file).unlink()
        with suppress(OSError):  # other people's files keep the folder
            folder.rmdir()
    return folder


@contextmanager
def _folder(place: Path) -> Iterator[None]:
    """Within the block there is a folder ``place``; what is made of it goes if the block fails."""
    missing = [each for each in (place, *place.parents) if not each.exists()]
    try:
        place.mkdir(parents=True, exist_ok=True)
        yield
    except BaseException:
        for each in missing:
            with suppress(OSError):
                each.rmdir()
        raise


def _page(name: str, files: Mapping[str, bytes], report: Report | None) -> dict[str, bytes]:
    """The report by the name of its file; nothing where there is none."""
    made = None if report is None else report(files)
    return {} if made is None else {report_name(name): made}


def _run_file(
    files: Mapping[str, bytes], page: Mapping[str, bytes], run: Mapping[str, Any]
) -> bytes:
    """What differs between two runs, with manifest and report that it belongs to."""
    stated = {name: fingerprint(content) for name, content in page.items()}
    return run_of({"manifest": fingerprint(files[MANIFEST])["sha256"], "report": stated, **run})


def _replace(target: Path, part: Part, files: Mapping[str, bytes]) -> None:
    """Make the export under a hidden name, look at what came of it, and put it in place."""
    remove_leftovers(target.parent)
    with at_work(target) as fresh:
        fresh.mkdir(mode=0o700)
        with locked(fresh):
            _fill(fresh, files)
            _require_written(fresh, part, files)
            _swap(fresh, target)


def _fill(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write all files."""
    open_to_readers(folder)
    for name, content in files.items():
        with (folder / name).open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())


def _require_written(folder: Path, part: Part, files: Mapping[str, bytes]) -> None:
    """Raise ``CannotWrite`` unless ``folder`` holds just these ``files``, and they the part."""
    present = {file.name for file in folder.iterdir()}
    if present != set(files):
        changed = ", ".join(sorted(present ^ set(files)))
        raise OSError(errno.EIO, f"another program added or removed {changed}")
    for name, content in files.items():
        require_same(part, folder / name, content)


def _nearest_folder(place: Path) -> Path:
    """``place``, or the folder above it that is there and in which it would be made."""
    while not place.exists() and place != place.parent:
        place = place.parent
    return place


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
    listed = listed_files(folder)
    present = {file.name for file in folder.iterdir()} if folder.is_dir() else set()
    others = sorted(present - {MANIFEST, *(listed or ())})
    if listed is None or others:
        found = f" (it holds {', '.join(quoted(name) for name in others[:3])})" if others else ""
        raise DesignError(
            f"{quoted(str(folder))} is not an export of ours alone{found}; move it away or choose "
            "another --output."
        )


def _require_plain(name: str) -> None:
    """Refuse names that lead out; those of designs never do, unless made without their checks."""
    if not is_plain(name):
        raise DesignError(f"{quoted(name)} is no name of a folder in the output folder.")
