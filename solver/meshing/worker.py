"""The mesher's process: reads jobs from stdin, runs Gmsh, writes meshes to stdout.

    python -m solver.meshing.worker FOLDER

Gmsh is C++ that cannot be stopped from within, and that may crash; here it can be ended, and takes
nobody with it. A thread watches stdin: when the program at its other end is gone, however it
ended, FOLDER goes (for what Gmsh reads and writes) and this process too, even in the midst of a
mesh.
"""

from __future__ import annotations

import os
import shutil
import sys
import threading
import time
from io import FileIO
from pathlib import Path
from queue import SimpleQueue
from typing import Any

STDIN, STDOUT, STDERR = 0, 1, 2


def main() -> None:
    """Answer jobs until stdin ends."""
    folder = Path(sys.argv[1])
    os.environ["HOME"] = os.environ["APPDATA"] = str(folder)  # Gmsh's FLTK leaves settings there
    answers = FileIO(os.dup(STDOUT), "wb")
    os.dup2(STDERR, STDOUT)  # what C code prints is no answer
    jobs: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_watch, args=(folder, jobs), daemon=True).start()
    from solver.meshing.messages import send

    failure = _load_gmsh()
    while True:
        send(answers, _answer(jobs.get(), folder, failure))


def _watch(folder: Path, jobs: SimpleQueue[Any]) -> None:
    """Queue the messages from stdin; end this process with it."""
    from solver.meshing.messages import receive

    stream = FileIO(STDIN, "rb", closefd=False)
    while (job := receive(stream)) is not None:
        jobs.put(job)
    _remove(folder)
    os._exit(0)


def _remove(folder: Path) -> None:
    """Remove a folder in which Gmsh, in the other thread, may still be writing."""
    for _ in range(40):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(0.05)


def _load_gmsh() -> dict[str, str] | None:
    """Import Gmsh while there is nothing to do yet; why it could not be, if so."""
    try:
        import gmsh  # noqa: F401
    except (ImportError, OSError) as error:
        return {"failed": str(error)}
    return None


def _answer(job: Any, folder: Path, failure: dict[str, str] | None) -> Any:
    from solver.meshing.gmsh_calls import OtherFaces, Refusal, meshed
    from solver.meshing.messages import Message

    if failure is not None:
        return Message(failure)
    brep = folder / "solid.brep"
    brep.write_bytes(job.arrays["brep"].tobytes())
    try:
        arrays = meshed(brep, job.values["faces"], job.values["settings"], job.arrays["field"])
    except Refusal as refusal:
        return Message({"refused": str(refusal)})
    except OtherFaces as others:
        return Message({"faces": others.count})
    return Message({}, arrays)


if __name__ == "__main__":
    main()
