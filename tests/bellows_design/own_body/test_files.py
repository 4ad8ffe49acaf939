"""Own bodies as TOML files with STEP files beside them."""

from __future__ import annotations

from pathlib import Path

import pytest
from own_body.bodies import bar, box, part

from bellows_design import DesignError
from bellows_design.own_body import load_body, write_body


@pytest.mark.thorough
def test_a_written_body_is_read_as_it_was(tmp_path: Path) -> None:
    body = bar()
    write_body(body, tmp_path / "mine.toml")
    again = load_body(tmp_path / "mine.toml")
    assert again.table == body.table
    solid, read = body.parts[0].solid, again.parts[0].solid
    assert read.Volume() == pytest.approx(solid.Volume(), rel=1e-9)
    assert sorted(again.face_names[0]) == sorted(body.face_names[0])
    assert again.digest == load_body(tmp_path / "mine.toml").digest


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('step = "mine_body.step"', 'step = "other.step"', "there is no file"),
        ('step = "mine_body.step"', "", "parts.step is none but must be the name of a STEP file"),
        ('step = "mine_body.step"', 'step = "mine_body.step"\nsolid = 1', "from 0 to 0"),
        ('step = "mine_body.step"', 'step = "mine.toml"', "cut short"),
        ('name = "bar"', 'name = "bar', "is not valid TOML"),
    ],
)
def test_a_mistake_in_a_file_gets_a_sentence(
    tmp_path: Path, old: str, new: str, sentence: str
) -> None:
    file = tmp_path / "mine.toml"
    write_body(bar(), file)
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new), "utf-8")
    with pytest.raises(DesignError, match=sentence):
        load_body(file)


def test_a_part_whose_name_leads_elsewhere_is_not_written(tmp_path: Path) -> None:
    body = bar(parts=[part(box(20, 5, 10), "../elsewhere")], pressurised=["tip"],
               surfaces={"root": "<X", "tip": ">X", "middle": "<Y"})  # fmt: skip
    with pytest.raises(DesignError, match="cannot name a file"):
        write_body(body, tmp_path / "mine.toml")
    assert not list(tmp_path.iterdir())
