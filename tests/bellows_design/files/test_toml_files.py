"""Named TOML files: one loader for designs and materials, with the same guards for both."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from importlib.metadata import EntryPoint
from importlib.resources import files
from pathlib import Path

import pytest
from damage import saved, soon
from refusals import refused_in_sentences

from bellows_design.design import load_design
from bellows_design.errors import DesignError
from bellows_design.files import toml_files
from bellows_design.files.toml_files import LARGEST_FILE, MOST_DOTS, TomlLibrary
from bellows_design.materials import load_material, material_names
from bellows_design.materials.library import ENTRY_POINTS

DESIGN = (files("bellows_design.design") / "designs/prototype_2_indent.toml").read_bytes()
MATERIAL = (files("bellows_design.materials") / "ninjaflex.toml").read_bytes()
BASE = b"@BASE@"
"""Stands for a good file of the kind that is read."""

Reader = Callable[[], object]
Kind = tuple[Path, bytes, Reader]


@pytest.fixture(params=["a design by its path", "a material of another package"])
def kind(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Kind:
    """Where a file is looked for, a good one of its kind, and how it is read."""
    if request.param.startswith("a design"):
        path = tmp_path / "fuzzed.toml"
        return path, DESIGN, lambda: load_design(path)
    package = tmp_path / "labmat"
    package.mkdir()
    (package / "__init__.py").touch()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "labmat", raising=False)
    entries = [EntryPoint("lab", name, ENTRY_POINTS) for name in ("labmat", "gone_package")]
    monkeypatch.setattr(toml_files, "entry_points", lambda group: entries)
    return package / "fuzzed.toml", MATERIAL, lambda: load_material("fuzzed")


def sentence_on(content: bytes, kind: Kind) -> str:
    """The one sentence with which a file of that content is refused."""
    path, good, read = kind
    path.write_bytes(content.replace(BASE, good))
    with soon(), pytest.raises(DesignError) as caught:
        read()
    (sentence,) = caught.value.sentences
    return sentence


@pytest.mark.parametrize(
    ("content", "words"),
    [
        pytest.param(b"\xff\xfe", "is not a text file in UTF-8.", id="another encoding"),
        pytest.param(b"mu = ", "is not valid TOML: ", id="cut short"),
        pytest.param(b"mu = [1]\nmu = [2]", "is not valid TOML: ", id="a key twice"),
        pytest.param(b"x = " + b"[" * 100_000, "it is nested too deeply.", id="nested"),
        pytest.param(b"x = " + b"1" * 5000, "is not valid TOML: ", id="a huge integer"),
        pytest.param(b"#" * (LARGEST_FILE + 1), "is larger than 1 MB.", id="large"),
        pytest.param(
            b"a." * MOST_DOTS + b"a.a = 1", "a line has more than 100 dots.", id="many dots"
        ),
    ],
)
def test_a_broken_file_is_named_in_one_sentence(content: bytes, words: str, kind: Kind) -> None:
    sentence = sentence_on(content, kind)
    assert "fuzzed" in sentence and words in sentence and sentence.endswith(".")


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
def test_a_file_made_to_harm_is_refused_soon(content: bytes, kind: Kind) -> None:
    path, good, read = kind
    path.write_bytes(content.replace(BASE, good))
    assert refused_in_sentences(read)


def test_a_decimal_comma_is_answered_with_line_column_and_the_decimal_point() -> None:
    path = Path(__file__).parents[1] / "data/decimal_comma.toml"
    with pytest.raises(DesignError) as caught:
        load_design(path)
    told = str(caught.value)
    assert told.endswith("write 1.2, not 1,2.") and "…" not in told
    assert re.search(r"at line 6, column \d+: expected newline or end of document", told)


def test_a_byte_order_mark_is_no_part_of_a_file(kind: Kind) -> None:
    path, good, read = kind
    path.write_bytes(good)
    plain = read()
    path.write_bytes(b"\xef\xbb\xbf" + good)
    assert read() == plain


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX")
@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: os.symlink("/dev/zero", path)])
def test_what_is_no_regular_file_is_neither_waited_for_nor_read(
    make: Callable[[Path], None], kind: Kind
) -> None:
    path, _, read = kind
    make(path)
    assert refused_in_sentences(read)


def test_the_shipped_file_wins_over_one_of_the_same_name_and_a_package_that_is_gone_has_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "labmat2").mkdir()
    (tmp_path / "labmat2/__init__.py").touch()
    for name in ("ninjaflex", "foam"):
        content = MATERIAL.replace(b'name = "ninjaflex"', b'name = "of the lab"')
        saved(tmp_path / "labmat2", content, f"{name}.toml")
    monkeypatch.syspath_prepend(tmp_path)
    entries = [EntryPoint("lab", name, ENTRY_POINTS) for name in ("gone_package", "labmat2")]
    monkeypatch.setattr(toml_files, "entry_points", lambda group: entries)
    assert load_material("ninjaflex").name == "ninjaflex"
    assert load_material("foam").name == "of the lab"
    assert {"ninjaflex", "foam"} <= set(material_names())


def test_a_file_in_the_folder_is_found_by_its_name_only_as_a_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A shipped name means the shipped file; a ``Path`` always means a file."""
    library = TomlLibrary("design", "bellows_design.design", folder="designs")
    monkeypatch.chdir(tmp_path)
    saved(tmp_path, b"mine = 1", "finger")
    saved(tmp_path, b"mine = 1", "other")
    assert library.named_or_at("finger")["name"] == "finger"
    assert library.named_or_at(Path("finger")) == library.named_or_at("other") == {"mine": 1}
    with pytest.raises(DesignError, match="unknown design “fingr”; did you mean finger"):
        library.named_or_at("fingr")
    with pytest.raises(DesignError, match="there is no file “prototype_1”"):
        library.named_or_at(Path("prototype_1"))
