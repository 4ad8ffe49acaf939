"""Measured curves from files as labs write them, and one sentence for those that are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bellows_design.errors import DesignError
from bellows_design.materials.measurements.options import ReadingOptions
from bellows_design.measured.reading.curve import MeasuredCurve
from bellows_design.measured.reading.load import CurveOptions, load_curve

DATA = Path(__file__).parents[1] / "data"
SOUND = load_curve(DATA / "sound.csv")


def options(
    quantity: str | None = None, branch: str | None = None, **table: str | None
) -> CurveOptions:
    return CurveOptions(quantity, branch, ReadingOptions(**table))  # type: ignore[arg-type]


def read(folder: Path, text: str, told: CurveOptions | None = None) -> MeasuredCurve:
    path = folder / "measured.csv"
    path.write_text(text, "utf-8")
    return load_curve(path, told)


def notes(curve: MeasuredCurve) -> str:
    return "; ".join(curve.reading.notes)


def test_pressures_are_in_mpa_and_a_spread_is_the_values() -> None:
    assert SOUND.quantity.name == "angle"
    assert SOUND.pressure == pytest.approx(np.arange(0, 0.101, 0.01))
    assert SOUND.value[-1] == pytest.approx(186.0)
    assert SOUND.spread is not None and SOUND.spread[-1] == pytest.approx(0.02 * 186)


@pytest.mark.parametrize(
    ("file", "told", "note"),
    [
        ("machine_german.csv", None, "decimal comma"),
        ("repeats.csv", None, "means of 3 columns"),
        ("loop.csv", None, "loading is used"),
    ],
)
def test_the_same_curve_is_read_of_every_format(
    file: str, told: CurveOptions | None, note: str
) -> None:
    found = load_curve(DATA / file, told)
    assert found.pressure == pytest.approx(SOUND.pressure, abs=1e-6)
    assert found.value == pytest.approx(SOUND.value)
    assert note in notes(found)


def test_columns_that_are_not_read_are_named() -> None:
    assert "Kommentar" in notes(load_curve(DATA / "machine_german.csv"))


def test_the_way_back_is_read_if_it_is_asked_for() -> None:
    back = load_curve(DATA / "loop.csv", options(branch="unloading"))
    assert back.value == pytest.approx(SOUND.value[:-1] + 6)
    both = load_curve(DATA / "loop.csv", options(branch="all"))
    assert both.pressure.size == 11 and "11, each the mean" in notes(both)
    assert both.value[:-1] == pytest.approx(SOUND.value[:-1] + 3)


def test_a_column_of_branches_tells_them(tmp_path: Path) -> None:
    text = "p (kPa),angle (deg),branch\n10,5,up\n20,9,up\n10,7,down\n0,1,down\n"
    assert read(tmp_path, text).value == pytest.approx([5, 9])
    assert read(tmp_path, text, options(branch="unloading")).value == pytest.approx([1, 7])
    with pytest.raises(DesignError, match="a branch is called “sideways”"):
        read(tmp_path, text.replace("down", "sideways"))


def test_one_of_several_quantities_is_asked_for() -> None:
    path = DATA / "units_below.csv"
    with pytest.raises(DesignError, match="columns of displacement_z and force; --quantity"):
        load_curve(path)
    force, z = (load_curve(path, options(each)) for each in ("force", "displacement_z"))
    assert force.value == pytest.approx(np.arange(0, 1.01, 0.1))  # mN
    assert z.value == pytest.approx(-np.arange(0, 10.1, 1))
    with pytest.raises(DesignError, match="no such column, only displacement_z, force"):
        load_curve(path, options("angle"))


@pytest.mark.parametrize(
    ("header", "quantity", "factor"),
    [
        ("Pressure [bar],Tip displacement x [mm]", "displacement_x", 1),
        ("p / bar,u_z / cm", "displacement_z", 10),
        ("internal pressure (psi),deflection (in)", "displacement", 25.4),
        ("input pressure kPa,tip angle rad", "angle", 180 / np.pi),
        ("Druck in mbar,Blockierkraft in N", "force", 1),
        ("gauge pressure (kPa),tip rotation (°)", "angle", 1),
        ("pressure (kPa),load (g)", "force", 0.00980665),
        ("pressure (kPa),bend (mm)", "displacement", 1),
    ],
)
def test_names_and_units_are_understood(
    header: str, quantity: str, factor: float, tmp_path: Path
) -> None:
    found = read(tmp_path, f"{header}\n1,1\n2,2\n3,4\n")
    assert found.quantity.name == quantity
    assert found.value == pytest.approx(factor * np.array([1, 2, 4]))


def test_options_tell_what_a_file_does_not(tmp_path: Path) -> None:
    told = options(columns="angle_deg,-,pressure_kpa")
    assert read(tmp_path, "1,x,10\n2,x,20\n4,x,30\n", told).value == pytest.approx([1, 2, 4])
    units = options(units="pressure=kPa,angle=rad")
    found = read(tmp_path, "pressure,angle\n10,0.1\n20,0.2\n", units)
    assert found.unit_told and found.value[1] == pytest.approx(np.degrees(0.2))


def test_long_files_are_means_in_intervals_and_disorder_is_sorted(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    pressure = rng.uniform(1, 100, 2000)
    rows = "".join(f"{p:.4f},{2 * p:.4f}\n" for p in pressure)
    found = read(tmp_path, f"pressure_kpa,angle_deg\n{rows}")
    assert found.pressure.size <= 120 and (np.diff(found.pressure) > 0).all()
    assert found.value == pytest.approx(2000 * found.pressure, rel=1e-4)
    assert "2000 points are read as" in notes(found)


def test_a_vacuum_has_negative_pressures(tmp_path: Path) -> None:
    found = read(tmp_path, "pressure_kpa,angle_deg\n-10,1\n-20,3\n0.1,0\n-30,5\n")
    assert found.pressure == pytest.approx([-0.01, -0.02, -0.03])
    assert "just on the other side" in notes(found)


BAD = {
    "": "is empty",
    "10,1\n20,2\n30,4\n": "names no columns above line 1",
    "time,angle_deg\n1,2\n2,3\n": "none is a pressure",
    "pressure_kpa,temperature\n1,2\n2,3\n": "none is an angle, a displacement or a force",
    "pressure,angle_deg\n1,2\n2,3\n": "has no unit; --units pressure=kPa",
    "pressure_kpa,angle\n1,2\n2,3\n": "has no unit; --units angle=deg",
    "pressure_kpa,angle_deg\n1,2\n": "has 1 point but must have at least 2",
    "pressure_kpa,angle_deg\n": "0 points",
    "pressure_kpa,angle_deg\n1,2\n1,3\n1,4\n": "points at one pressure alone",
    "pressure_kpa,angle_deg\n10,2\n-10,3\n20,4\n": "must have one sign",
    "pressure_kpa,angle_deg\n10,2\n20,broken\n": "“broken” but must be a number; --skip 3-3",
    "pressure_kpa,angle_deg\n10,2\n20,nan\n": "“nan” but must be a finite number",
    "pressure_kpa,angle_deg\n10,2\n20,\n": "1 value but the header names 2 columns",
    "pressure_kpa,angle_deg\n10,2,3\n20,2,3\n": "3 values but the header names 2 columns",
    "pressure_kpa,angle_deg\n10000,2\n40000,9\n": "40 MPa but it must lie between",
    "pressure_pa,angle_deg\n10,2\n40,9\n": "4e-05 MPa but it must lie between",
    "pressure_kpa,angle_rad\n10,20\n40,90\n": "of 5156.62 ° but at most 1080 °",
    "pressure_kpa,pressure_bar,angle_deg\n10,0.1,2\n20,0.2,3\n": "several columns of pressure",
    "p_kpa,tip angle (deg),bend angle (deg)\n10,1,2\n20,2,3\n": "several columns of angle",
    "pressure_kpa;angle_deg\n10;1.5\n20;2,5\n30;3.5\n": "mixes decimal signs|needs a decimal point",
}


@pytest.mark.parametrize("text", BAD, ids=range(len(BAD)))
def test_what_is_no_curve_is_refused_in_one_sentence(text: str, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=BAD[text]) as caught:
        read(tmp_path, text)
    said = str(caught.value)
    assert "\n" not in said and said.endswith((".", "?")) and len(said) < 400


@pytest.mark.parametrize(
    ("quantity", "branch", "said"),
    [("bend", None, "--quantity is “bend”"), (None, "sideways", "--branch is “sideways”")],
)
def test_unknown_options_are_refused(quantity: str | None, branch: str | None, said: str) -> None:
    with pytest.raises(DesignError, match=said):
        options(quantity, branch)


def test_a_file_that_is_missing_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match="there is no file"):
        load_curve(tmp_path / "none.csv")
