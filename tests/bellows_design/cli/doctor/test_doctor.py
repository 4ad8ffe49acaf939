"""``bellows doctor``: what is well, what is not, and how to mend it, whatever is broken."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from bellows_design.cli.doctor import computing, examine, libraries, places, programs
from bellows_design.cli.doctor.finding import Examination, Finding
from bellows_design.cli.doctor.probes import PROBES
from bellows_design.cli.doctor.trying import LATE, Tried, tried

Bellows = Callable[..., tuple[int, str, str]]


def answers() -> dict[str, Tried]:
    """What probes say where all is well."""
    said: Mapping[str, dict[str, Any]] = {
        "libraries": {"numpy": {"works": True}},
        "cad": {"cadquery": {"works": True}},
        "mesher": {"gmsh": {"works": True}},
        "solver": {
            "linear solver": {"works": True, "solver": "pardiso", "unknowns": 8, "seconds": 0.01}
        },
        "compiler": {"numba": {"works": True, "folder": "/x", "writable": True, "threads": 2}},
        "display": {"pyvista": {"works": True}},
    }
    return {name: Tried(said=each) for name, each in said.items()}


@pytest.fixture
def probed(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Call it with what probes shall say instead of the usual."""

    def install(**changes: Tried) -> None:
        monkeypatch.setattr(examine, "tried", lambda names: answers() | changes)

    return install


def findings(bellows: Bellows) -> tuple[int, dict[str, dict[str, str]]]:
    status, out, _ = bellows("doctor", "--json")
    content = json.loads(out)
    assert content["healthy"] is (status == 0)
    return status, {each["name"]: each for each in content["findings"]}


def test_where_all_is_well_the_status_is_0(bellows: Bellows, probed: Callable[..., None]) -> None:
    probed()
    status, found = findings(bellows)
    assert status == 0 and found["linear solver"]["said"].startswith("pardiso")
    assert {"Python", "numpy", "gmsh", "slicer", "cache", "exports", "locale"} <= set(found)
    status, out, _ = bellows("doctor")
    assert status == 0 and "everything that is needed is there" in out


@pytest.mark.parametrize(
    ("probe", "broken", "name", "mend"),
    [
        (
            "mesher",
            Tried(
                said={
                    "gmsh": {
                        "works": False,
                        "error": "OSError: libGLU.so.1: cannot open shared object file",
                    }
                }
            ),
            "gmsh",
            "libglu1-mesa",
        ),
        (
            "cad",
            Tried(broken={"cadquery": "it ended by signal 11"}),
            "cadquery",
            "pip install --force-reinstall cadquery",
        ),
        (
            "libraries",
            Tried(
                said={
                    "numpy": {
                        "works": False,
                        "error": "ModuleNotFoundError: No module named 'numpy'",
                    }
                }
            ),
            "numpy",
            "pip install -e .",
        ),
        ("solver", Tried(broken={"linear solver": "it said nothing"}), "linear solver", "scipy"),
        ("compiler", Tried(), "compiled functions", "numba"),
    ],
)
def test_what_is_broken_fails_with_how_to_mend_it(
    probe: str, broken: Tried, name: str, mend: str, bellows: Bellows, probed: Callable[..., None]
) -> None:
    probed(**{probe: broken})
    status, found = findings(bellows)
    assert status == 1 and found[name]["verdict"] == "fail" and mend in found[name]["mend"]
    assert found["Python"]["verdict"] == "ok"


def test_what_is_slow_or_not_drawn_is_a_warning(
    bellows: Bellows, probed: Callable[..., None]
) -> None:
    slow = {"works": True, "solver": "superlu", "unknowns": 8, "seconds": 0.1}
    probed(
        solver=Tried(said={"linear solver": slow}),
        display=Tried(broken={"pyvista": "it ended by signal 6"}),
        cad=Tried(broken={"cadquery": f"{LATE} 20 s"}),
        compiler=Tried(broken={"numba": f"{LATE} 20 s"}),
    )
    status, found = findings(bellows)
    assert status == 0
    assert "pip install mkl" in found["linear solver"]["mend"]
    assert "libegl1" in found["pictures by VTK"]["mend"]
    assert found["cadquery"]["verdict"] == found["compiled functions"]["verdict"] == "warn"


def test_an_examination_that_fails_itself_is_a_warning_and_the_rest_goes_on(
    bellows: Bellows, probed: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> Finding:
        raise RuntimeError("psutil is broken")

    probed()
    for module, name in ((computing, "memory"), (libraries, "extras"), (places, "disks")):
        monkeypatch.setattr(module, name, fail)
    monkeypatch.setattr(programs, "slicer", fail)
    status, found = findings(bellows)
    assert status == 0 and "psutil is broken" in found["memory"]["said"]
    assert found["slicer"]["verdict"] == "warn" and found["locale"]["verdict"] == "ok"


def test_a_library_that_ends_its_process_is_named_and_those_before_it_are_well(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A made-up library in the place of the real one, in a real process."""
    (tmp_path / "rtree.py").write_text("import os\nos.kill(os.getpid(), 11)\n")
    (tmp_path / "psutil.py").write_text("raise ImportError('libX11.so.6: cannot open shared "
                                        "object file: No such file or directory')\n")  # fmt: skip
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}:{Path(__file__).parents[4]}")
    found = tried(["libraries"], 120.0)["libraries"]
    assert found.said["numpy"]["works"] and "libX11" in found.said["psutil"]["error"]
    assert found.broken == {"rtree": "it ended by signal 11"}
    names = {each.name: each for each in libraries.core({"libraries": found})}
    assert names["rtree"].verdict == "fail" and "libx11-6" in names["psutil"].mend


@pytest.mark.thorough
def test_a_probe_that_does_not_answer_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "gmsh.py").write_text("import time\ntime.sleep(60)\n")
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}:{Path(__file__).parents[4]}")
    found = tried(["mesher"], 4.0)["mesher"]
    assert list(found.broken.values()) == [f"{LATE} 4 s"]


@pytest.mark.slow
@pytest.mark.parametrize("name", list(PROBES))
def test_every_probe_finds_its_library_well_here(name: str) -> None:
    found = tried([name], 120.0)[name]
    assert not found.broken and found.said
    assert all(each["works"] for each in found.said.values())


def test_variables_that_nothing_reads_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BELLOWS_CAHCE", "/somewhere")
    monkeypatch.setenv("BELLOWS_OTHER", "1")
    found = {each.name: each for each in places.variables()}
    assert found["BELLOWS_CAHCE"].verdict == "warn"
    assert found["BELLOWS_CAHCE"].mend == "did you mean BELLOWS_CACHE?"
    assert found["BELLOWS_OTHER"].mend.startswith("it reads BELLOWS_CACHE, ")
    assert found["BELLOWS_SLICER"].verdict == "ok"


def test_a_folder_that_cannot_be_written_is_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("BELLOWS_CACHE", str(tmp_path / "file" / "cache"))
    assert places.cache().verdict == "warn" and "BELLOWS_CACHE" in places.cache().mend
    monkeypatch.chdir(tmp_path)
    assert places.exports().verdict == "ok" and not (tmp_path / "exports").exists()


def test_only_a_failure_is_no_health() -> None:
    verdicts: Iterator[tuple[Any, bool]] = iter((("ok", True), ("warn", True), ("fail", False)))
    for verdict, healthy in verdicts:
        assert Examination([Finding("extras", "x", verdict, "said")], 0.1).healthy is healthy
