"""What test machines and spreadsheets write is read alike, or asked about with the option."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest
from damage import mutated
from refusals import refused_in_sentences
from tensile import SHEAR, curve, table

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.loading import load_measurements
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.materials.measurements.points import Measurements
from bellows_design.materials.selection import fit_model

CASES = Path(__file__).parents[2] / "data/measurements"
STRAIN, STRESS = curve()
TIME, FORCE = np.arange(60) * 0.1, STRESS * 7.5
PERCENT = 100 * STRAIN
TOLD = ReadingOptions(columns="stretch,stress_mpa")


def read(folder: Path, content: str | bytes, options: ReadingOptions | None = None) -> Measurements:
    path = folder / "it.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return load_measurements(path, options or ReadingOptions())


def refusal(folder: Path, content: str | bytes, options: ReadingOptions | None = None) -> str:
    with pytest.raises(DesignError) as caught:
        read(folder, content, options)
    (sentence,) = caught.value.sentences
    assert "\n" not in sentence and len(sentence) < 420
    return sentence


def holds_the_test(data: Measurements, relative: float = 2e-5) -> None:
    """The same points as were written, in the digits that were."""
    assert data.modes == ("uniaxial",)
    assert data.stretch == pytest.approx(1 + STRAIN, rel=relative)
    assert data.stress == pytest.approx(STRESS, rel=relative, abs=2e-5)


PREAMBLE = "Prüfer;A;\nBreite (mm);6;\nDicke (mm);1,25;\nMesslänge [mm];20;\n;;\n"
READ = {
    "semicolon": table("strain;stress_mpa", STRAIN, STRESS, separator=";"),
    "comma": table("strain;stress_mpa", STRAIN, STRESS, separator=";", decimal=","),
    "tab": table("strain\tstress_mpa", STRAIN, STRESS, separator="\t"),
    "tab-comma": table("strain\tstress_mpa", STRAIN, STRESS, separator="\t", decimal=","),
    "spaces": table("Strain [-]   Stress [MPa]", STRAIN, STRESS, separator="   "),
    "space-comma": table("strain stress_mpa", STRAIN, STRESS, separator=" ", decimal=","),
    "bars": table("strain|stress_mpa", STRAIN, STRESS, separator="|"),
    "numpy": table("# strain stress_mpa", STRAIN, STRESS, separator=" "),
    "trailing": table("strain,stress_mpa,", STRAIN, STRESS, ending=","),
    "trailing-many": table("strain;stress_mpa;;", STRAIN, STRESS, separator=";", ending=";;;"),
    "percent": table("Strain (%),Stress (MPa)", PERCENT, STRESS),
    "percent-no-unit": table("strain,stress_mpa", PERCENT, STRESS),
    "percent-signs": table("strain,stress_mpa", [f"{each:.5f}%" for each in PERCENT], STRESS),
    "stretch-percent": table("stretch [%],stress_mpa", 100 + PERCENT, STRESS),
    "time": table("Time (s),Strain (-),Stress (MPa)", TIME, STRAIN, STRESS),
    "clock": table("Time,Strain (-),Stress (MPa)", ["00:00:01.5"] * 60, STRAIN, STRESS),
    "units-row": table("Time,Strain,Stress\n(s),(%),(MPa)", TIME, PERCENT, STRESS),
    "units-row-german": table(
        "Zeit;Dehnung;Spannung\ns;%;N/mm²", TIME, PERCENT, STRESS, separator=";", decimal=","
    ),
    "units-behind": table("Strain in %,Stress / MPa", PERCENT, STRESS),
    "french": table("Déformation (%),Contrainte (MPa)", PERCENT, STRESS),
    "qualified": table("Tensile strain (Extension) (mm/mm),Tensile stress (MPa)", STRAIN, STRESS),
    "force": table(PREAMBLE + "Dehnung (%);Kraft (N);", PERCENT, FORCE, separator=";", decimal=","),
    "extension": table(
        PREAMBLE + "Weg (mm);Kraft (kN)", 20 * STRAIN, FORCE / 1e3, separator=";", decimal=","
    ),
    "plain-preamble": table(
        "Width: 6 mm\nThickness: 1.25 mm\n\nStrain (%),Force (N)", PERCENT, FORCE
    ),
    "summary-first": table(
        "Specimen,Max stress (MPa),Strain at break (%)\n1,4.8,200\n\nStrain (%),Stress (MPa)",
        PERCENT,
        STRESS,
    ),
    "nominal-and-true": table(
        "Eng. strain (%),Eng. stress (MPa),True strain (%),True stress (MPa)",
        PERCENT,
        STRESS,
        100 * np.log1p(STRAIN),
        STRESS * (1 + STRAIN),
    ),
    "true": table("Log strain,True stress (MPa)", np.log1p(STRAIN), STRESS * (1 + STRAIN)),
    "thousands": table(
        "strain [-];stress [kPa]", STRAIN, [f"{1e3 * each:,.3f}" for each in STRESS], separator=";"
    ),
    "force-beside-stress": table(
        "Area: 7.5 mm²\nStrain (%),Force (N),Stress (MPa)", PERCENT, FORCE, STRESS
    ),
}
"""Name -> a form of the test that is read without a question."""


@pytest.mark.parametrize("name", READ)
def test_a_form_that_is_certain_is_read(tmp_path: Path, name: str) -> None:
    holds_the_test(read(tmp_path, READ[name]))


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1"]
)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends_make_no_difference(
    tmp_path: Path, encoding: str, end: str
) -> None:
    text = "Müller\n" + READ["force"]
    data = read(tmp_path, text.replace("\n", end).encode(encoding))
    holds_the_test(data)
    named = any("is read as" in note and "text" in note for note in data.reading.notes)
    assert named is not encoding.startswith("utf-8")


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        *[("MPa", 1), ("kPa", 1e3), ("Pa", 1e6), ("N/mm²", 1), ("N/mm^2", 1), ("GPa", 1e-3)],
        *[("psi", 145.03774), ("ksi", 0.14503774), ("kgf/cm²", 10.197162), ("kg/cm2", 10.197162)],
        *[
            ("bar", 10),
            ("N/cm²", 100),
            ("MN/m²", 1),
            ("kgf/mm²", 0.10197162),
            ("lbf/in²", 145.03774),
        ],
    ],
)
def test_units_of_stress_come_from_the_header_or_the_option(
    tmp_path: Path, unit: str, factor: float
) -> None:
    """The option is stronger; without either it is asked."""
    holds_the_test(read(tmp_path, table(f"strain [-],stress [{unit}]", STRAIN, STRESS * factor)))
    bare = table("strain [-],stress", STRAIN, STRESS * factor)
    holds_the_test(read(tmp_path, bare, ReadingOptions(units=f"stress={unit}")))
    wrong = table("strain [-],stress [MPa]", STRAIN, STRESS * factor)
    holds_the_test(read(tmp_path, wrong, ReadingOptions(units=f"stress={unit}")))
    assert "--units stress=UNIT" in refusal(tmp_path, bare)


BOTH = "Area: 7.5 mm²\nStrain [-],Force [N],Stress [MPa]"
GERMAN_THOUSANDS = "strain [-];stress [kPa]\n" + "".join(
    f"{strain:.7f};{1e3 * stress:,.3f}\n".replace(".", "@").replace(",", ".").replace("@", ",")
    for strain, stress in zip(STRAIN, STRESS, strict=True)
)

ASKED = {
    "no-header": (table("", 1 + STRAIN, STRESS), "--columns stretch,stress_mpa", TOLD),
    "no-header-time": (
        table("", TIME, PERCENT, STRESS),
        "what its 3 columns hold",
        ReadingOptions(columns="-,strain_percent,stress_mpa"),
    ),
    "by-number": (
        table("a,b,c,d", TIME, FORCE, PERCENT, STRESS),
        "name them with --columns",
        ReadingOptions(columns="strain_percent=3,stress_mpa=4"),
    ),
    "no-area": (
        table("strain [-],Force [N]", STRAIN, FORCE),
        "--area MM2",
        ReadingOptions(area=7.5),
    ),
    "no-length": (
        table("Displacement (mm),Stress (MPa)", 20 * STRAIN, STRESS),
        "--gauge-length MM",
        ReadingOptions(gauge_length=20),
    ),
    "no-unit-of-force": (
        table("strain [-],load", STRAIN, FORCE / 9.80665),
        "--units force=UNIT",
        ReadingOptions(units="force=kgf", area=7.5),
    ),
    "elongation": (
        table("elongation,stress_mpa", PERCENT, STRESS),
        "--units elongation=% or elongation=mm",
        ReadingOptions(units="elongation=%"),
    ),
    "two-strains": (
        table("Strain (crosshead) [-],Strain (video) [-],Stress [MPa]", STRAIN, STRAIN, STRESS),
        "several columns that may be meant",
        ReadingOptions(columns="-,strain,stress_mpa"),
    ),
    "two-sources": (
        table("Strain (crosshead) [-],Strain [-],Stress [MPa]", 1.1 * STRAIN, STRAIN, STRESS),
        "--columns strain=1,stress=3",
        ReadingOptions(columns="strain=2,stress_mpa=3"),
    ),
    "footer": (
        table("strain,stress_mpa", STRAIN, STRESS) + "Max,4.8\n",
        "--skip 62-62",
        ReadingOptions(skip="62-"),
    ),
    "thousands-or-decimals": (
        GERMAN_THOUSANDS,
        None,
        ReadingOptions(decimal="comma"),
    ),
    "true-stress-by-force": (
        table(BOTH, STRAIN, FORCE, STRESS * (1 + STRAIN)),
        "--true-stress",
        ReadingOptions(true_stress=True),
    ),
}
"""Name -> (a form that is open, words of the question, the options that answer it)."""


@pytest.mark.parametrize("name", ASKED)
def test_a_form_that_is_open_is_asked_about_and_the_option_settles_it(
    tmp_path: Path, name: str
) -> None:
    text, words, options = ASKED[name]
    if words is not None:
        assert words in refusal(tmp_path, text)
    holds_the_test(read(tmp_path, text, options))


def test_commas_that_may_be_either_are_asked_about(tmp_path: Path) -> None:
    whole = [f"{1e3 * each:,.0f}" for each in STRESS]
    text = table("strain [-];stress [kPa]", STRAIN, whole, separator=";")
    assert "--decimal comma or --decimal point" in refusal(tmp_path, text)
    data = read(tmp_path, text, ReadingOptions(decimal="point"))
    assert data.stress == pytest.approx(STRESS, abs=6e-4)


def test_a_unit_that_the_row_of_units_contradicts_is_asked_about(tmp_path: Path) -> None:
    text = table("Strain (%),Stress (MPa)\nmm/mm,MPa", STRAIN, STRESS)
    assert "has another unit below it, “mm/mm”" in refusal(tmp_path, text)
    holds_the_test(read(tmp_path, text, ReadingOptions(skip="2-2", units="strain=mm/mm")))


def test_decimal_commas_between_commas_are_refused_with_the_reason(tmp_path: Path) -> None:
    text = table("strain,stress_mpa", STRAIN, STRESS, decimal=",")
    assert "decimal commas need semicolons" in refusal(tmp_path, text)


def test_true_strain_and_true_stress_have_an_option_each(tmp_path: Path) -> None:
    text = table("strain [-],stress [MPa]", np.log1p(STRAIN), STRESS * (1 + STRAIN))
    options = ReadingOptions(true_strain=True, true_stress=True)
    data = read(tmp_path, text, options)
    holds_the_test(data)
    assert any("true (Cauchy) stress, turned into nominal" in note for note in data.reading.notes)


def test_compression_that_counts_as_positive_is_known_by_its_name_or_asked_about(
    tmp_path: Path,
) -> None:
    strain, stress = -curve(-0.5, 40, start=-0.0125)[0], -curve(-0.5, 40, start=-0.0125)[1]
    names = "Compressive strain (%),Compressive stress (MPa)"
    data = read(tmp_path, table(names, 100 * strain, stress))
    assert data.stretch == pytest.approx(1 - strain, rel=1e-5) and (data.stress < 0).all()
    silent = table("strain [-],stress [MPa]", strain, stress)
    assert "compression that counts as positive" in refusal(tmp_path, silent)
    told = ReadingOptions(columns="compressive_strain_fraction,compressive_stress_mpa")
    assert (read(tmp_path, silent, told).stretch < 1).all()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (ReadingOptions(columns="strain"), "lacks a column of stress or force"),
        (ReadingOptions(columns="strain,pressure"), "--columns has “pressure”; known are strain"),
        (ReadingOptions(columns="strain=1,stress_mpa=9"), "number of a column, from 1 to 2"),
        (ReadingOptions(columns="strain=x,stress_mpa=2"), "number of a column, from 1 to 2"),
        (ReadingOptions(columns="strain,stress_mpa,-,-"), None),
        (ReadingOptions(units="stress=furlong"), "--units has the unit “furlong” of stress"),
        (ReadingOptions(units="colour=MPa"), "--units has “colour=MPa” but must have a quantity"),
        (ReadingOptions(units="MPa"), "--units has “MPa” but must have a quantity"),
        (ReadingOptions(units="force=N"), "--units has a unit of force but there is no such"),
        (ReadingOptions(skip="x"), "--skip is “x” but must be a number of lines"),
        (ReadingOptions(skip="1-"), "is empty"),
    ],
)
def test_options_that_make_no_sense_are_refused_in_one_sentence(
    tmp_path: Path, options: ReadingOptions, words: str | None
) -> None:
    text = table("strain,stress_mpa", STRAIN, STRESS)
    if words is None:
        holds_the_test(read(tmp_path, text, options))
    else:
        assert words in refusal(tmp_path, text, options)


@pytest.mark.parametrize(
    "values",
    [
        {"decimal": "dot"},
        {"branch": "second"},
        {"keep": ("toe",)},
        {"area": 0.0},
        {"area": float("nan")},
        {"gauge_length": -1.0},
        {"gauge_length": float("inf")},
    ],
)
def test_values_of_options_are_bounded(values: dict[str, object]) -> None:
    with pytest.raises(DesignError, match="--"):
        ReadingOptions(**values)  # type: ignore[arg-type]


def test_a_damaged_file_is_read_or_refused_in_one_sentence(tmp_path: Path) -> None:
    chance = random.Random("machines")
    path = tmp_path / "it.csv"
    refused = 0
    for _ in range(6):
        for text in READ.values():
            path.write_bytes(mutated(text.encode(), chance))
            refused += refused_in_sentences(lambda: load_measurements(path))
    assert 40 < refused < 6 * len(READ)


def test_several_separate_files_are_specimens(tmp_path: Path) -> None:
    paths = []
    for seed in range(3):
        paths.append(tmp_path / f"s{seed}.csv")
        strain, stress = curve(1.8 + 0.1 * seed, seed=seed)
        paths[-1].write_text(table("strain,stress_mpa", strain, stress), "utf-8")
    data = load_measurements(paths)
    assert data.name == "s0.csv and 2 more" and data.stretch.max() <= 2.8 + 1e-9
    assert any("3 specimens in uniaxial tests" in note for note in data.reading.notes)
    assert data.spread is not None and 0 < np.median(data.spread / data.stress) < 0.02


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("sound", {}),
        ("semicolon_comma", {}),
        ("machine", {}),
        ("units_header", {}),
        ("time_column", {}),
        ("trailing", {}),
        ("after_break", {}),
        ("headerless", {"columns": "stretch,stress_mpa"}),
    ],
)
def test_the_reported_files_are_read(name: str, options: dict[str, str]) -> None:
    data = load_measurements(CASES / f"{name}.csv", ReadingOptions(**options))
    assert data.stretch.size == 60 and data.stretch.max() == pytest.approx(3)
    assert fit_model(data, "ogden2").stability.shear_modulus == pytest.approx(SHEAR, rel=0.03)


def test_the_reported_files_that_are_open_are_asked_about() -> None:
    for name, words in (("headerless", "--columns"), ("percent_below_19", "--units strain=%")):
        with pytest.raises(DesignError, match=words):
            load_measurements(CASES / f"{name}.csv")
    told = load_measurements(CASES / "percent_below_19.csv", ReadingOptions(units="strain=%"))
    assert fit_model(told, "ogden1").stability.shear_modulus == pytest.approx(3.466, rel=0.03)
