"""Running another program in a folder, for so long and no longer."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from printers.errors import PrintersError, quoted
from printers.slicing.guardian import RUNNING, end

OUTPUT_KEPT = 100_000
"""Bytes of what the program says, the last ones."""


@dataclass(frozen=True)
class Ended:
    """How a program ended: its exit status (negative: by that signal), and what it said."""

    status: int
    output: str


def run(
    command: Sequence[str],
    folder: Path,
    seconds: float,
    environment: Mapping[str, str] | None = None,
) -> Ended:
    """Run the command in the folder, without input; what it says goes to a file there.

    The environment is this program's unless another is given.

    The program has a session of its own, so that it is ended with all that it started: after the
    time limit, when this program is interrupted and, in a `working_folder`, when it is killed.

    Raises:
        PrintersError: It cannot be started, or did not end in time.
    """
    said = folder / "output.txt"
    with said.open("wb") as output:
        process = _started(command, folder, output.fileno(), environment)
        try:
            (folder / RUNNING).write_text(str(process.pid))
            status = process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            raise PrintersError(
                f"the slicer did not end within {seconds:g} s and was stopped"
            ) from None
        finally:
            _end(process)
            (folder / RUNNING).unlink(missing_ok=True)
    return Ended(status, _tail(said))


def _started(
    command: Sequence[str], folder: Path, output: int, environment: Mapping[str, str] | None
) -> subprocess.Popen[bytes]:
    try:
        return subprocess.Popen(
            command,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise PrintersError(f"{quoted(command[0])} cannot be started: {reason}") from None


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the program and what it started; what has ended already is left alone."""
    end(process.pid)
    process.wait()


def _tail(path: Path) -> str:
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - OUTPUT_KEPT))
        return file.read().decode("utf-8", "replace")
