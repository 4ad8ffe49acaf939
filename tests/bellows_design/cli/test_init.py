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
from bellows_design.design.scenes.scene import KINDS, scene_of
from bellows_design.materials.library import load_material, material_at
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
from printers import (
    Filament,
    PrinterProfile,
    SlicerAdvice,
    load_filament,
    load_profile,
    profile_from_table,
)

Bellows = Callable[..., tuple[int, str, str]]
RECORDS = {
    Kind.DESIGN: (Design, BellowsParameters, Indent, Port, Mount, Fingertip, Load, Limits),
    Kind.PRINTER: (PrinterProfile, SlicerAdvice, Filament),
    Kind.FILAMENT: (Filament,),
    Kind.SCENE: tuple(KINDS.values()),
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
    filament = load_filament(tmp_path / "my_filament.toml")
    assert filament.name == "my_filament"
    assert filament.nozzle_temperature == load_filament("ninjaflex_85a").nozzle_temperature
    scene = tomllib.loads((tmp_path / "my_scene.toml").read_text("utf-8"))
    assert scene_of(scene, "scene") == KINDS["blocked"]()
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


@pytest.mark.parametrize("name", ["prototype_1", "prototype_2_indent"])
def test_a_design_may_begin_as_another(bellows: Bellows, tmp_path: Path, name: str) -> None:
    first, second = tmp_path / "first.toml", tmp_path / "second.toml"
    assert bellows("init", "design", str(first), "--from", name)[0] == 0
    assert bellows("init", "design", str(second), "--from", str(first))[0] == 0
    assert load_design(second).digest == load_design(name).digest
    assert load_design(second).name == "second"


def test_a_design_with_scenes_and_a_material_of_its_own_begins_another(tmp_path: Path) -> None:
    own = load_material("ninjaflex").model_copy(update={"name": "mine", "yield_strength": 3.0})
    scenes = {"desk": {"kind": "blocked", "support": "wall", "distance": 8.0}}
    design = Design.of(load_design("finger").model_dump() | {"material": own, "scenes": scenes})
    file = tmp_path / "own.toml"
    file.write_text(design.to_toml(), "utf-8")
    copied = Design.from_toml(template(Kind.DESIGN, "copied", str(file)))
    assert copied.digest == design.digest and copied.scenes == design.scenes


def test_printers_filaments_and_materials_may_begin_as_others() -> None:
    printer = tomllib.loads(template(Kind.PRINTER, "mine", "nozzle_0_6"))
    assert printer["nozzle_diameter"] == 0.6 and printer["name"] == "mine"
    filament = tomllib.loads(template(Kind.FILAMENT, "mine", "cheetah_95a"))
    assert filament["shore"] == load_filament("cheetah_95a").shore
    material = tomllib.loads(template(Kind.MATERIAL, "mine", "ecoflex_00_30"))
    assert material["mu"] == list(load_material("ecoflex_00_30").mu)


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_scene_of_any_kind_is_one(kind: str) -> None:
    table = tomllib.loads(template(Kind.SCENE, "mine", kind))
    assert scene_of(table, "scene").kind == kind


@pytest.mark.parametrize(
    ("kind", "source", "words"),
    [
        ("design", "fingr", "did you mean finger?"),
        ("printer", "prusa_i4", "did you mean prusa_i3?"),
        ("filament", "ninjaflex", "did you mean ninjaflex_85a?"),
        ("scene", "block", "did you mean blocked?"),
        ("body", "finger", "--from is for all but own bodies"),
    ],
)
def test_what_cannot_be_begun_from_is_named(
    bellows: Bellows, tmp_path: Path, kind: str, source: str, words: str
) -> None:
    status, _, err = bellows("init", kind, str(tmp_path / "x.toml"), "--from", source)
    assert status == 2 and words in err and err.count("\n") == 1
    assert not list(tmp_path.iterdir())
