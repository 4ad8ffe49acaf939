"""STEP, read by a process of its own: the CAD kernel may hang, crash or take all memory.

The process gets the file's content and leaves a mesh, or a sentence, in a folder of its own.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from printers.errors import PrintersError, shortened
from printers.reading.limits import STEP_MEMORY, STEP_SECONDS
from printers.reading.part import ReadPart, require_few
from printers.reading.step_files.worker import MESH, PART, SENTENCE, SHAPE

_TAIL = 4096  # bytes in which a whole file says that it ends


def read_step(content: bytes, seconds: float = STEP_SECONDS, memory: int = STEP_MEMORY) -> ReadPart:
    """The solids of a STEP file as triangles within 0.02 mm.

    Args:
        content: Of the file.
        seconds: Time after which reading is given up.
        memory: Bytes of address space that reading may take, where the system can limit it.

    Raises:
        PrintersError: The file is cut short, holds no surface, or could not be read in time, within
            the memory, or without a crash.
    """
    with _read(content, MESH, seconds, memory) as file:
        return _mesh(file)


def brep_of_step(content: bytes, seconds: float = STEP_SECONDS, memory: int = STEP_MEMORY) -> bytes:
    """The shape in a STEP file as the CAD kernel writes it (BREP), in mm.

    Args and errors as of `read_step`.
    """
    with _read(content, SHAPE, seconds, memory) as file:
        return file.read_bytes()


@contextmanager
def _read(content: bytes, wanted: str, seconds: float, memory: int) -> Iterator[Path]:
    """The file of that name that the process leaves of a STEP file."""
    if b"END-ISO-10303-21" not in content[-_TAIL:]:
        raise PrintersError("it is cut short: it does not end with END-ISO-10303-21")
    with tempfile.TemporaryDirectory(prefix="printers-step-") as name:
        folder = Path(name)
        (folder / PART).write_bytes(content)
        how = _worked(folder, wanted, seconds, memory)
        _require(folder, wanted, how)
        yield folder / wanted


def _worked(folder: Path, wanted: str, seconds: float, memory: int) -> str:
    """Run the process; how it ended, empty if well."""
    process = _started(folder, wanted, memory)
    try:
        status = process.wait(seconds)
    except subprocess.TimeoutExpired:
        raise PrintersError(f"the CAD kernel did not read it within {seconds:g} s") from None
    finally:
        process.kill()
        process.wait()
    if status < 0:
        return f"it was ended by {signal.Signals(-status).name}"
    return f"it ended with status {status}" if status else ""


def _started(folder: Path, wanted: str, memory: int) -> subprocess.Popen[bytes]:
    # -P: nothing from the current folder, which may hold a file of any name
    program = [sys.executable, "-P", "-m", "printers.reading.step_files.worker"]
    return subprocess.Popen(
        [*program, str(folder), str(memory), wanted],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,  # the kernel talks
        stderr=subprocess.DEVNULL,
        env=_environment(),
        start_new_session=True,  # a Ctrl-C of the terminal reaches this program, which ends it
    )


def _environment() -> Mapping[str, str]:
    places = os.pathsep.join(os.path.abspath(place) for place in sys.path if place)
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONWARNINGS"}
    return {**kept, **threads, "PYTHONPATH": places}


def _sentence(folder: Path) -> str:
    """What the process has to say; empty if nothing, or if it had no memory left to say it."""
    try:
        return shortened((folder / SENTENCE).read_text("utf-8"))
    except (FileNotFoundError, UnicodeDecodeError):
        return ""


def _require(folder: Path, wanted: str, how: str) -> None:
    """Raise what the process says, or how it ended, unless it left what was wanted."""
    sentence = _sentence(folder)
    if sentence:
        raise PrintersError(sentence)
    if how or not (folder / wanted).is_file():
        raise PrintersError(f"the CAD kernel could not read it: {how or 'it left no mesh'}")


def _mesh(file: Path) -> ReadPart:
    try:
        with np.load(file, allow_pickle=False) as found:
            require_few(len(found["triangles"]))
            texts = [str(text) for text in found["texts"]]
            return ReadPart(
                found["vertices"], found["triangles"], "STEP", texts[0], tuple(texts[1:])
            )
    except (BadZipFile, KeyError, ValueError, OSError) as error:
        if isinstance(error, PrintersError):
            raise
        raise PrintersError("the CAD kernel left half a mesh") from None
