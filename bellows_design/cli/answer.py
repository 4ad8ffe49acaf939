"""One answer on stdout, everything else on stderr, and an exit status.

Libraries written in C print to stdout when they please; while a command works, file descriptor 1
leads to stderr, so that a JSON answer stands alone.
"""

from __future__ import annotations

import gc
import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from bellows_design.cli.early_signals import ended_by
from bellows_design.cli.interruption import ended_in_time, interruption_in, raising_signals
from bellows_design.cli.layout.asked import command_asked
from bellows_design.cli.layout.said import error_content, print_error, print_json, stated
from bellows_design.cli.surroundings.courses import courses_of, learn
from bellows_design.cli.terminal.console import print_for_people
from bellows_design.errors import BellowsError, ClusterError, UnreachedError
from bellows_design.files.errors import CannotWrite
from bellows_design.progress.shown import Shown, shown_as

if TYPE_CHECKING:
    from rich.console import RenderableType

DONE, REFUSED, BAD_INPUT, NOT_SOLVED, INTERNAL = 0, 1, 2, 3, 4
TRACEBACK = "BELLOWS_TRACEBACK"
"""Environment variable: when set, errors show where they come from."""

OBJECTS_BETWEEN_COLLECTIONS = 50_000
"""At Python's own 700 the collector runs a thousand times while an evaluation loads its libraries,
whose objects all stay."""


CLEARING_UP = {
    "solver.meshing.process": "kill",
    "bellows_design.files.atomic": "remove_unfinished",
    "bellows_design.progress.bar": "leave_terminal",
    "bellows_design.batch.cluster": "release_semaphores",
}
"""Modules, and their functions that clear up what is unfinished when a process ends at once."""


@dataclass(frozen=True)
class Answer:
    """What a command found: for a program, for a person, and as an exit status.

    ``unwritten`` is why a file that was to hold it besides does not; the status is that of an error
    then. ``states_schema``: whether JSON begins with the name of the answer's schema.
    """

    content: dict[str, Any]
    text: Sequence[RenderableType]
    status: int = DONE
    unwritten: CannotWrite | None = None
    states_schema: bool = True


def answer(work: Callable[[], Answer], as_json: bool, quiet: bool = False) -> None:
    """Do ``work`` and print its answer, or one sentence on why there is none; then exit.

    ``quiet``: without progress and notes on the way.
    """
    try:
        with (
            raising_signals() as signals,
            stdout_is_stderr() as stdout,
            ended_in_time(lambda number: _leave(number, stdout if as_json else None)),
            rare_garbage_collection(),
            shown_as(_progress(quiet)),
        ):
            result = work()
    except BaseException as error:
        if isinstance(error, SystemExit | GeneratorExit):
            raise
        if os.environ.get(TRACEBACK):
            _print_traceback(error)
        sentence, status = ended_by(signals.received[0]) if signals.received else explained(error)
        print_error(sentence, status, as_json)
        raise typer.Exit(status) from None
    if as_json:
        print_json(stated(result.content) if result.states_schema else result.content)
    else:
        print_for_people(result.text)
    if result.unwritten is not None:
        typer.echo(f"bellows: {result.unwritten}.", err=True)
        raise typer.Exit(BAD_INPUT)
    raise typer.Exit(result.status)


def _progress(quiet: bool) -> Shown:
    """How the progress of the command that was typed is shown."""
    command = command_asked()
    return Shown(quiet, partial(courses_of, command), partial(learn, command))


def unwritten(*writers: Callable[[], None]) -> CannotWrite | None:
    """Call ``writers``; why the first that fails cannot write its file, None if all can."""
    try:
        for write in writers:
            write()
    except CannotWrite as error:
        return error
    return None


def explained(error: BaseException) -> tuple[str, int]:
    """One sentence for people and the exit status for ``error``."""
    from bellows_design.cli.surroundings.memory import want_of_memory
    from bellows_design.cli.system_libraries import missing_library

    want = want_of_memory(error)
    if want is not None:
        return want, NOT_SOLVED
    missing = missing_library(error)
    if missing is not None:
        return missing, INTERNAL
    interruption = interruption_in(error)
    if interruption is not None:
        return ended_by(interruption)
    if isinstance(error, CannotWrite):
        return f"{error}.", BAD_INPUT
    if isinstance(error, FileNotFoundError) and isinstance(error.filename, str):
        return _missing_file(Path(error.filename)), BAD_INPUT
    if isinstance(error, OSError) and error.strerror:
        place = f"{error.filename}: " if error.filename else ""
        return f"{place}{error.strerror}.", BAD_INPUT
    status = _status_of_user_error(error)
    if status is not None:
        return str(error), status
    return (
        f"internal error, {type(error).__name__}: {error} "
        f"(set {TRACEBACK}=1 to see where; please report it).",
        INTERNAL,
    )


def _missing_file(path: Path) -> str:
    from bellows_design.validation.quoting import near_file, quoted_path

    return f"there is no file {quoted_path(path)}{near_file(path) or '.'}"


def _status_of_user_error(error: BaseException) -> int | None:
    """The exit status of an error whose sentence is meant for users; None for any other."""
    if isinstance(error, BellowsError):
        unsolved = isinstance(error, ClusterError | UnreachedError)
        return NOT_SOLVED if unsolved else BAD_INPUT
    if not isinstance(error, ValueError | RuntimeError):
        return None
    from printers.errors import PrintersError
    from solver.errors import MeshingError, SolverError

    if isinstance(error, MeshingError):
        return NOT_SOLVED
    return BAD_INPUT if isinstance(error, SolverError | PrintersError) else None


@contextmanager
def stdout_is_stderr() -> Iterator[int]:
    """Within the block, whatever is written to stdout, from C too, comes out on stderr.

    Yields the number of the file that stdout led to.
    """
    python_stdout = sys.stdout
    sys.stdout.flush()
    saved = os.dup(1)
    try:
        os.dup2(2, 1)
        sys.stdout = sys.stderr
        yield saved
    finally:
        sys.stdout = python_stdout
        with suppress(OSError):
            _flush_c_streams()
        os.dup2(saved, 1)
        os.close(saved)


@contextmanager
def rare_garbage_collection() -> Iterator[None]:
    """Within the block, look for unreachable cycles of objects less often than Python would."""
    usual = gc.get_threshold()
    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS)
    try:
        yield
    finally:
        gc.set_threshold(*usual)


def _flush_c_streams() -> None:
    """Push out what C code left in its own buffer, while it still leads to stderr."""
    import ctypes

    ctypes.CDLL(None).fflush(None)


def clear_up() -> None:
    """Remove what is unfinished: the process ends at once."""
    for module, function in CLEARING_UP.items():
        if module in sys.modules:  # the main thread may be importing it: to import it would wait
            getattr(sys.modules[module], function, int)()


def _leave(number: int, json_to: int | None) -> None:
    """End the process at once because of a signal; with an answer on the file ``json_to``."""
    clear_up()
    sentence, status = ended_by(number)
    with suppress(OSError):
        os.write(2, f"bellows: {sentence}\n".encode())
    with suppress(OSError):
        if json_to is not None:
            content = error_content(sentence, status)
            os.write(json_to, json.dumps(content, indent=2).encode() + b"\n")
    os._exit(status)


def _print_traceback(error: BaseException) -> None:
    import traceback

    typer.echo("".join(traceback.format_exception(error)), err=True)
