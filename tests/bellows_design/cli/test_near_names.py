"""Wherever a name is taken, an unknown one is answered by the one that is near."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

Bellows = Callable[..., tuple[int, str, str]]
DATA = str(Path(__file__).parents[1] / "data" / "treloar_1944.csv")


@pytest.mark.parametrize(
    ("arguments", "near"),
    [
        (["check", "fingr"], "finger"),
        (["check", "mine.tml"], ".toml"),
        (["check", "part.slt"], ".stl"),
        (["check", "my_desgn.toml"], "“my_design.toml”"),
        (["check", "finger", "--printer", "prusa_i4"], "prusa_i3"),
        (["check", "finger", "--printer", "my_prnter.toml"], "my_printer.toml"),
        (["check", "finger", "--filament", "ninjaflex"], "ninjaflex_85a"),
        (["check", "finger", "--set", "material=ninjaflx"], "ninjaflex"),
        (["check", "finger", "--set", "buble_width=3"], "bubble_width"),
        (["check", "finger", "--set", "presure=0.1"], "load.pressure"),
        (["check", "finger", "--set", "indent.side=outsde"], "outside"),
        (["check", "finger", "--set", 'limits.scenes=["blockd"]'], "blocked"),
        (["check", "finger", "--printer", "my_printer.toml"], "nozzle_diameter"),
        (["check", "part.stl", "--orientation", "atuo"], "auto"),
        (["force", "finger", "--scene", "blockd"], "blocked"),
        (["force", "finger", "--scene", "my_scene.toml"], "support"),
        (["design", "finger", "-o", "x.stp"], ".step"),
        (["evaluate", "finger", "--vtu", "x.vtk"], "“x.vtu”"),
        (["study", "sweep", "finger", "--vary", "buble_width=1:2:3"], "bubble_width"),
        (["verify", "exprts"], "“exports”"),
        (["check", "--quiet", "tensil.stl"], "“tensile.stl”"),
        (["fit", "tensile.csw"], "“tensile.csv”"),
        (["fit", DATA, "--model", "ogden4"], "ogden3"),
        (["fit", DATA, "--branch", "frist"], "first"),
        (["fit", DATA, "--decimal", "coma"], "comma"),
        (["fit", DATA, "--columns", "strian,stress_mpa"], "strain"),
        (["fit", DATA, "--units", "stres=MPa"], "stress"),
        (["schema", "evalute"], "evaluate"),
    ],
)
@pytest.mark.thorough
def test_what_is_near_is_named(
    arguments: list[str],
    near: str,
    bellows: Bellows,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "exports").mkdir()
    for name in ("my_design.toml", "tensile.csv", "tensile.stl"):
        (tmp_path / name).write_text("")
    (tmp_path / "my_scene.toml").write_text('kind = "blocked"\nsuport = "wall"\n')
    (tmp_path / "my_printer.toml").write_text('name="p"\nextends="prusa_i3"\nnozle_diameter=0.4\n')
    status, _, err = bellows(*arguments)
    assert status == 2 and f"did you mean {near}" in err and err.count("\n") == 1


def test_a_file_where_an_export_is_asked_for_is_called_one(
    bellows: Bellows, tmp_path: Path
) -> None:
    (tmp_path / "finger.stl").touch()
    status, _, err = bellows("verify", str(tmp_path / "finger.stl"))
    assert status == 2 and "is a file; an export is a folder." in err
