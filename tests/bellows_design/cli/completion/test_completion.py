"""Completion: of what, without what, and in a real bash."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from bellows_design.cli.completion import names
from bellows_design.cli.completion.settings import described_keys, records_described, settings
from bellows_design.design.scenes.scene import BUILT_IN
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.materials import material_names
from printers import available_filaments, available_profiles

ROOT = Path(__file__).parents[4]
PROGRAM = "import sys; sys.argv = ['bellows']; from bellows_design.__main__ import main; main()"
HEAVY = ("cadquery", "gmsh", "numba", "numpy", "scipy", "trimesh", "vtkmodules", "OCP", "psutil")


@pytest.fixture
def completed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], subprocess.CompletedProcess[str]]:
    """Call it with a line: what the command answers bash, which stands at its end."""
    monkeypatch.chdir(tmp_path)

    def call(line: str, program: str = PROGRAM) -> subprocess.CompletedProcess[str]:
        words = line.split(" ")
        environment = {
            **os.environ,
            "PYTHONPATH": str(ROOT),
            "_BELLOWS_COMPLETE": "complete_bash",
            "COMP_WORDS": "\n".join(words),
            "COMP_CWORD": str(len(words) - 1),
        }
        return subprocess.run(
            [sys.executable, "-c", program], capture_output=True, encoding="utf-8", env=environment
        )

    return call


def words(text: str) -> list[str]:
    return text.split("\n")[:-1] if text.strip() else []


def test_names_are_those_that_the_libraries_know() -> None:
    assert [name for name, _ in names.designs("")][: len(shipped_designs())] == sorted(
        shipped_designs()
    )
    assert sorted(names.materials()) == sorted(material_names())
    for complete, known in (
        (names.printers, available_profiles()),
        (names.filaments, available_filaments()),
    ):
        assert {name for name, about in complete("") if about != "a file"} == set(known)
    assert set(names.BUILT_IN_SCENES) == set(BUILT_IN)


def test_keys_are_described_as_the_records_do() -> None:
    """After a change: ``python -m bellows_design.cli.completion.settings``."""
    assert described_keys() == records_described()


def test_a_key_comes_with_the_value_that_the_design_has() -> None:
    found = [word for word, _ in settings("finger", "bubble_w")]
    assert found == [f"bubble_width={load_design('finger').bellows.bubble_width:g}"]
    assert [word for word, _ in settings("finger", "indent.side")] == ["indent.side=outside"]
    assert "material=ninjaflex" in [word for word, _ in settings("", "material=nin")]
    assert ("printer=prusa_mk4", "") in settings("", "printer=prusa_mk")


def test_files_are_completed_where_the_word_points(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "deep" / "er").mkdir(parents=True)
    for name in ("mine.toml", "deep/other.toml", "deep/er/last.toml", "part.STL", ".hidden.toml"):
        (tmp_path / name).write_text("")
    files = [name for name, about in names.designs("") if about == "a file"]
    assert files == ["mine.toml", "deep/other.toml"]
    assert [name for name, _ in names.designs("deep/")] == ["deep/other.toml", "deep/er/last.toml"]
    assert [name for name, _ in names.designs("./m")] == ["./mine.toml"]
    assert [name for name, _ in names.designs_and_parts("p") if name.endswith("STL")]
    assert names.designs(str(tmp_path / "mi")) == [(str(tmp_path / "mine.toml"), "a file")]


def test_scenes_of_the_design_are_completed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text("[scenes.desk]\nkind = 'blocked'\n")
    found = [name for name, _ in names.scenes("mine.toml", "")]
    assert found == ["blocked", "free", "desk", "mine.toml"]


def test_what_goes_wrong_is_no_completion(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.toml").write_text("= [")
    assert [name for name, _ in names.scenes("broken.toml", "b")] == ["blocked", "broken.toml"]
    assert names.designs("\0") == [] and names.designs("/no/such/place/") == []


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("bellows eva", ["evaluate"]),
        ("bellows study sw", ["sweep"]),
        ("bellows evaluate fing", ["finger"]),
        ("bellows evaluate finger --pres", ["--pressure"]),
        ("bellows evaluate finger --set tendon_w", ["tendon_width=6"]),
        ("bellows evaluate finger --model un", ["unit-cell"]),
        ("bellows check finger --printer prusa_mk", ["prusa_mk4"]),
        ("bellows check finger --filament cheet", ["cheetah_95a"]),
        ("bellows force finger --scene blo", ["blocked"]),
        ("bellows init mat", ["material"]),
        ("bellows init printer x.toml --from prusa_mi", ["prusa_mini"]),
        ("bellows list desi", ["designs"]),
        ("bellows schema manif", ["manifest.json"]),
    ],
)
def test_the_command_completes(
    line: str, expected: list[str], completed: Callable[..., subprocess.CompletedProcess[str]]
) -> None:
    done = completed(line)
    assert done.returncode == 0 and done.stderr == "" and words(done.stdout) == expected


def test_completion_loads_nothing_heavy(
    completed: Callable[..., subprocess.CompletedProcess[str]],
) -> None:
    check = (
        f"import atexit, sys; atexit.register(lambda: print(set(sys.modules) & set({HEAVY!r})));"
    )
    done = completed("bellows evaluate finger --set bubble_w", check + PROGRAM)
    assert words(done.stdout)[-1] == "set()" and "bubble_width=20" in done.stdout


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash here")
def test_a_real_bash_completes(tmp_path: Path) -> None:
    """The script that is installed, run by bash as its Tab key does."""
    program = tmp_path / "bin" / "bellows"
    program.parent.mkdir()
    program.write_text(
        f"#!{sys.executable}\nfrom bellows_design.__main__ import main\nmain()\n", "utf-8"
    )
    program.chmod(0o755)
    path = f"{program.parent}:{os.environ['PATH']}"
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PATH": path, "HOME": str(tmp_path)}
    environment["_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION"] = "1"
    made = subprocess.run(
        ["bellows", "--show-completion", "bash"],
        capture_output=True, encoding="utf-8", env=environment, cwd=tmp_path,
    )  # fmt: skip
    assert made.returncode == 0 and "complete -o default -F" in made.stdout, made.stderr
    function = made.stdout.split("()")[0].strip()
    typed = f"""{made.stdout}
    COMP_WORDS=(bellows evaluate prototype_2_); COMP_CWORD=2
    {function} bellows prototype_2_ evaluate
    printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    done = subprocess.run(
        ["bash", "--norc", "-c", typed],
        capture_output=True, encoding="utf-8", env=environment, cwd=tmp_path,
    )  # fmt: skip
    assert done.stdout == "prototype_2_indent\n", done.stderr
