"""Layer height, and what printing takes."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from printers import PrinterProfile, available_profiles, load_profile
from printers.rules.printing import check_layer_height, check_plastic


def at_height(profile: PrinterProfile, height: float) -> PrinterProfile:
    return profile.model_copy(update={"layer_height": height})


@pytest.mark.parametrize(
    ("height", "verdict"),
    [(0.06, "pass"), (0.1, "pass"), (0.12, "warn"), (0.149, "warn"), (0.15, "fail"), (0.2, "fail")],
)
def test_layers_seal_as_the_printed_vessels_did(
    solids: SimpleNamespace, prusa: PrinterProfile, height: float, verdict: str
) -> None:
    part = solids.part(solids.hollow_box(), at_height(prusa, height))
    (result,) = check_layer_height(part)
    assert (result.verdict, result.measured, result.required) == (verdict, height, 0.1)


def test_a_printer_whose_thicker_layers_were_measured_to_seal_may_have_them(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    measured = prusa.model_copy(update={"layer_height": 0.2, "sealing_layer_height": 0.2})
    (result,) = check_layer_height(solids.part(solids.hollow_box(), measured))
    assert result.verdict == "pass"


@pytest.mark.parametrize("name", available_profiles())
def test_no_shipped_profile_has_layers_that_are_not_known_to_seal(
    solids: SimpleNamespace, name: str
) -> None:
    (result,) = check_layer_height(solids.part(solids.hollow_box(), load_profile(name)))
    assert result.verdict == "pass", result.message


def test_mass_filament_and_time_follow_from_the_volume(
    solids: SimpleNamespace, prusa: PrinterProfile
) -> None:
    block = solids.block((20.0, 20.0, 10.0), (0, 0, 0))  # 4 cm³, 4.4 cm³ of plastic
    found = {r.rule: r for r in check_plastic(solids.part(block, prusa))}
    assert found["mass"].measured == pytest.approx(4.4 * 1.19, abs=0.01)
    assert found["filament_length"].measured == pytest.approx(1.83, abs=0.01)
    # 0.4 mm × 0.1 mm × 15 mm/s of the part in a second, whatever the flow.
    assert found["print_time"].measured == pytest.approx(4000 / 0.6 / 3600, abs=0.01)
    assert {result.verdict for result in found.values()} == {"info"}
