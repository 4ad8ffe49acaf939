"""``bellows evaluate`` on a body of one's own."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from own_body.bodies import bar

from bellows_design.own_body import write_body

Bellows = Callable[..., tuple[int, str, str]]


@pytest.fixture
def file(tmp_path: Path) -> str:
    """A small bar as TOML and STEP."""
    path = tmp_path / "bar.toml"
    write_body(bar(), path)
    return str(path)


def test_a_body_is_evaluated_at_the_pressures_asked_for(
    bellows: Bellows, file: str, tmp_path: Path
) -> None:
    vtu = tmp_path / "bar.vtu"
    asked = ("--pressure", "0.001:0.002:0.001", "--vtu", str(vtu), "--json")
    status, out, _ = bellows("evaluate", file, *asked)
    found = json.loads(out)
    assert status == 0 and found["body"] == "bar" and found["converged"]
    assert [at["pressure_mpa"] for at in found["curve"]] == pytest.approx([0.001, 0.002])
    assert 0 < found["curve"][0]["bending_angle_deg"] < found["bending_angle_deg"]
    assert found["parts"][0]["material"] == "rubber"
    assert vtu.stat().st_size > 1000


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--set", "load.pressure=0.1"), "--set changes designs of bellows"),
        (("--model", "half"), "an own body has one model only"),
        (("--sensitivities",), "leave them out"),
        (("--pressure", "3"), "must be at most 2 MPa"),
    ],
)
def test_options_of_bellows_are_refused_in_one_sentence(
    bellows: Bellows, file: str, options: tuple[str, ...], sentence: str
) -> None:
    status, out, err = bellows("evaluate", file, *options)
    assert status == 2 and not out and sentence in err


def test_other_commands_say_that_they_take_bellows_only(bellows: Bellows, file: str) -> None:
    status, _, err = bellows("run", file)
    assert status == 2 and "is a body of one's own, which only evaluate and compare take" in err
