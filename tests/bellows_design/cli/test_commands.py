"""The command: one answer on stdout, sentences on stderr, and a true exit status."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import pytest
from fakes import FakeEvaluation, fake_report
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bellows_design.analysis.model_names import ModelName
from bellows_design.analysis.models import MODELS
from bellows_design.analysis.whole_actuator import Reading
from bellows_design.budget import Budget
from bellows_design.cli.answer import explained, stdout_is_stderr
from bellows_design.cli.system_libraries import INSTALL, PACKAGES, missing_library
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design, shipped_designs
from printers import RuleResult

Bellows = Callable[..., tuple[int, str, str]]
ROOT = Path(__file__).parents[3]
FAILED = fake_report(
    RuleResult("minimum_lines", "fail", 2, 3, "lines", "bubble_thickness", "Too few lines.")
)


def test_help_and_list_load_nothing_heavy() -> None:
    """What takes seconds to import must wait until a command needs it."""
    code = (
        "import sys; from bellows_design.cli.commands import app\n"
        "try: app(sys.argv[1:])\n"
        "except SystemExit as e: assert not e.code\n"
        "heavy = {'cadquery', 'gmsh', 'numba', 'psutil', 'scipy', 'trimesh', 'vtkmodules', 'OCP'}\n"
        "sys.exit(str(heavy & set(sys.modules)) if heavy & set(sys.modules) else 0)"
    )
    for arguments in (["--help"], ["list"], ["list", "--json"], ["run", "--help"]):
        done = subprocess.run(
            [sys.executable, "-c", code, *arguments],
            capture_output=True,
            encoding="utf-8",
            cwd=ROOT,
        )
        assert done.returncode == 0, done.stderr


def test_list_names_every_shipped_design(bellows: Bellows) -> None:
    status, out, _ = bellows("list", "--json")
    assert status == 0 and set(json.loads(out)["designs"]) == set(shipped_designs())
    status, out, err = bellows("list")
    assert status == 0 and all(name in out for name in shipped_designs()) and not err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["check", "nowhere"], "unknown design “nowhere”"),
        (["check", "missing.toml"], "there is no file “missing.toml”"),
        (["check", "../prototype_1"], "there is no file"),
        (["run", "prototype_1", "--set", "bubble_width=20000"], "20000 µm would be 20 mm"),
        (["evaluate", "prototype_1", "--set", "bubble_width=nan"], "finite number"),
        (["evaluate", "prototype_1", "--pressure", "100"], "100 kPa would be 0.1 MPa"),
        (["evaluate", "prototype_1", "--pressure", "nan"], "“nan” is no number of MPa"),
        (["evaluate", "prototype_1", "--pressure", "0.1:0.02:0.01"], "START <= STOP"),
        (["evaluate", "prototype_1", "--pressure", "0.1:100:50"], "100 kPa would be 0.1 MPa"),
        (["evaluate", "prototype_1", "--accuracy", "0"], "must lie between 0.01 and 100 %"),
        (["run", "prototype_1", "--set", "name=../x"], "name is “../x”"),
        (["design", "prototype_1", "-o", "part.obj"], "must end in .stl"),
        (["design", "prototype_1", "-o", "no/where/part.stl"], "there is no folder"),
        (["evaluate", "prototype_1", "--vtu", "bent.txt"], "must end in .vtu or .xdmf"),
        (["check", "prototype_1", "--printer", "no_such"], "no_such"),
        (["run", "prototype_1", "--set", "printer=no_such"], "no_such"),
    ],
)
@pytest.mark.parametrize("as_json", [False, True])
def test_bad_input_gets_one_sentence_and_status_2(
    arguments: list[str],
    words: str,
    as_json: bool,
    bellows: Bellows,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = bellows(*arguments, *(["--json"] if as_json else []))
    assert status == 2
    assert words in err and "Traceback" not in err and err.count("\n") == 1
    if as_json:
        assert json.loads(out)["exit_status"] == 2 and words in json.loads(out)["error"]
    else:
        assert out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments", [["evaluate", "prototype_1", "--model", "magic"], ["nothing"], ["check"]]
)
def test_wrong_usage_has_status_2(arguments: list[str], bellows: Bellows) -> None:
    status, out, err = bellows(*arguments)
    assert status == 2 and out == "" and "Traceback" not in err


def test_the_models_that_may_be_asked_for_are_those_there_are() -> None:
    assert [name.value for name in ModelName] == ["auto", *MODELS]


def test_an_approved_run_ends_with_files_and_status_0(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation())
    status, out, err = bellows("run", "prototype_2", "--output", str(tmp_path), "--json")
    answer = json.loads(out)
    assert status == 0 and answer["approved"] and answer["reasons"] == []
    assert (tmp_path / "prototype_2" / "prototype_2.stl").exists()
    manifest = json.loads((tmp_path / "prototype_2" / "manifest.json").read_text("utf-8"))
    assert manifest["digest"] == load_design("prototype_2").digest
    assert manifest["evaluation"]["bending_angle_deg"] == 400
    assert "solve" in err


def test_a_refused_run_names_its_reasons_leaves_nothing_and_withdraws_the_earlier_export(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation())
    assert bellows("run", "prototype_1", "--output", str(tmp_path))[0] == 0
    stub_stages(FakeEvaluation(max_von_mises_mpa=4.547), FAILED)
    status, out, _ = bellows("run", "prototype_1", "--output", str(tmp_path))
    assert status == 1 and "REFUSED" in out and "was withdrawn" in out
    assert "Too few lines." in out and "0.547 MPa above the limit of 4 MPa" in out
    assert list(tmp_path.iterdir()) == []


def test_a_refused_run_does_not_even_make_the_output_folder(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation(), FAILED)
    status, _, _ = bellows("run", "prototype_1", "--output", str(tmp_path / "exports"))
    assert status == 1 and list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("occupied", ["output", "output/prototype_1"])
def test_an_occupied_place_is_noticed_before_anything_is_computed(
    occupied: str, bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(AssertionError("computed"))
    (tmp_path / occupied).parent.mkdir(exist_ok=True)
    (tmp_path / occupied).write_text("mine")
    status, _, err = bellows("run", "prototype_1", "--output", str(tmp_path / "output"))
    assert status == 2
    assert "is a file, not a folder" in err or "not an export of ours" in err
    assert (tmp_path / occupied).read_text("utf-8") == "mine"


def test_a_changed_design_leaves_the_export_of_the_original_alone(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation())
    bellows("run", "prototype_1", "--output", str(tmp_path))
    bellows("run", "prototype_1", "--output", str(tmp_path), "--set", "bubble_width=18")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert len(names) == 2 and names[0] == "prototype_1"
    assert re.fullmatch(r"prototype_1-[0-9a-f]{8}", names[1])


def test_a_load_that_was_not_reached_has_status_3(
    bellows: Bellows, stub_stages: Callable[..., None], tmp_path: Path
) -> None:
    stub_stages(FakeEvaluation(converged=False, pressure_mpa=0.06, message="It buckled."))
    status, out, _ = bellows("run", "prototype_1", "--output", str(tmp_path))
    assert status == 3 and "0.06 MPa of 0.1 MPa" in out and "It buckled." in out
    status, out, _ = bellows("evaluate", "prototype_1", "--json")
    assert status == 3 and json.loads(out)["converged"] is False


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (RuntimeError("boom"), 4, "internal error, RuntimeError: boom"),
        (ZeroDivisionError(), 4, "BELLOWS_TRACEBACK=1"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (OSError("libGLU.so.1: cannot open shared object file: No such file"), 4, "libglu1-mesa"),
        (OSError(28, "No space left on device", "x.stl"), 2, "x.stl: No space left on device."),
    ],
)
def test_an_error_is_one_sentence(
    error: BaseException,
    status: int,
    words: str,
    bellows: Bellows,
    stub_stages: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("BELLOWS_TRACEBACK", raising=False)
    stub_stages(error)
    got, out, err = bellows("evaluate", "prototype_1", "--json")
    assert got == status and words in err and "Traceback" not in err
    assert json.loads(out)["exit_status"] == status


def test_an_interrupt_hidden_in_another_error_is_still_an_interrupt() -> None:
    hidden = ImportError("initialization failed")
    hidden.__cause__ = KeyboardInterrupt()
    assert explained(hidden)[1] == 130
    assert explained(ImportError("initialization failed"))[1] == 4


def test_the_traceback_is_shown_when_asked_for(
    bellows: Bellows, stub_stages: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BELLOWS_TRACEBACK", "1")
    stub_stages(RuntimeError("boom"))
    status, out, err = bellows("evaluate", "prototype_1")
    assert (status, out) == (4, "") and "Traceback" in err and "RuntimeError: boom" in err


def test_evaluate_shows_angle_and_stress_with_their_errors(
    bellows: Bellows, stub_stages: Callable[..., None]
) -> None:
    stub_stages(FakeEvaluation())
    status, out, _ = bellows("evaluate", "prototype_1")
    assert status == 0 and "400°" in out and "3 MPa (± 1 % estimated)" in out


def test_a_range_of_pressures_gives_a_curve_up_to_its_end(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[object, ...]] = []
    readings = tuple(
        Reading(
            pressure_mpa=pressure,
            bending_angle_deg=1000 * pressure,
            max_von_mises_mpa=30 * pressure,
            cavity_volume_mm3=7000 + pressure,
        )
        for pressure in (0.02, 0.04, 0.05)
    )

    def evaluate(design: Design, *arguments: object, budget: Budget, keep: bool) -> FakeEvaluation:
        asked.append((design.load.pressure, *arguments[:-1]))
        return FakeEvaluation(curve=readings)

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    arguments = ("--pressure", "0.02:0.05:0.02", "--model", "half", "--accuracy", "3")
    status, out, _ = bellows("evaluate", "prototype_1", *arguments)
    assert status == 0 and asked == [(0.05, "half", 3.0, (0.02, 0.04, 0.05))]
    for number in ("20.00", "40.00", "50.00", "1.200", "0.02", "0.04"):
        assert number in out
    status, out, _ = bellows("evaluate", "prototype_1", "--json", *arguments)
    assert json.loads(out)["curve"] == [asdict(reading) for reading in readings]


def test_without_a_pressure_the_designs_own_is_taken_and_the_model_chosen(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[object, ...]] = []

    def evaluate(design: Design, *arguments: object, budget: Budget, keep: bool) -> FakeEvaluation:
        asked.append((design.load.pressure, *arguments[:-1]))
        return FakeEvaluation()

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    for arguments in ((), ("--pressure", "0.03")):
        assert bellows("evaluate", "prototype_1", *arguments)[0] == 0
    assert asked == [(0.1, "auto", None, ()), (0.03, "auto", None, (0.03,))]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--pressure", "-0.05"), (-0.05, (-0.05,))),
        (("--pressure=-0.05",), (-0.05, (-0.05,))),
        (("--pressure", "-0.02:-0.05:-0.02"), (-0.05, (-0.02, -0.04, -0.05))),
        (("--set", "load.pressure=-0.03"), (-0.03, ())),
    ],
)
def test_a_vacuum_is_a_negative_pressure_and_no_option(
    bellows: Bellows,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    expected: tuple[object, ...],
) -> None:
    asked: list[tuple[object, ...]] = []

    def evaluate(design: Design, *given: object, budget: object, keep: bool) -> FakeEvaluation:
        asked.append((design.load.pressure, given[2]))
        return FakeEvaluation()

    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", evaluate)
    assert bellows("evaluate", "prototype_1", *arguments)[0] == 0
    assert asked == [expected]


def test_a_vacuum_stronger_than_the_atmosphere_is_refused(bellows: Bellows) -> None:
    status, _, error = bellows("evaluate", "prototype_1", "--pressure", "-0.2")
    assert status == 2
    assert "load.pressure is -0.2 MPa but must be at least -0.101325 MPa" in error


def test_what_c_code_prints_stays_off_stdout(capfd: pytest.CaptureFixture[str]) -> None:
    with stdout_is_stderr():
        os.write(1, b"from C\n")
        print("from Python")
    print("answer")
    captured = capfd.readouterr()
    assert captured.out == "answer\n"
    assert "from C" in captured.err and "from Python" in captured.err


def test_every_library_gmsh_needs_has_its_package_named() -> None:
    for library, package in PACKAGES.items():
        error = OSError(f"{library}: cannot open shared object file: No such file or directory")
        sentence = missing_library(error)
        assert sentence is not None and library in sentence and package in sentence
    assert missing_library(OSError("disk full")) is None
    assert missing_library(ValueError("libGLU.so.1: cannot open shared object file")) is None


def test_the_readme_installs_what_the_program_asks_for() -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    asked = set(INSTALL.split()[3:])
    line, *_ = [line for line in readme.splitlines() if "apt-get install -y" in line]
    assert asked <= set(line.split())
    assert "pip install -e ." in readme and "'.[test]'" in readme


def test_the_version_is_the_packages() -> None:
    import bellows_design

    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert project["dynamic"] == ["version"]
    assert re.fullmatch(r"\d+\.\d+\.\d+", bellows_design.__version__)


ASSIGNMENTS = st.builds(
    "{}={}".format,
    st.sampled_from(["name", "bubble_width", "indent.depth", "material", "printer", "load"])
    | st.text(max_size=10),
    st.text(max_size=20) | st.floats().map(repr),
)


@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(assignments=st.lists(ASSIGNMENTS, min_size=1, max_size=3), name=st.text(max_size=15))
@pytest.mark.thorough
def test_no_input_leads_to_a_traceback_or_a_file_elsewhere(
    assignments: list[str],
    name: str,
    bellows: Bellows,
    stub_stages: Callable[..., None],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    stub_stages(FakeEvaluation())
    base = tmp_path_factory.mktemp("fuzz")
    output = base / "output"
    output.mkdir()
    sets: list[str] = [part for text in assignments for part in ("--set", text)]
    for design in ("prototype_1", name):
        status, _, err = bellows("run", "--output", str(output), *sets, "--", design)
        assert status in (0, 2) and "Traceback" not in err
    assert [path.name for path in base.iterdir()] == ["output"]
    for folder in output.iterdir():
        assert (folder / "manifest.json").exists()
