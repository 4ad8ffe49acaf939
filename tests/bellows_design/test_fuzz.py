"""Whatever is put in, a sentence comes out: no other error, no hang, no file outside the folder."""

from __future__ import annotations

import math
import os
import random
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fakes import FakeEvaluation, fake_report
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bellows_design import pipeline
from bellows_design.approval import decide
from bellows_design.design import Design, load_design, shipped_designs
from bellows_design.errors import DesignError
from bellows_design.export import export_approved, require_place, withdraw
from bellows_design.fitting import Choice, fit
from bellows_design.formats import Part
from bellows_design.measurements import load_measurements, parse_measurements
from bellows_design.overrides import known_keys, with_overrides
from bellows_design.pressures import MOST, parse_pressures

FUZZ = settings(
    derandomize=True,
    deadline=None,
    max_examples=100,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
SECONDS = 5.0
"""Of computing, for one input; a hang takes minutes."""

LONGEST_SENTENCE = 1000
DESIGNS = Path(__file__).parents[2] / "bellows_design" / "designs"
MATERIALS = DESIGNS.parent / "materials"
BASE = (DESIGNS / "prototype_2_indent.toml").read_bytes()
CSV = b"mode,stretch,stress_mpa\n" + b"".join(
    b"uniaxial,%g,%g\n" % (1 + 0.1 * i, 0.2 * i) for i in range(1, 9)
)
PROTOTYPE = load_design("prototype_1")
BAD_NAMES = [
    *("../x", "../../x", "a/b", "/tmp/x", "/", ".", "..", "", "-x", "~", "~/x", "..\\x", "c:x"),
    *("con", "NUL", "aux", "lpt1", "x" * 65, "x" * 5000, "a\0b", "a\nb", "x.", ".x", "\u202ex"),
]
BAD_VALUES = [
    *("1e999", "-1e999", "nan", "-inf", "1e-999", "-0.0", "0x" + "f" * 5000, "1" * 5000, "1" * 400),
    *(
        "true",
        '""',
        '"\\u0000"',
        "[]",
        "[[[[1]]]]",
        "{}",
        "{a = {a = 1}}",
        "1979-05-27",
        "07:32:00",
    ),
    *("[" * 10_000, "[" * 50 + "]" * 50, "{" + "a." * 60_000 + "a = 1}", "'" + "x" * 90_000 + "'"),
    *(
        "[0x" + "f" * 5000 + "]",
        "",
        "=",
        "'",
        '"""',
        "\ud800",
        "\0",
        "none",
        "None",
        "1\nname = 'x'",
    ),
]


@contextmanager
def soon() -> Iterator[None]:
    """Fails if the block takes longer than any input should."""
    start = time.process_time()
    yield
    assert time.process_time() - start < SECONDS


def refused_in_sentences(read: Callable[[], object]) -> bool:
    """True if ``read`` refused as documented; any error but ``DesignError`` goes through."""
    with soon():
        try:
            read()
        except DesignError as error:
            assert 0 < len(error.sentences) <= 21
            assert str(error).split("\n") == list(error.sentences)
            assert all(0 < len(line) < LONGEST_SENTENCE for line in error.sentences)
            assert all(line.isprintable() for line in error.sentences)
            return True
    return False


def saved(folder: Path, content: bytes, name: str = "fuzzed.toml") -> Path:
    path = folder / name
    path.write_bytes(content)
    return path


def mutated(content: bytes, chance: random.Random) -> bytes:
    """``content`` with one or several of the damages that happen to files, or are done to them."""
    for _ in range(chance.randint(1, 3)):
        content = chance.choice(DAMAGES)(content, chance)
    return content


def _cut_short(content: bytes, chance: random.Random) -> bytes:
    return content[: chance.randrange(len(content) + 1)]


def _flipped(content: bytes, chance: random.Random) -> bytes:
    flipped = bytearray(content)
    for _ in range(min(len(flipped), chance.randint(1, 8))):
        flipped[chance.randrange(len(flipped))] ^= 1 << chance.randrange(8)
    return bytes(flipped)


def _line_replaced(content: bytes, chance: random.Random) -> bytes:
    lines = content.split(b"\n")
    at = chance.randrange(len(lines))
    key = lines[at].partition(b"=")[0]
    lines[at] = key + b"= " + chance.choice(BAD_VALUES).encode("utf-8", "surrogatepass")
    return b"\n".join(lines)


def _line_doubled(content: bytes, chance: random.Random) -> bytes:
    lines = content.split(b"\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    return b"\n".join(lines)


def _spliced(content: bytes, chance: random.Random) -> bytes:
    at = chance.randrange(len(content) + 1)
    pieces = (
        b"\0",
        b"\xff",
        b"\xef\xbb\xbf",
        b"\r",
        b'"',
        b"[",
        b"]]",
        b"\n[bellows]\n",
        b"\x1b[2J",
    )
    return content[:at] + chance.choice(pieces) + content[at:]


def _differently_encoded(content: bytes, chance: random.Random) -> bytes:
    text = content.decode("utf-8", "replace")
    return text.encode(chance.choice(["utf-16", "utf-32", "utf-8-sig", "cp1250"]), "replace")


DAMAGES: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    _cut_short,
    _flipped,
    _line_replaced,
    _line_doubled,
    _spliced,
    _differently_encoded,
)


@pytest.mark.parametrize("name", shipped_designs())
def test_a_damaged_design_file_is_read_or_refused_in_sentences(tmp_path: Path, name: str) -> None:
    chance = random.Random(f"damaged {name}")
    original = (DESIGNS / f"{name}.toml").read_bytes()
    refused = 0
    for _ in range(100):
        path = saved(tmp_path, mutated(original, chance))
        refused += refused_in_sentences(lambda path=path: load_design(path))  # type: ignore[misc]
    assert refused > 30


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(b"self = 1\n" + BASE, id="a key that Python uses itself"),
        pytest.param(BASE + b"self = 1\ncls = 2\n", id="such a key in a table"),
        pytest.param(b"".join(b"k%d=1\n" % i for i in range(100_000)), id="100 000 keys"),
        pytest.param(b"".join(b"[t%d]\n" % i for i in range(100_000)), id="100 000 tables"),
        pytest.param(b"[[a]]\n" * 150_000, id="a long array of tables"),
        pytest.param(b"a." * 400_000 + b"a = 1\n", id="a key of 400 000 parts"),
        pytest.param(b'"a".' * 200_000 + b"a = 1\n", id="a quoted key of many parts"),
        pytest.param(b"[" + b"a." * 400_000 + b"a]\n", id="a table of 400 000 parts"),
        pytest.param(b'x = ["""\n""", {' + b"a." * 400_000 + b"a=1}]", id="hidden in quotes"),
        pytest.param(b"x = " + b"[" * 900_000, id="nested arrays"),
        pytest.param(b"x = " + b"{a=" * 200_000, id="nested tables"),
        pytest.param(b'x = "' + b'\\"' * 400_000, id="a string without end"),
        pytest.param(b"x = '''" + b"'\n" * 400_000, id="a text without end"),
        pytest.param(b"k" * 900_000 + b" = 1\n" + BASE, id="a key of a million letters"),
        pytest.param(b"\n" * 999_999, id="empty lines"),
        pytest.param(b"\xef\xbb\xbf" * 2 + BASE, id="two byte order marks"),
        pytest.param(b"\0" * 1000, id="null bytes"),
        pytest.param(BASE + b"\0", id="a null byte"),
        pytest.param(BASE + BASE, id="everything twice"),
    ],
)
def test_a_design_file_made_to_harm_is_refused_soon(tmp_path: Path, content: bytes) -> None:
    path = saved(tmp_path, content)
    assert refused_in_sentences(lambda: load_design(path))


def test_a_byte_order_mark_is_no_part_of_a_design_or_a_table(tmp_path: Path) -> None:
    mark = b"\xef\xbb\xbf"
    assert load_design(saved(tmp_path, mark + BASE)) == load_design("prototype_2_indent")
    marked, plain = (
        load_measurements(saved(tmp_path, content, "it.csv")) for content in (mark + CSV, CSV)
    )
    assert (marked.stretch == plain.stretch).all() and (marked.stress == plain.stress).all()


def test_a_pipe_in_the_place_of_a_file_is_not_waited_for(tmp_path: Path) -> None:
    for name in ("pipe.toml", "manifest.json"):
        os.mkfifo(tmp_path / name)
    assert refused_in_sentences(lambda: load_design(tmp_path / "pipe.toml"))
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


@pytest.mark.parametrize("key", ["mu", "alpha", "yield_strength", "name", "source", "model", "new"])
def test_a_material_of_bad_values_is_refused_in_sentences(key: str) -> None:
    table = BASE.decode().replace('material = "ninjaflex"\n', "")
    fields = {"name": '"m"', "mu": "[1.0]", "alpha": "[2.0]", "yield_strength": "4"}
    for value in [*BAD_VALUES, "[1e999]", "[nan]", "[1.0, 2.0]", "[1e308, 1e308]", "[0]", "['1']"]:
        lines = [f"{name} = {text}" for name, text in (fields | {key: value}).items()]
        text = table + "\n[material]\n" + "\n".join(lines)
        refused_in_sentences(lambda text=text: Design.from_toml(text))  # type: ignore[misc]


def test_a_damaged_table_of_measurements_is_read_or_refused(tmp_path: Path) -> None:
    chance = random.Random("measurements")
    for _ in range(300):
        path = saved(tmp_path, mutated(CSV, chance), "fuzzed.csv")
        refused_in_sentences(lambda path=path: load_measurements(path))  # type: ignore[misc]


def test_a_damaged_material_is_taken_or_refused_in_sentences() -> None:
    """Material files of the library as a table of a design, damaged."""
    table = BASE.decode().replace('material = "ninjaflex"\n', "").encode() + b"\n[material]\n"
    chance = random.Random("materials")
    for path in sorted(MATERIALS.glob("*.toml")) * 12:
        content = table + mutated(path.read_bytes(), chance)
        refused_in_sentences(lambda text=content: Design.from_toml(text.decode("utf-8", "replace")))  # type: ignore[misc]


def tables() -> st.SearchStrategy[str]:
    """Tables that are nearly measurements: some can be fitted."""
    stretches = st.floats(0.04, 21) | st.sampled_from([1.0, 1.1, 1.2, 2.0, 5e-324, 1 + 1e-15])
    stresses = st.floats(-3, 1001) | st.sampled_from([0.0, -0.0, 1e-300, 0.1, 0.5, 1.0])
    modes = st.sampled_from(["uniaxial", "biaxial", "planar"])
    rows = st.lists(st.tuples(modes, stretches, stresses), min_size=4, max_size=12)
    return rows.map(
        lambda each: (
            "mode,stretch,stress_mpa\n"
            + "".join(f"{mode},{x:.17f},{y:.17f}\n" for mode, x, y in each)
        )
    )


@settings(FUZZ, max_examples=30)
@given(text=tables())
def test_any_table_is_fitted_or_refused_in_sentences(text: str) -> None:
    found: list[Choice] = []
    if not refused_in_sentences(
        lambda: found.append(fit(parse_measurements(text, "it"), "ogden1"))
    ):
        constants = (*found[0].fit.mu, *found[0].fit.alpha)
        assert all(math.isfinite(constant) for constant in constants)


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("h" * 5_000_000, id="a long column"),
        pytest.param("," * 1_000_000, id="many columns"),
        pytest.param("stretch,stress_mpa\n" + "1.1,0.1\n" * 100_001, id="many rows"),
        pytest.param("stretch,stress_mpa\n" + "1" * 1_000_000 + ",1\n", id="a long number"),
        pytest.param("stretch,stress_mpa\n" + "1e999,1\n" * 9, id="infinite"),
        pytest.param("stretch,stress_mpa\n" + "nan,nan\n" * 9, id="no numbers"),
        pytest.param("\n" * 1_000_000, id="empty lines"),
        pytest.param("stretch,stretch,stress_mpa\n", id="a column twice"),
    ],
)
def test_a_table_made_to_harm_is_refused_soon(text: str) -> None:
    assert refused_in_sentences(lambda: parse_measurements(text, "it"))


@FUZZ
@given(st.text(max_size=300))
def test_any_text_is_refused_as_measurements(text: str) -> None:
    assert refused_in_sentences(lambda: parse_measurements(text, "it"))


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
    fake = SimpleNamespace(evaluate=lambda *_, **__: FakeEvaluation(converged=False), refined=None)
    monkeypatch.setitem(sys.modules, "bellows_design.evaluation", fake)  # type: ignore[arg-type]
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
