"""Printers and materials of one's own: by file, and whole in what is kept."""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import pytest
from fakes import FakeEvaluation

from bellows_design.design import Design, load_design, with_overrides
from bellows_design.errors import DesignError
from printers import PrinterProfile

PRINTER = (files("printers") / "profiles/nozzle_0_6.toml").read_text("utf-8")
MATERIAL = (files("bellows_design.materials") / "ecoflex_00_30.toml").read_text("utf-8")
FINGER = (files("bellows_design.design") / "designs/finger.toml").read_text("utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A design whose printer and material are files beside it, in a folder."""
    (tmp_path / "parts").mkdir()
    own = PRINTER.replace('name = "nozzle_0_6"', 'name = "own"')
    (tmp_path / "parts/own.toml").write_text(own, "utf-8")
    (tmp_path / "parts/soft.toml").write_text(MATERIAL, "utf-8")
    text = FINGER.replace('name = "finger"', 'name = "mine"')
    text = text.replace('"ninjaflex"', '"parts/soft.toml"').replace(
        '"prusa_i3"', '"parts/own.toml"'
    )
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    return tmp_path


def test_files_are_found_from_the_design_s_folder(folder: Path) -> None:
    design = load_design(folder / "mine.toml")
    assert isinstance(design.printer, PrinterProfile) and design.printer.name == "own"
    assert design.profile().nozzle_diameter == 0.6
    assert design.material.mu == load_design_with_material("ecoflex_00_30").material.mu


def load_design_with_material(name: str) -> Design:
    return with_overrides(load_design("finger"), [f"material={name}"])


def test_what_is_kept_holds_printer_and_material_and_loads_elsewhere(folder: Path) -> None:
    design = load_design(folder / "mine.toml")
    for path in (folder / "parts").iterdir():
        path.unlink()
    assert Design.from_toml(design.to_toml()) == design
    again = Design.of(json.loads(json.dumps(design.model_dump(mode="json", exclude_none=True))))
    assert again == design and again.digest == design.digest


def test_the_digest_follows_what_the_files_say_not_where_they_are(folder: Path) -> None:
    first = load_design(folder / "mine.toml").digest
    (folder / "parts").rename(folder / "elsewhere")
    text = (folder / "mine.toml").read_text("utf-8").replace("parts/", "elsewhere/")
    (folder / "mine.toml").write_text(text, "utf-8")
    assert load_design(folder / "mine.toml").digest == first
    printer = folder / "elsewhere/own.toml"
    renamed = printer.read_text("utf-8").replace('name = "own"', 'name = "other"')
    printer.write_text(renamed, "utf-8")
    assert load_design(folder / "mine.toml").digest == first
    printer.write_text(renamed.replace("minimum_gap = 0.6", "minimum_gap = 0.7"), "utf-8")
    assert load_design(folder / "mine.toml").digest != first


def test_a_table_is_a_printer_too(folder: Path) -> None:
    design = load_design(folder / "mine.toml")
    assert "[printer.slicer]" in design.to_toml()
    changed = with_overrides(design, ["printer=prusa_i3", "material=ninjaflex"])
    assert changed.digest == load_design("finger").digest


@pytest.mark.parametrize("key", ["printer", "material"])
@pytest.mark.parametrize("content", [None, "line_width = 0,4", "line_width = 1\nmu = [1]", "\xff"])
def test_a_file_that_is_missing_or_broken_is_named(
    folder: Path, key: str, content: str | None
) -> None:
    path = folder / ("parts/own.toml" if key == "printer" else "parts/soft.toml")
    path.unlink()
    if content is not None:
        path.write_bytes(content.encode("latin-1"))
    with pytest.raises(DesignError) as caught:
        load_design(folder / "mine.toml")
    assert all("\n" not in each for each in caught.value.sentences)
    if content == "line_width = 0,4":
        assert "write 0.4, not 0,4" in str(caught.value) and "line 1, column" in str(caught.value)


def test_run_takes_another_printer_and_keeps_it_in_the_manifest(
    folder: Path,
    bellows: Callable[..., tuple[int, str, str]],
    stub_stages: Callable[..., None],
) -> None:
    stub_stages(FakeEvaluation())
    printer, exports = str(folder / "parts/own.toml"), folder / "exports"
    status, out, _ = bellows(
        "run", "finger", "--printer", printer, "--output", str(exports), "--json"
    )
    assert status == 0
    manifest = json.loads((Path(json.loads(out)["folder"]) / "manifest.json").read_text("utf-8"))
    assert manifest["name"].startswith("finger-")
    assert manifest["printer"]["name"] == "own" and manifest["printer"]["line_width"] == 0.6
    again = Design.of(manifest["design"])
    assert again.digest == manifest["digest"] and again.profile().name == "own"


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_printer_that_is_none_is_refused_before_any_work(
    command: str, bellows: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    for printer in ("ender", str(tmp_path / "gone.toml"), "../prusa_i3"):
        status, _, err = bellows(command, "finger", "--printer", printer)
        assert status == 2 and "printer" in err and "geometry" not in err
