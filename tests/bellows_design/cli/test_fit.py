"""The command ``fit``: its answer, its files, and its refusals."""

from __future__ import annotations

import io
import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bellows_design.cli import fit as fit_command
from bellows_design.cli.answer import Answer
from bellows_design.cli.fit import MaterialOptions, fit
from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.errors import DesignError
from bellows_design.files.json_files import json_text
from bellows_design.materials.library import write_material
from bellows_design.materials.material import Material
from solver.material.homogeneous import MODES, nominal_stress
from solver.material.ogden import packed

CONSTANTS = (3.2778, 0.19825), (-0.0054, 3.05)


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A table of all three tests of a known material."""
    stretch = np.linspace(1.05, 4.0, 30)
    rows = [
        f"{name};{x:.17g};{p:.17g}"
        for name, mode in MODES.items()
        for x, p in zip(stretch, nominal_stress(mode, stretch, packed(*CONSTANTS)), strict=True)
    ]
    path = tmp_path / "tpu.csv"
    path.write_text("# made up\nmode;stretch;stress_mpa\n" + "\n".join(rows), "utf-8")
    return path


def printed(answer: Answer) -> str:
    from rich.console import Console

    console = Console(width=120, record=True, file=io.StringIO())
    for line in answer.text:
        console.print(line)
    return console.export_text()


def refusal(*arguments: Any, **options: Any) -> str:
    with pytest.raises(DesignError) as caught:
        fit(*arguments, **options)
    assert "\n" not in str(caught.value) and str(caught.value).endswith((".", "?"))
    return str(caught.value)


def test_the_answer_has_constants_intervals_quality_and_ranges(data: Path) -> None:
    answer = fit(data)
    content = json.loads(json_text(answer.content))
    assert answer.status == 0
    assert content["model"] == "ogden2" and content["requested"] == "best"
    assert content["mu_mpa"] == pytest.approx(CONSTANTS[0], rel=1e-6)
    assert content["alpha"] == pytest.approx(CONSTANTS[1], rel=1e-4)
    assert content["points"] == 90 and content["tests"]["planar"]["points"] == 30
    assert content["tests"]["biaxial"]["strain"] == pytest.approx([0.05, 3.0])
    assert content["valid_strain"] == pytest.approx([1 / 16 - 1, 3.0])
    assert content["stable"] and content["determined"] and content["refused"] is None
    assert content["stable_stretch"]["uniaxial"]["complete"]
    text = printed(answer)
    for word in ("mu_1, MPa", "95 % interval", "R²", "largest error", "stable, planar", "AICc"):
        assert word in text


def test_the_material_file_serves_a_design(data: Path, tmp_path: Path) -> None:
    output = tmp_path / "my tpu.toml"
    answer = fit(data, "ogden2", MaterialOptions(output, 4.0))
    assert answer.content["material_file"] == str(output)
    text = output.read_text("utf-8")
    table = tomllib.loads(text)
    assert table["valid_strain"] == [-0.9375, 3.0] and "higher" not in table
    material = Material.model_validate(table)
    assert material.name == "my_tpu" and material.yield_strength == 4.0
    assert material.mu == pytest.approx(CONSTANTS[0], rel=1e-6)
    assert "tpu.csv" in material.source and "ogden2" in material.source
    design = Design.of(load_design("prototype_1").model_dump() | {"material": table})
    assert design.material == material


def test_a_material_needs_a_yield_strength(data: Path, tmp_path: Path) -> None:
    assert "--yield-strength" in refusal(data, material=MaterialOptions(tmp_path / "m.toml"))
    for value in (-1.0, 4000.0, float("nan"), float("inf")):
        assert "between 0.01 and 200 MPa" in refusal(
            data, material=MaterialOptions(yield_strength=value)
        )
    assert list(tmp_path.glob("*.toml")) == []


@pytest.mark.parametrize(
    ("name", "words"),
    [("m.json", "must end in .toml"), ("gone/m.toml", "there is no folder")],
)
def test_files_are_refused_before_anything_is_read(tmp_path: Path, name: str, words: str) -> None:
    missing = tmp_path / "missing.csv"
    assert words in refusal(missing, material=MaterialOptions(tmp_path / name, 1.0))
    assert "must end in .png" in refusal(missing, plot=tmp_path / "fit.pdf")
    (tmp_path / "folder.toml").mkdir()
    folder = tmp_path / "folder.toml"
    assert "is a folder" in refusal(missing, material=MaterialOptions(folder, 1.0))


def test_a_fit_that_is_no_material_leaves_no_file(data: Path, tmp_path: Path) -> None:
    stretch = np.linspace(1.1, 3, 20)
    stress = nominal_stress(MODES["uniaxial"], stretch, packed((1.0,), (2.0,)))
    rows = "\n".join(f"{x},{p}" for x, p in zip(stretch, stress, strict=True))
    path = tmp_path / "neo.csv"
    path.write_text("stretch,stress_mpa\n" + rows, "utf-8")
    answer = fit(path, "mooney-rivlin", MaterialOptions(tmp_path / "m.toml", 1.0))
    assert answer.status == 1 and not (tmp_path / "m.toml").exists()
    assert "adds nothing" in answer.content["refused"] and "REFUSED" in printed(answer)
    json_text(answer.content)  # with an infinite interval


def test_one_kind_of_test_is_said_to_be_a_guess_elsewhere(tmp_path: Path) -> None:
    path = tmp_path / "one.csv"
    path.write_text("stretch,stress_mpa\n1.1,1\n1.2,1.9\n1.3,2.4\n1.4,2.9\n1.5,3.3\n", "utf-8")
    assert "only uniaxial tests" in printed(fit(path))


def test_a_failed_write_leaves_the_old_file(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "m.toml"
    output.write_text("old", "utf-8")
    monkeypatch.setattr(Path, "write_text", lambda *_: (_ for _ in ()).throw(OSError(28, "full")))
    material = Material(mu=(1.0,), alpha=(2.0,), yield_strength=1.0)
    with pytest.raises(OSError, match="full"):
        write_material(material, output)
    assert output.read_bytes() == b"old" and len(list(tmp_path.glob("*.toml"))) == 1


def test_an_impossible_material_is_refused_in_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "steel.csv"
    rows = "\n".join(f"{1 + k / 100},{k * 20}" for k in range(1, 8))
    path.write_text("stretch,stress_mpa\n" + rows, "utf-8")
    words = refusal(path, "neo-hooke", MaterialOptions(tmp_path / "m.toml", 1.0))
    assert "initial shear modulus" in words


def test_the_plot_is_a_picture(data: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    answer = fit(data, "ogden1", plot=tmp_path / "fit.png")
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")
    assert answer.content["plot_file"] == str(tmp_path / "fit.png")


def test_without_matplotlib_a_plot_is_refused_in_one_sentence(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bellows_design.reports.plots.find_spec", lambda _: None)
    assert "pictures" in refusal(data, plot=tmp_path / "fit.png")
    assert fit_command.fit(data, "ogden2").status == 0


def test_yeoh_becomes_a_material_if_it_is_stable_over_the_tests(tmp_path: Path) -> None:
    """One that softens within the tests is refused; one that does only beyond them is not."""
    for top, status in ((1.25, 0), (1.8, 1)):
        line = np.linspace(0.9, top, 30)
        stress = nominal_stress(MODES["uniaxial"], line, packed((0.8,), (2.0,), (-0.12, 0.002)))
        rows = "\n".join(f"{x},{p}" for x, p in zip(line, stress, strict=True))
        path, output = tmp_path / "soft.csv", tmp_path / f"soft{status}.toml"
        path.write_text("stretch,stress_mpa\n" + rows, "utf-8")
        answer = fit(path, "yeoh", MaterialOptions(output, 1.0))
        assert answer.status == status and output.exists() is (status == 0)
        assert answer.content["higher_mpa"] == pytest.approx([-0.12, 0.002], rel=1e-6)
    material = Material.model_validate(tomllib.loads((tmp_path / "soft0.toml").read_text("utf-8")))
    assert material.model == "yeoh" and material.higher == pytest.approx((-0.12, 0.002))
    assert material.valid_strain == (-0.1056, 0.25)


def test_published_measurements_become_a_material_and_a_picture(tmp_path: Path) -> None:
    treloar = Path(__file__).parents[1] / "data/treloar_1944.csv"
    output, picture = tmp_path / "treloar.toml", tmp_path / "treloar.png"
    answer = fit(treloar, "ogden2", MaterialOptions(output, 6.3), picture)
    assert answer.status == 0 and picture.stat().st_size > 10_000
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert tomllib.loads(output.read_text("utf-8"))["valid_strain"] == [-0.9493, 6.61]
    assert "stretch 1.01 … 7.61" in printed(answer)


def made_up(tmp_path: Path, law: tuple[tuple[float, ...], tuple[float, ...]], name: str) -> Path:
    """A made-up tensile test of a material, up to 200 %."""
    line = np.linspace(1.02, 3, 40)
    stress = nominal_stress(MODES["uniaxial"], line, packed(*law))
    path = tmp_path / name
    rows = "\n".join(f"{x},{p}" for x, p in zip(line, stress, strict=True))
    path.write_text("stretch,stress_mpa\n" + rows, "utf-8")
    return path


def test_elongation_at_break_is_taken_in_per_cent_and_written(data: Path, tmp_path: Path) -> None:
    output = tmp_path / "m.toml"
    answer = fit(data, "ogden2", MaterialOptions(output, 4.0, 400))
    assert tomllib.loads(output.read_text("utf-8"))["elongation_at_break"] == 400
    assert not any("elongation at break" in note for note in answer.content["notes"])
    without = fit(data, "ogden2", MaterialOptions(output, 4.0))
    assert any("--elongation-at-break gives it" in note for note in without.content["notes"])
    less = fit(data, "ogden2", MaterialOptions(output, 4.0, 100))
    assert any("less than these tests reached, 300 %" in note for note in less.content["notes"])


@pytest.mark.parametrize("value", [4.0, 19.9, 3001.0, float("nan"), float("inf"), -1.0])
def test_an_elongation_out_of_bounds_is_refused_before_anything_is_read(
    tmp_path: Path, value: float
) -> None:
    words = refusal(tmp_path / "no.csv", material=MaterialOptions(elongation_at_break=value))
    assert "between 20 and 3000 %" in words
    assert ("a fraction of 4 is 400 %" in words) is (value == 4.0)


def test_a_poor_fit_is_no_material_unless_it_is_asked_for(tmp_path: Path) -> None:
    """neo-Hooke follows NinjaFlex up to 200 % with an error of some 20 %."""
    path, output = made_up(tmp_path, CONSTANTS, "tpu.csv"), tmp_path / "m.toml"
    refused = fit(path, "neo-hooke", MaterialOptions(output, 4.0))
    assert refused.status == 1 and not output.exists()
    assert "--accept-poor-fit" in refused.content["refused"]
    taken = fit(path, "neo-hooke", MaterialOptions(output, 4.0, accept_poor=True))
    assert taken.status == 0 and taken.content["refused"] is None
    (warning, *_) = Material.model_validate(tomllib.loads(output.read_text("utf-8"))).warnings
    assert "poor fit" in warning and "more than 15 %" in warning
    good = fit(path, "ogden2", MaterialOptions(output, 4.0))
    assert good.status == 0
    material = Material.model_validate(tomllib.loads(output.read_text("utf-8")))
    assert material.warnings == () and material.fit_error == pytest.approx(0, abs=0.1)


def test_what_was_read_is_said_in_text_and_json(data: Path) -> None:
    answer = fit(data, "neo-hooke", MaterialOptions(accept_poor=True))
    notes = answer.content["reading"]["notes"]
    assert "semicolons separate the columns" in notes and answer.content["reading"]["hints"] == []
    assert all(f"read: {note}" in printed(answer).replace("\n", " ") for note in notes[:1])


def test_the_criteria_are_said_to_disagree_where_points_are_few() -> None:
    five = Path(__file__).parents[1] / "data/measurements/five_points.csv"
    answer = fit(five)
    assert answer.content["model"] == "ogden1" and answer.content["by_criterion"] == "neo-hooke"
    assert answer.content["shear_modulus_mpa"] == pytest.approx(3.466, rel=0.03)
    assert any("the criteria disagree" in note for note in answer.content["notes"])


def test_constants_that_are_not_unique_are_a_sentence_not_a_huge_number() -> None:
    answer = fit(Path(__file__).parents[1] / "data/measurements/sound.csv")
    (note,) = [each for each in answer.content["notes"] if "quite other constants" in each]
    assert "a factor of ten in biaxial and planar tests" in note and "add a biaxial" in note
    assert not any(len(word) > 6 and word.isdigit() for word in note.split())


def test_the_command_asks_in_one_sentence_and_takes_the_answer(bellows) -> None:  # type: ignore[no-untyped-def]
    path = str(Path(__file__).parents[1] / "data/measurements/percent_below_19.csv")
    status, _, err = bellows("fit", path)
    assert status == 2 and "--units strain=1 or --units strain=% tells which" in err
    status, out, _ = bellows("fit", path, "--units", "strain=%", "--json")
    assert status == 0
    assert json.loads(out)["shear_modulus_mpa"] == pytest.approx(3.466, rel=0.03)
