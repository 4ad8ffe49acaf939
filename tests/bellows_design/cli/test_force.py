"""``bellows force``: its answers, its files, and one sentence for what cannot be."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from linear_finger import Uncertainty, linear_law

from bellows_design.errors import DesignError, UnreachedError
from bellows_design.force.scene.solved import Solved

Bellows = Callable[..., tuple[int, str, str]]
CONTRACT = {
    "design", "digest", "scene", "model", "pressure_mpa", "force_n", "error_estimate", "contact",
    "stable", "curve", "by_distance", "air", "seconds", "versions",
}  # fmt: skip


@pytest.fixture(autouse=True)
def _linear(monkeypatch: pytest.MonkeyPatch) -> None:
    """A linear law instead of the unit cell's."""

    def solved(design: Any, scene: Any, pressures: Any, *_: object) -> Solved:
        law = linear_law(rotations=Uncertainty(mesh=0.01))
        return Solved.of(design, scene, pressures, law)

    monkeypatch.setattr("bellows_design.force.curve.solved_with_its_law", solved)


def test_a_blocked_finger_answers_with_all_that_is_promised(bellows: Bellows) -> None:
    status, out, _ = bellows(
        "force", "prototype_1", "--scene", "blocked", "--pressure", "0.05:0.1:0.05", "--json"
    )
    found = json.loads(out)
    assert status == 0 and set(found) >= CONTRACT
    assert (found["scene"], found["model"], found["pressure_mpa"]) == ("blocked", "chain", 0.1)
    assert [each["pressure_mpa"] for each in found["curve"]] == [0.05, 0.1]
    parts = dict(found["error_estimate"])
    assert parts.pop("force_percent") == pytest.approx(sum(parts.values())) and parts
    assert found["by_distance"][0]["force_n"] == pytest.approx(found["force_n"])


@pytest.mark.parametrize("stem", ["a$\\frac{$b", "[bold]scene", "a\x1b[31mb"])
def test_a_files_name_is_shown_as_it_is(stem: str, bellows: Bellows, tmp_path: Path) -> None:
    file, picture = tmp_path / f"{stem}.toml", tmp_path / "x.png"
    file.write_text('kind = "blocked"\n')
    status, out, _ = bellows(
        "force", "prototype_1", "--scene", str(file), "--picture", str(picture),
        "--pressure", "0.05",
    )  # fmt: skip
    assert status == 0 and picture.stat().st_size > 1000
    assert f"prototype_1: {stem}".replace("\x1b", "?") in out


KINDS = {
    "lying": 'kind="free", gravity="down"',
    "cell": 'kind="blocked", distance=4',
    "kept": 'kind="blocked", support="held"',
    "desk": 'kind="blocked", support="wall", distance=6, friction=0.5',
    "load": 'kind="payload", mass_g=20',
    "cup": 'kind="grip", fingers=3, object="sphere", size=30, mass_g=20, distance=18, place=38',
}


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_of_scene_has_an_answer(name: str, bellows: Bellows, tmp_path: Path) -> None:
    files = [tmp_path / "shapes.png", tmp_path / "curves.png"]
    setting = f"scenes={{{name}={{{KINDS[name]}}}}}"
    status, out, err = bellows(
        "force", "prototype_1", "--set", setting, "--scene", name, "--pressure", "0.05", "--json",
        "--picture", str(files[0]), "--plot", str(files[1]),
    )  # fmt: skip
    found = json.loads(out)
    assert status == 0, err
    assert set(found) >= CONTRACT and found["stable"] and found["converged"]
    pressed = name not in ("lying", "load")
    assert (found["force_n"] > 0) == (found["error_estimate"] is not None) == pressed
    assert (found["holds"] is not None) == (name == "cup")
    assert bool(found["by_distance"]) == (name in ("cell", "desk"))
    assert all(file.read_bytes().startswith(b"\x89PNG") for file in files)


def test_a_finger_that_leaves_its_load_cell_has_status_3(bellows: Bellows) -> None:
    """Under a pressure at which the tip turns by more than half a turn."""
    status, out, _ = bellows(
        "force", "prototype_1", "--set", "load.pressure=0.2", "--pressure", "0.1:0.2:0.1"
    )
    assert status == 3
    assert "NOT REACHED: at 0.1" in out and "snaps off the load cell" in " ".join(out.split())


def test_the_table_over_distance_is_printed_on_demand(bellows: Bellows) -> None:
    asked = ("force", "prototype_1", "--pressure", "0.05")
    status, out, _ = bellows(*asked)
    assert status == 0 and "stiffness of the tip" in out and "distance, mm" not in out
    assert "distance, mm" in bellows(*asked, "--by-distance")[1]


def test_pictures_are_written(bellows: Bellows, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    picture, plot = tmp_path / "shapes.png", tmp_path / "curves.png"
    status, _, _ = bellows(
        "force", "prototype_1", "--pressure", "0.05", "--picture", str(picture), "--plot", str(plot)
    )
    assert status == 0
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in (picture, plot))


def test_a_scene_may_be_a_file_or_a_setting(bellows: Bellows, tmp_path: Path) -> None:
    file = tmp_path / "cup.toml"
    lines = ('kind = "grip"', 'object = "box"', "size = 20", "mass_g = 5", "distance = 12")
    file.write_text("\n".join([*lines, "place = 42"]), "utf-8")
    status, out, _ = bellows("force", "prototype_1", "--scene", str(file), "--json")
    found = json.loads(out)
    assert status == 0 and found["scene"] == "cup" and found["holds"] is True
    setting = 'scenes={low={kind="blocked", distance=5}}'
    status, out, _ = bellows("force", "prototype_1", "--set", setting, "--scene", "low", "--json")
    assert status == 0 and json.loads(out)["curve"][-1]["distance_mm"] == 5.0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--scene", "blockd"), "unknown scene “blockd”; did you mean blocked?"),
        (("--scene", "nowhere.toml"), "nowhere.toml"),
        (("--scene", "."), "unknown scene “.”"),
        (
            ("--set", 'scenes={s={kind="squeeze"}}', "--scene", "s"),
            "scenes.s.kind is “squeeze”; known are free, blocked, payload, grip.",
        ),
        (
            (
                "--set",
                'scenes={g={kind="grip", size=5, mass_g=3, distance=80, place=45}}',
                "--scene",
                "g",
            ),
            "the cylinder of size = 5 mm at place = 45 mm is not touched at 0.1 MPa",
        ),
        (("--flow", "-1"), "--flow is -1 L/min but must be 0.01 to 10000 L/min."),
        (("--pressure", "0.1:0.02:0.02"), "must go away from 0 MPa"),
        (
            ("--set", 'scenes={w={kind="blocked", support="wall", distance=90}}', "--scene", "w"),
            "the wall at distance = 90 mm is not reached at 0.1 MPa: the free finger reaches",
        ),
        (
            ("--set", 'scenes={p={kind="payload", mass_g=-3}}', "--scene", "p"),
            "mass_g is -3 g but must be greater than 0 g.",
        ),
        (
            (
                "--set",
                'scenes={g={kind="grip", size=40, mass_g=3, distance=18, place=30}}',
                "--scene",
                "g",
            ),
            "size = 40 mm reaches 2 mm into the finger at rest",
        ),
        (("--picture", "shapes.pdf"), "must end in .png"),
    ],
)
def test_what_cannot_be_gets_one_sentence_and_status_2(
    options: tuple[str, ...], sentence: str, bellows: Bellows
) -> None:
    status, out, err = bellows("force", "prototype_1", *options)
    assert status == 2 and out == ""
    assert sentence in err.strip().splitlines()[-1]


def test_a_finger_without_equilibrium_has_status_3_and_its_last_state(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ending(design: Any, scene: Any, pressures: Any, *_: object) -> Solved:
        law = linear_law()
        respond = law.piece.response

        class Ending:
            length = law.piece.length

            def response(self, pressure: float, loads: Any) -> Any:
                if pressure > 0.04:
                    raise DesignError("the law ends here.")
                return respond(pressure, loads)

        from dataclasses import replace

        return Solved.of(design, scene, pressures, replace(law, piece=Ending()))

    monkeypatch.setattr("bellows_design.force.curve.solved_with_its_law", ending)
    status, out, _ = bellows("force", "prototype_1", "--pressure", "0.02:0.06:0.02", "--json")
    found = json.loads(out)
    assert status == 3 and not found["converged"] and found["message"] == "the law ends here."
    assert found["pressure_mpa"] == pytest.approx(0.04, abs=1e-4) and found["stable"]
    assert len(found["curve"]) == 3


def test_a_cell_that_does_not_reach_its_pressure_has_status_3(
    bellows: Bellows, monkeypatch: pytest.MonkeyPatch
) -> None:
    def unreached(*_: object) -> Solved:
        raise UnreachedError("there is no law of the bubbles: it got no further.")

    monkeypatch.setattr("bellows_design.force.curve.solved_with_its_law", unreached)
    status, _, err = bellows("force", "prototype_1")
    assert status == 3 and "there is no law of the bubbles" in err
