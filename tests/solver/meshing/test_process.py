"""Gmsh at arm's length: what it does, or fails to do, never takes the program with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from io import BytesIO
from pathlib import Path

import cadquery as cq
import numpy as np
import pytest

from solver.errors import MeshingError
from solver.mesh.mesh import Mesh
from solver.meshing import process as meshing_process
from solver.meshing.gmsh_calls import meshed
from solver.meshing.messages import Message, receive, send
from solver.meshing.solid import MeshOptions, mesh_solid

ROOT = Path(__file__).parents[3]
HUGE = MeshOptions(size=0.04, smallest_size=0.01)
"""Asks for about 20 million tetrahedra of the ball."""

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")


def process_id() -> int:
    """Number of the process that meshes, which is started if none is running."""
    return meshing_process._mesher(os.getpid()).start()


def ball() -> bytes:
    brep = BytesIO()
    cq.Solid.makeSphere(5.0, angleDegrees1=-90).exportBrep(brep)
    return brep.getvalue()


def meshed_ball(options: MeshOptions | None = None, seconds: float = 60.0) -> Mesh:
    return mesh_solid(ball(), ["skin"], options, seconds)


def is_running(process: int) -> bool:
    """True for a process that is there and no zombie."""
    status = Path(f"/proc/{process}/status")
    if Path("/proc/self").exists():
        return status.exists() and "State:\tZ" not in status.read_text("utf-8", "replace")
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def soon(condition: Callable[[], bool], seconds: float = 20.0) -> bool:
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    return condition()


def test_the_mesh_of_the_other_process_is_that_of_gmsh_here_bit_by_bit(tmp_path: Path) -> None:
    (tmp_path / "ball.brep").write_bytes(ball())
    settings = {
        "Mesh.MeshSizeMax": 1.5,
        "Mesh.MeshSizeMin": 0.1,
        "Mesh.MeshSizeFromCurvature": 8.0,
    }
    here = meshed(tmp_path / "ball.brep", 1, settings, np.empty((0, 16)))
    there = meshed_ball(MeshOptions(1.5, 8.0))
    assert np.array_equal(here["nodes"], there.nodes)
    assert np.array_equal(here["tets"], there.tets)


def test_a_mesh_that_takes_too_long_is_given_up_and_the_next_one_made() -> None:
    first = meshed_ball()
    process = process_id()
    with pytest.raises(MeshingError, match=r"within 0\.4 s and was stopped"):
        meshed_ball(HUGE, seconds=0.4)
    assert soon(lambda: not is_running(process))
    assert np.array_equal(meshed_ball().nodes, first.nodes)


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan"), float("inf")])
def test_a_limit_that_is_none_is_refused(seconds: float) -> None:
    with pytest.raises(ValueError, match=r"mesh: seconds = .* must be finite and above 0"):
        meshed_ball(seconds=seconds)


@POSIX
@pytest.mark.parametrize(
    ("number", "words"),
    [
        (signal.SIGSEGV, r"Gmsh crashed on this solid \(SIGSEGV"),
        (signal.SIGKILL, r"stopped for want of memory \(SIGKILL"),  # as the kernel does it
    ],
)
def test_a_crash_of_gmsh_is_a_sentence_and_the_next_mesh_is_made(
    number: signal.Signals, words: str
) -> None:
    meshed_ball()
    crash = threading.Timer(0.3, os.kill, (process_id(), number))
    crash.start()
    with pytest.raises(MeshingError, match=words):
        meshed_ball(HUGE)
    assert len(meshed_ball().tets) > 0


@POSIX
def test_an_interrupted_mesh_is_given_up_and_its_answer_not_taken_for_the_next() -> None:
    expected = meshed_ball()
    process = process_id()
    threading.Timer(0.3, signal.raise_signal, (signal.SIGINT,)).start()
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            meshed_ball(HUGE)
    finally:
        signal.signal(signal.SIGINT, usual)
    assert soon(lambda: not is_running(process))
    assert np.array_equal(meshed_ball().nodes, expected.nodes)


@POSIX
def test_a_process_that_died_while_idle_is_replaced_silently() -> None:
    meshed_ball()
    os.kill(process_id(), signal.SIGKILL)
    time.sleep(0.1)
    assert len(meshed_ball().tets) > 0


ORPHANS = """
import os, sys, tempfile
from pathlib import Path
tempfile.tempdir = sys.argv[1]
from solver.meshing import MeshOptions, mesh_solid
from solver.meshing.process import _mesher
print(_mesher(os.getpid()).start(), flush=True)
mesh_solid(Path(sys.argv[2]), ["skin"], MeshOptions(size=0.04, smallest_size=0.01))
"""


@POSIX
def test_gmsh_dies_with_a_killed_program_even_in_the_midst_of_a_mesh(tmp_path: Path) -> None:
    (tmp_path / "ball.brep").write_bytes(ball())
    rooms = tmp_path / "temporary"
    rooms.mkdir()
    program = subprocess.Popen(
        [sys.executable, "-c", ORPHANS, str(rooms), str(tmp_path / "ball.brep")],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        encoding="utf-8",
    )
    assert program.stdout is not None
    process = int(program.stdout.readline())
    assert soon(lambda: any(rooms.glob("*/solid.brep")))  # the job has arrived
    assert is_running(process)
    program.kill()
    program.wait()
    program.stdout.close()
    assert soon(lambda: not is_running(process))
    assert soon(lambda: not any(rooms.iterdir()))


def test_nothing_is_left_in_the_home_folder_and_gmsh_stays_out_of_this_process(
    tmp_path: Path,
) -> None:
    code = (
        "import sys; from pathlib import Path; from solver.meshing.solid import mesh_solid\n"
        "mesh_solid(Path(sys.argv[1]), ['skin'])\n"
        "sys.exit('gmsh' in sys.modules)"
    )
    (tmp_path / "home").mkdir()
    (tmp_path / "ball.brep").write_bytes(ball())
    environment = {**os.environ, "HOME": str(tmp_path / "home"), "TMPDIR": str(tmp_path / "home")}
    arguments = [sys.executable, "-c", code, str(tmp_path / "ball.brep")]
    done = subprocess.run(
        arguments, cwd=ROOT, env=environment, capture_output=True, encoding="utf-8"
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert list((tmp_path / "home").iterdir()) == []


def test_why_gmsh_cannot_be_loaded_is_passed_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sentence = "libGLU.so.1: cannot open shared object file: No such file or directory"
    (tmp_path / "gmsh.py").write_text(f"raise OSError({sentence!r})")
    monkeypatch.syspath_prepend(tmp_path)
    new = meshing_process._Mesher()
    monkeypatch.setattr(meshing_process, "_mesher", lambda _: new)
    with pytest.raises(OSError, match=r"libGLU\.so\.1: cannot open"):
        meshed_ball()


def test_modules_in_the_current_folder_are_not_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("gmsh", "json", "solver"):
        (tmp_path / f"{name}.py").write_text("raise OSError('not mine')")
    new = meshing_process._Mesher()
    monkeypatch.setattr(meshing_process, "_mesher", lambda _: new)
    monkeypatch.chdir(tmp_path)
    assert len(meshed_ball().tets) > 0


def test_threads_take_turns() -> None:
    sizes = [1.6, 1.2, 1.6, 1.2]
    with ThreadPoolExecutor(4) as pool:
        meshes = list(pool.map(lambda size: meshed_ball(MeshOptions(size)), sizes))
    for one, other in ((0, 2), (1, 3)):
        assert np.array_equal(meshes[one].nodes, meshes[other].nodes)
    assert len(meshes[0].tets) < len(meshes[1].tets)


def test_a_message_arrives_bit_by_bit() -> None:
    numbers = np.array([[0.1, -0.0, np.inf], [np.nan, 5e-324, 1 / 3]])
    sent = Message({"text": "ä\n"}, {"a": numbers, "none": np.empty((0, 16)), "b": numbers[:, 1]})
    stream = BytesIO()
    send(stream, sent)  # type: ignore[arg-type]
    stream.seek(0)
    got = receive(stream)  # type: ignore[arg-type]
    assert got is not None and got.values == sent.values
    assert list(got.arrays) == list(sent.arrays)
    for name, array in sent.arrays.items():
        assert got.arrays[name].dtype == array.dtype and got.arrays[name].shape == array.shape
        assert got.arrays[name].tobytes() == array.tobytes()


def test_a_message_cut_short_is_none() -> None:
    stream = BytesIO()
    send(stream, Message({"a": 1}, {"b": np.arange(9.0)}))  # type: ignore[arg-type]
    for size in range(len(stream.getvalue())):
        assert receive(BytesIO(stream.getvalue()[:size])) is None  # type: ignore[arg-type]


DELETED = """
import os, sys, tempfile
from pathlib import Path
from solver.meshing import mesh_solid
tempfile.tempdir = sys.argv[1]
content = Path(sys.argv[2]).read_bytes()
os.rmdir(os.getcwd())
sys.path.append("relative")
print(len(mesh_solid(content, ["skin"]).tets) > 0, end="")
"""


@POSIX
@pytest.mark.parametrize("name", ["temporary", os.fsdecode(b"\xff")])
def test_neither_a_deleted_working_folder_nor_a_strange_temporary_one_matters(
    name: str, tmp_path: Path
) -> None:
    for folder in ("gone", name):
        (tmp_path / folder).mkdir()
    (tmp_path / "ball.brep").write_bytes(ball())
    done = subprocess.run(
        [sys.executable, "-c", DELETED, str(tmp_path / name), str(tmp_path / "ball.brep")],
        cwd=tmp_path / "gone",
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error::SyntaxWarning"},
        capture_output=True,
        encoding="utf-8",
    )
    assert (done.stdout, done.returncode) == ("True", 0), done.stderr
    assert list((tmp_path / name).iterdir()) == []


def test_a_mesher_that_cannot_be_started_leaves_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(meshing_process, "_launched", lambda _: [][0])
    with pytest.raises(IndexError):
        meshing_process._Process()
    assert list(tmp_path.iterdir()) == []
