"""Which slicer is found, and which is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from printers.errors import PrintersError
from printers.slicing.finding import NAMES, VARIABLE, find_slicer, required_slicer


def test_the_variable_names_the_slicer(program: Callable[..., Path]) -> None:
    path = program("")
    slicer = find_slicer({VARIABLE: str(path), "PATH": ""})
    assert slicer is not None
    assert (slicer.path, slicer.name, slicer.version) == (path, "PrusaSlicer", "2.5.0")


def test_an_empty_variable_hides_the_slicer_on_the_path(program: Callable[..., Path]) -> None:
    folder = program("").rename(program("").with_name(NAMES[0])).parent
    assert find_slicer({"PATH": f"{folder}:/bin"}) is not None
    assert find_slicer({"PATH": f"{folder}:/bin", VARIABLE: ""}) is None
    assert find_slicer({"PATH": f"{folder}:/bin", VARIABLE: " "}) is None


def test_tests_that_are_not_marked_see_no_slicer() -> None:
    assert find_slicer() is None


def test_where_there_is_none_the_sentence_says_how_to_get_one(tmp_path: Path) -> None:
    assert find_slicer({"PATH": str(tmp_path)}) is None
    with pytest.raises(PrintersError, match=r"install PrusaSlicer .*prusa-slicer.*BELLOWS_SLICER"):
        required_slicer({"PATH": str(tmp_path)})


def test_a_variable_that_names_no_program_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "text").write_text("no program")
    for name in (tmp_path / "none", tmp_path / "text", tmp_path):
        with pytest.raises(PrintersError, match=r"BELLOWS_SLICER names .* which is no program"):
            find_slicer({VARIABLE: str(name), "PATH": ""})


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ("echo 'PrusaSlicer-2.4.2+linux based on Slic3r'", "is PrusaSlicer 2.4.2; it must be 2.5"),
        ("echo 'PrusaSlicer-1.99 based on Slic3r'", "is PrusaSlicer 1.99; it must be 2.5"),
        ("echo 'OrcaSlicer-2.3.0:'", "does not say that it is PrusaSlicer"),
        ("echo 'SuperSlicer-2.5.59 based on Slic3r'", "does not say that it is PrusaSlicer"),
        ("exit 3", "does not say that it is PrusaSlicer"),
    ],
)
def test_a_program_that_does_not_know_our_settings_is_refused(
    program: Callable[..., Path], answer: str, message: str
) -> None:
    with pytest.raises(PrintersError, match=message):
        find_slicer({VARIABLE: str(program("", answer)), "PATH": ""})


@pytest.mark.parametrize("version", ["2.5.0", "2.9.2", "2.10", "3"])
def test_newer_versions_are_taken(program: Callable[..., Path], version: str) -> None:
    path = program("", f"echo 'PrusaSlicer-{version}+arm64 based on Slic3r'")
    slicer = find_slicer({VARIABLE: str(path), "PATH": ""})
    assert slicer is not None and slicer.version == version
