"""Whatever is put in, a sentence comes out: no other error, no hang, no file outside the folder."""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from damage import BAD_VALUES, FUZZ, mutated, saved, soon
from fakes import FakeEvaluation, fake_report
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused_in_sentences

from bellows_design import pipeline
from bellows_design.approval import decide
from bellows_design.cli.pressures import MOST, parse_pressures
from bellows_design.design.design import Design
from bellows_design.design.overrides import known_keys, with_overrides
from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.export.approved import export_approved, require_place, withdraw
from bellows_design.export.formats import Part
from bellows_design.materials.measurements.loading import load_measurements

DESIGNS = Path(__file__).parents[2] / "bellows_design/design/designs"
CSV = b"mode,stretch,stress_mpa\n" + b"".join(
    b"uniaxial,%g,%g\n" % (1 + 0.1 * i, 0.2 * i) for i in range(1, 9)
)
PROTOTYPE = load_design("prototype_1")
BAD_NAMES = [
    *("../x", "../../x", "a/b", "/tmp/x", "/", ".", "..", "", "-x", "~", "~/x", "..\\x", "c:x"),
    *("con", "NUL", "aux", "lpt1", "x" * 65, "x" * 5000, "a\0b", "a\nb", "x.", ".x", "\u202ex"),
]


@pytest.mark.parametrize("name", shipped_designs())
def test_a_damaged_design_file_is_read_or_refused_in_sentences(tmp_path: Path, name: str) -> None:
    chance = random.Random(f"damaged {name}")
    original = (DESIGNS / f"{name}.toml").read_bytes()
    refused = 0
    for _ in range(100):
        path = saved(tmp_path, mutated(original, chance))
        refused += refused_in_sentences(lambda path=path: load_design(path))  # type: ignore[misc]
    assert refused > 30


def test_a_byte_order_mark_is_no_part_of_a_table(tmp_path: Path) -> None:
    marked, plain = (
        load_measurements(saved(tmp_path, content, "it.csv"))
        for content in (b"\xef\xbb\xbf" + CSV, CSV)
    )
    assert (marked.stretch == plain.stretch).all() and (marked.stress == plain.stress).all()


def test_a_pipe_in_the_place_of_a_file_is_not_waited_for(tmp_path: Path) -> None:
    for name in ("pipe.toml", "manifest.json"):
        os.mkfifo(tmp_path / name)
    assert refused_in_sentences(lambda: load_measurements(tmp_path / "pipe.toml"))
    assert refused_in_sentences(lambda: require_place(tmp_path.name, tmp_path.parent))


def test_a_description_of_many_dots_survives_being_written_and_read() -> None:
    design = with_overrides(PROTOTYPE, ["description=" + ". ' " * 400])
    assert Design.from_toml(design.to_toml()) == design


@FUZZ
@given(name=st.text(max_size=300) | st.sampled_from(BAD_NAMES))
def test_any_path_is_a_design_or_refused_in_sentences(name: str) -> None:
    refused_in_sentences(lambda: load_design(name))


@FUZZ
@given(content=st.binary(max_size=300))
def test_any_bytes_are_refused_as_a_design(tmp_path: Path, content: bytes) -> None:
    path = saved(tmp_path, content)
    assert refused_in_sentences(lambda: load_design(path))


def assignments() -> st.SearchStrategy[str]:
    """Assignments that are nearly right: known keys, values of any kind."""
    values = (
        st.sampled_from(BAD_VALUES + BAD_NAMES)
        | st.text(max_size=30)
        | st.floats().map(repr)
        | st.integers().map(str)
    )
    keys = st.sampled_from(known_keys()) | st.text(max_size=20)
    return st.builds("{}={}".format, keys, values) | st.text(max_size=40)


@FUZZ
@given(st.lists(assignments(), min_size=1, max_size=3))
def test_any_assignment_changes_the_design_or_is_refused(texts: list[str]) -> None:
    refused_in_sentences(lambda: with_overrides(PROTOTYPE, texts))


@pytest.mark.parametrize("value", BAD_VALUES, ids=lambda value: value[:12].encode("unicode_escape"))
def test_no_known_key_takes_a_bad_value_but_in_sentences(value: str) -> None:
    for key in known_keys():
        refused_in_sentences(lambda key=key: with_overrides(PROTOTYPE, [f"{key}={value}"]))  # type: ignore[misc]


def pressure_texts() -> st.SearchStrategy[str]:
    numbers = st.floats().map(repr) | st.sampled_from(["1e999", "nan", "", "5e-324", "1_0", "٣"])
    return st.lists(numbers, min_size=1, max_size=4).map(":".join) | st.text(max_size=40)


@FUZZ
@given(pressure_texts())
def test_any_pressure_is_a_short_rising_list_or_refused(text: str) -> None:
    result: list[float] = []
    if not refused_in_sentences(lambda: result.extend(parse_pressures(text))):
        assert 0 < len(result) <= MOST + 1
        assert result == sorted(result)


@pytest.mark.parametrize("text", ["1" * 100_000, "1:" * 100_000, ":" * 100_000, "1:1:1e-320", "\0"])
def test_a_pressure_made_to_harm_is_refused_soon(text: str) -> None:
    assert refused_in_sentences(lambda: parse_pressures(text)) or text == "1:1:1e-320"


@pytest.fixture
def light_stages(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every design is computed at once, and refused."""
    answer = FakeEvaluation(converged=False)
    monkeypatch.setattr("bellows_design.analysis.evaluate.evaluate", lambda *_, **__: answer)
    monkeypatch.setattr(pipeline, "build_part", _bodiless)
    monkeypatch.setattr(pipeline, "check", lambda *_: fake_report())


def _bodiless(design: Design) -> Part:
    body: Any = None
    return Part(design.name, design.description, design.digest, body, body)


def files_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def attempts(name: str, place: Path) -> Iterable[Callable[[], object]]:
    """All the ways in which a design or part of this name could write or remove files."""
    unchecked = PROTOTYPE.model_copy(update={"name": name})
    verdict = decide(PROTOTYPE, fake_report(), FakeEvaluation())  # type: ignore[arg-type]
    return (
        lambda: pipeline.run(with_overrides(PROTOTYPE, [f"name={name}"]), place),
        lambda: pipeline.run(unchecked, place),
        lambda: require_place(name, place),
        lambda: withdraw(name, place),
        lambda: export_approved(_bodiless(unchecked), verdict, {}, place),
    )


@pytest.mark.parametrize(
    "name", [name for name in BAD_NAMES if "/" in name or name in ("", ".", "..", "a\0b")]
)
def test_no_name_leads_out_of_the_output_folder(
    name: str, tmp_path: Path, light_stages: None
) -> None:
    place = tmp_path / "room" / "exports"
    place.mkdir(parents=True)
    (tmp_path / "room" / "x").mkdir()
    saved(tmp_path / "room" / "x", b'{"format": "bellows-design manifest 1"}', "manifest.json")
    before = files_in(tmp_path)
    for attempt in attempts(name, place):
        assert refused_in_sentences(attempt)
    assert files_in(tmp_path) == before


@FUZZ
@given(name=st.text(max_size=12) | st.from_regex(r"[A-Za-z_.~/-]{1,6}", fullmatch=True))
def test_every_name_stays_within_the_output_folder(
    name: str, tmp_path: Path, light_stages: None
) -> None:
    with suppress(DesignError):
        pipeline.run(with_overrides(PROTOTYPE, [f"name={name}"]), tmp_path / "exports")
    assert files_in(tmp_path) <= {"exports"}


@pytest.mark.parametrize(
    "manifest",
    [
        *(b"[" * 100_000, b'{"a":' * 50_000, b"\xff", b"", b"null", b"[]", b"1" * 5000),
        b'{"format": "bellows-design manifest 1", "files": {"../x": 1, "/etc/passwd": 1, "..": 1}}',
        b'{"format": "bellows-design manifest 1", "files": {"\\u0000": 1, "\\ud800": 1, "": 1}}',
        b'{"format": "bellows-design manifest 1", "files": [[1]]}',
    ],
    ids=range(10),
)
def test_a_manifest_made_to_harm_removes_nothing_outside(tmp_path: Path, manifest: bytes) -> None:
    saved(tmp_path, b"precious", "x")
    (tmp_path / "part").mkdir()
    saved(tmp_path / "part", manifest, "manifest.json")
    with soon(), suppress(DesignError):
        require_place("part", tmp_path)
    withdraw("part", tmp_path)
    assert (tmp_path / "x").read_bytes() == b"precious"


HOSTILE = [
    ["check", "../x.toml"],
    ["check", "prototype_1", "--printer", "a\0b.toml"],
    ["check", "prototype_1", "--printer", "x" * 5000 + ".toml"],
    ["run", "prototype_1", "--set", "bubble_width=0x" + "f" * 5000],
    ["run", "prototype_1", "--set", "bubble_width={" + "a." * 50_000 + "a=1}"],
    ["run", "prototype_1", "--set", "bubble_width=" + "[" * 50_000],
    ["run", "prototype_1", "--set", "name=/tmp/x"],
    ["run", "prototype_1", "--set", "printer=../x"],
    ["evaluate", "prototype_1", "--pressure", "1e999"],
    ["evaluate", "prototype_1", "--memory", "nan"],
    ["run", "prototype_1", "--memory", "-1"],
    ["evaluate", "prototype_1", "--memory", "1e999"],
    ["evaluate", "prototype_1", "--mesh-seconds", "0"],
    ["benchmark", "prototype_1", "--mesh-seconds", "nan"],
    ["evaluate", "prototype_1", "--pressure", "0.01:0.1:1e-300"],
    ["fit", "."],
    ["fit", "x" * 5000],
]


@pytest.mark.parametrize("arguments", HOSTILE, ids=lambda arguments: " ".join(arguments)[:40])
def test_the_command_answers_bad_input_with_one_sentence_and_status_2(
    arguments: list[str],
    bellows: Callable[..., tuple[int, str, str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    with soon():
        status, out, err = bellows(*arguments)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1 and "Traceback" not in err
    assert files_in(tmp_path) == set()
