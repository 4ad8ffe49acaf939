"""The meshing process: reads jobs from stdin, runs Gmsh, writes meshes to stdout.

    python -m solver.meshing.worker FOLDER

Gmsh, in C++, cannot be stopped by a call and may crash; in a process of its own it can be ended,
and a crash does not end the program. FOLDER is for the files that Gmsh reads and writes. A thread
reads stdin: at its end, when the program has ended in any way, it removes FOLDER and ends this
process, also while Gmsh makes a mesh.
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
    for name in ("HOME", "APPDATA", "TMPDIR"):  # Gmsh's FLTK and other libraries leave files there
        os.environ[name] = str(folder)
    answers = FileIO(os.dup(STDOUT), "wb")
    os.dup2(STDERR, STDOUT)  # keeps what C code prints out of the answers
    jobs: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_watch, args=(folder, jobs), daemon=True).start()
    from solver.meshing.limits import allow_stack
    from solver.meshing.messages import send

    allow_stack()
    failure = _load_gmsh()
    while True:
        send(answers, _answer(jobs.get(), folder, failure))


def _watch(folder: Path, jobs: SimpleQueue[Any]) -> None:
    """Queue the messages from stdin; at its end, end this process."""
    from solver.meshing.messages import receive

    stream = FileIO(STDIN, "rb", closefd=False)
    while (job := receive(stream)) is not None:
        jobs.put(job)
    _remove(folder)
    os._exit(0)


def _remove(folder: Path) -> None:
    """Remove a folder to which Gmsh, in the other thread, may still write."""
    for _ in range(40):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(0.05)


def _load_gmsh() -> dict[str, str] | None:
    """Import Gmsh before the first job; the error as an answer if that fails."""
    try:
        import gmsh  # noqa: F401
    except (ImportError, OSError) as error:
        return {"failed": str(error)}
    return None


def _answer(job: Any, folder: Path, failure: dict[str, str] | None) -> Any:
    from solver.meshing.gmsh_calls import OtherFaces, Refusal
    from solver.meshing.messages import Message

    if failure is not None:
        return Message(failure)
    try:
        return Message({}, (_of_parts if "parts" in job.values else _of_one)(job, folder))
    except Refusal as refusal:
        return Message({"refused": str(refusal)})
    except OtherFaces as others:
        return Message({"faces": others.count, "part": others.part})
    except OSError as error:
        return Message({"refused": f"Gmsh cannot use its temporary folder: {error.strerror}"})


def _of_one(job: Any, folder: Path) -> Any:
    """Arrays of the mesh of one solid."""
    from solver.meshing.gmsh_calls import meshed

    brep = _written(folder, "solid.brep", job.arrays["brep"])
    return meshed(brep, job.values["faces"], job.values["settings"], job.arrays["field"])


def _of_parts(job: Any, folder: Path) -> Any:
    """Arrays of the mesh of several solids."""
    from solver.meshing.gmsh_parts import Solid, meshed_parts

    solids = [
        Solid(_written(folder, f"{number}.brep", job.arrays[f"brep {number}"]), **values)
        for number, values in enumerate(job.values["parts"])
    ]
    return meshed_parts(solids, job.values["settings"], job.arrays["field"])


def _written(folder: Path, name: str, content: Any) -> Path:
    """The path of a file with some content, as Gmsh takes it."""
    path = _named_for_gmsh(folder, name)
    path.write_bytes(content.tobytes())
    return path


def _named_for_gmsh(folder: Path, name: str) -> Path:
    """A path of the file in ``folder``; Gmsh takes text in UTF-8 only, which bytes may not be."""
    try:
        str(folder).encode("utf-8")
    except UnicodeEncodeError:
        os.chdir(folder)
        return Path(name)
    return folder / name


if __name__ == "__main__":
    main()
