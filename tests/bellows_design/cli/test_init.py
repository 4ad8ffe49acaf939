"""``bellows init``: files to start from, generated from the records and loaded again."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from pydantic.fields import FieldInfo

from bellows_design.cli.starting.kinds import Kind
from bellows_design.cli.starting.templates import name_from, template
from bellows_design.design import (
    BellowsParameters,
    Design,
    Fingertip,
    Indent,
    Limits,
    Load,
    Mount,
    Port,
    load_design,
)
from bellows_design.materials.library import material_at
from bellows_design.materials.material import Material
from bellows_design.own_body import (
    BodyLoad,
    BodyMesh,
    BodyPart,
    BodySupports,
    Film,
    Gravity,
    Obstacle,
    OwnBody,
    Selection,
    Tip,
)
from printers import Filament, PrinterProfile, SlicerAdvice, load_profile, profile_from_table

Bellows = Callable[..., tuple[int, str, str]]
RECORDS = {
    Kind.DESIGN: (Design, BellowsParameters, Indent, Port, Mount, Fingertip, Load, Limits),
    Kind.PRINTER: (PrinterProfile, SlicerAdvice, Filament),
    Kind.MATERIAL: (Material,),
    Kind.BODY: (
        OwnBody,
        BodyPart,
        Selection,
        BodySupports,
        BodyLoad,
        Film,
        Gravity,
        Obstacle,
        Tip,
        BodyMesh,
    ),
}


def with_options(text: str) -> str:
    """The file with every optional key and table that is commented out taken in."""
    lines = (
        line[2:] if line.startswith("# ") and (" = " in line or line[2] == "[") else line
        for line in template_of(text)
    )
    return "\n".join(lines)


def template_of(text: str) -> list[str]:
    return [line for line in text.split("\n") if '"FILE"' not in line]


@pytest.mark.parametrize("kind", list(Kind))
def test_every_field_stands_there_with_a_comment(kind: Kind) -> None:
    lines = template(kind, "mine").split("\n")
    for record in RECORDS[kind]:
        for name, field in record.model_fields.items():
            found = [
                n
                for n, line in enumerate(lines)
                if line.removeprefix("# ").startswith(f"{name} = ")
            ]
            if not found:
                assert any(line.endswith((f"[{name}]", f"[{name}]]")) for line in lines), name
                continue
            comments = [lines[n - 1] for n in found]  # tables may have a key in common
            assert any(says_all(comment, field) for comment in comments), name


def says_all(comment: str, field: FieldInfo) -> bool:
    """Whether the comment says more than nothing, with unit and bounds."""
    extra = field.json_schema_extra
    unit = str(extra["unit"]) if isinstance(extra, dict) else ""
    bounds = [getattr(rule, key, None) for rule in field.metadata for key in ("ge", "le")]
    stated = [f"{bound:g}" in comment for bound in bounds if bound is not None]
    return comment.startswith("# ") and len(comment) > 4 and unit in comment and all(stated)


def test_the_files_are_loaded_and_describe_what_is_shipped(
    bellows: Bellows, tmp_path: Path
) -> None:
    for kind in Kind:
        status, out, _ = bellows(
            "init", kind.value, str(tmp_path / f"my_{kind.value}.toml"), "--json"
        )
        assert status == 0 and json.loads(out)["kind"] == kind.value
    design = load_design(tmp_path / "my_design.toml")
    assert design.name == "my_design" and design.digest == load_design("finger").digest
    printer = load_profile(tmp_path / "my_printer.toml")
    assert (
        printer.name == "my_printer" and printer.line_width == load_profile("prusa_i3").line_width
    )
    material = material_at(tmp_path / "my_material.toml")
    assert material.name == "my_material" and material.mu == design.material.mu


def test_options_that_are_commented_out_may_be_taken_in() -> None:
    design = Design.from_toml(with_options(template(Kind.DESIGN, "mine")))
    assert design.bellows.number_of_bubbles == 7 and design.limits.max_von_mises == 4.0
    assert design.mount is not None and design.fingertip is not None
    printer = tomllib.loads(with_options(template(Kind.PRINTER, "mine")))
    assert profile_from_table(printer).severity("overhang") == "fail"
    Material.model_validate(tomllib.loads(with_options(template(Kind.MATERIAL, "mine"))))


def test_a_file_that_is_there_is_replaced_on_demand_only(bellows: Bellows, tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("precious")
    status, _, err = bellows("init", "printer", str(file))
    assert status == 2 and "--force" in err and file.read_text() == "precious"
    assert bellows("init", "printer", str(file), "--force")[0] == 0
    assert load_profile(file).name == "mine"


@pytest.mark.parametrize("name", ["mine.txt", "gone/mine.toml", "."])
def test_a_place_that_cannot_be_written_is_refused(
    bellows: Bellows, tmp_path: Path, name: str
) -> None:
    status, _, err = bellows("init", "design", str(tmp_path / name))
    assert status == 2 and err.count("\n") == 1 and not list(tmp_path.iterdir())


@pytest.mark.parametrize("stem", ["my finger", "-x", "con", "ünï", "a" * 100, "...", ""])
def test_any_file_name_gives_a_name_of_a_design(stem: str) -> None:
    assert (
        Design.from_toml(template(Kind.DESIGN, name_from(stem))).digest
        == load_design("finger").digest
    )
