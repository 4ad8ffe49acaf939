"""Which slicer there is on this machine."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from printers.errors import PrintersError, quoted
from printers.slicing.prusa import OLDEST_PRUSASLICER
from printers.slicing.running import run
from printers.slicing.working_folder import working_folder

VARIABLE = "BELLOWS_SLICER"
"""Environment variable with the path of a slicer; empty for none."""

NAMES = ("prusa-slicer", "PrusaSlicer", "prusa-slicer-console.exe")
"""What PrusaSlicer is called on Linux, macOS and Windows."""

SECONDS_TO_ANSWER = 60.0
"""For `--help`, which takes a tenth of a second on an idle machine."""

_FIRST_LINE = re.compile(r"^(\w+)-(\d+(?:\.\d+)*)\S* based on Slic3r", re.MULTILINE)


@dataclass(frozen=True)
class Slicer:
    """A slicer that can be run.

    Attributes:
        path: Of the program.
        name: As it calls itself.
        version: As it says, such as `2.5.0`.
    """

    path: Path
    name: str
    version: str


def find_slicer(environment: Mapping[str, str] | None = None) -> Slicer | None:
    """The slicer that the variable `BELLOWS_SLICER` names, or else PrusaSlicer on the PATH.

    Returns:
        None where there is none, or the variable is empty.

    Raises:
        PrintersError: The variable names no program, or the program is no PrusaSlicer that has the
            keys of our settings.
    """
    surroundings = os.environ if environment is None else environment
    named = surroundings.get(VARIABLE)
    if named is None:
        found = (shutil.which(name, path=surroundings.get("PATH")) for name in NAMES)
        path = next((path for path in found if path), None)
    else:
        path = shutil.which(named, path=surroundings.get("PATH")) if named.strip() else None
        if path is None and named.strip():
            raise PrintersError(f"{VARIABLE} names {quoted(named)}, which is no program")
    return None if path is None else _asked(Path(path))


def required_slicer(environment: Mapping[str, str] | None = None) -> Slicer:
    """`find_slicer`, or a sentence on how to get one.

    Raises:
        PrintersError: There is none; and as `find_slicer`.
    """
    slicer = find_slicer(environment)
    if slicer is None:
        raise PrintersError(
            f"there is no slicer: install PrusaSlicer (on Debian or Ubuntu the package "
            f"prusa-slicer), or name its program in the environment variable {VARIABLE}"
        )
    return slicer


def _asked(path: Path) -> Slicer:
    """The slicer, with the name and version that it states."""
    with working_folder() as folder:
        answer = run([str(path), "--help"], folder, SECONDS_TO_ANSWER).output
    found = _FIRST_LINE.search(answer)
    if found is None or found[1] != "PrusaSlicer":
        raise PrintersError(
            f"the slicer {quoted(str(path))} does not say that it is PrusaSlicer; for OrcaSlicer "
            f"settings are written, but G-code is made with PrusaSlicer only"
        )
    if tuple(int(part) for part in found[2].split(".")) < OLDEST_PRUSASLICER:
        oldest = ".".join(str(part) for part in OLDEST_PRUSASLICER)
        raise PrintersError(
            f"the slicer {quoted(str(path))} is PrusaSlicer {found[2]}; it must be {oldest} or "
            f"newer, as older ones do not know all settings"
        )
    return Slicer(path, found[1], found[2])
