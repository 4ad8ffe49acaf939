"""Own bodies under pressure, volume, weight and obstacles, against closed forms."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import cadquery as cq
import numpy as np
import pytest
from own_body.bodies import MU, STIFF, bar, box, part

from bellows_design import DesignError, OwnBody
from bellows_design.evaluation import BodyEvaluation, evaluate
from bellows_design.own_body.analysis.evaluate import evaluate as evaluated

WEIGHT = 1000 * 9.80665 * 1e-9
"""N/mm³ of 1000 kg/m³."""


def column(*parts: dict[str, object], films: tuple[dict[str, object], ...] = ()) -> OwnBody:
    """A quarter of a column that hangs from its upper end, free to become thinner."""
    surfaces = {"top": ">Z", "tip": "<Z", "x": "<X", "y": "<Y", "sides": [">X", ">Y"]}
    return OwnBody.of(
        {"name": "column", "parts": list(parts), "surfaces": surfaces, "gravity": {},
         "films": list(films),
         "supports": {"clamped": [], "symmetry": {"top": "z", "x": "x", "y": "y"}},
         "mesh": {"size": 4.0}}
    )  # fmt: skip


def test_a_column_becomes_longer_by_its_weight_as_hooke_says() -> None:
    """By w L² / 2E; the strain of 1e-3 leaves a thousandth to its nonlinearity."""
    found = evaluated(column(part(box(2, 2, 20), density_kg_m3=1000.0)), meshes=1)
    _, _, down = found.end.tip_displacement_mm or ()
    assert down == pytest.approx(-WEIGHT * 20**2 / 2 / (3 * MU), rel=3e-3)
    assert found.end.bending_angle_deg == pytest.approx(0, abs=1e-6)
    assert found.end.cavity_volume_mm3 is None and found.end.contact_force_n is None


def test_films_on_a_column_bear_their_part_of_its_weight() -> None:
    """As stiff as the column together, and contracting like it: half of the elongation is left.

    The weight of the rubber gets to the films by shear, which adds less than a hundredth.
    """
    area, perimeter = 2.0 * 2.0, 2.0 + 2.0
    thickness = 0.1
    modulus = 3 * MU * area / (perimeter * thickness)
    film = {"surface": "sides", "young_modulus": modulus, "poisson_ratio": 0.5,
            "thickness": thickness}  # fmt: skip
    found = evaluated(column(part(box(2, 2, 20), density_kg_m3=1000.0), films=(film,)), meshes=1)
    _, _, down = found.end.tip_displacement_mm or ()
    assert down == pytest.approx(-WEIGHT * 20**2 / 2 / (6 * MU), rel=1e-2)


def test_a_column_of_two_materials_becomes_longer_part_by_part() -> None:
    """The lower part hangs from the upper, each with its own stiffness and density.

    Where they meet the stiff one keeps the soft one from becoming thinner, over a tenth or so of
    their width of 4 mm, so that it becomes longer by some per cent less.
    """
    upper = part(box(2, 2, 20, at=(0, 0, 20)), "upper", density_kg_m3=500.0)
    lower = part(box(2, 2, 20), "lower", density_kg_m3=2000.0, material=STIFF)
    found = evaluated(column(upper, lower), meshes=1)
    soft, stiff = 3 * MU, 300 * MU
    hanging = WEIGHT * (2.0 * 20 * 20 + 0.5 * 20**2 / 2) / soft
    own = WEIGHT * 2.0 * 20**2 / 2 / stiff
    _, _, down = found.end.tip_displacement_mm or ()
    assert down == pytest.approx(-(hanging + own), rel=0.05)
    above, below = found.parts
    assert (above.name, below.name) == ("upper", "lower")
    assert above.strain.highest > 50 * below.strain.highest


@cache
def ball() -> BodyEvaluation:
    """An eighth of a ball, blown up to eight times the volume of its air."""
    shell = cq.Workplane().sphere(6).cut(cq.Workplane().sphere(5))
    corner = cq.Workplane().box(6, 6, 6, centered=False)
    surfaces = {"x": "<X", "y": "<Y", "z": "<Z", "cavity": {"box": [[1, 1, 1], [2.9, 2.9, 2.9]]}}
    body = OwnBody.of(
        {"name": "ball", "parts": [part(shell.intersect(corner))], "surfaces": surfaces,
         "supports": {"clamped": [], "symmetry": {"x": "x", "y": "y", "z": "z"}},
         "load": {"largest_volume": 8.0, "points": 7}, "mesh": {"size": 2.5}}
    )  # fmt: skip
    return evaluated(body, meshes=1)


def ball_pressure(volume: float) -> float:
    """Of a neo-Hookean ball at a multiple of its air's volume, MPa."""
    inner = volume ** (1 / 3)
    outer = (1 + (volume - 1) * (5 / 6) ** 3) ** (1 / 3)

    def part(stretch: float) -> float:
        return 2 / stretch + 1 / (2 * stretch**4)

    return MU * (part(outer) - part(inner))


def test_a_ball_is_blown_up_past_its_highest_pressure() -> None:
    found = ball()
    assert found.converged and len(found.curve) == 7
    rest = 4 / 3 * np.pi * 5**3
    ratios = [(at.cavity_volume_mm3 or 0) / rest for at in found.curve]
    assert ratios == pytest.approx(
        [2, 3, 4, 5, 6, 7, 8], rel=0.01
    )  # the mesh's air is a little less
    pressures = [at.pressure_mpa for at in found.curve]
    assert pressures == pytest.approx([ball_pressure(ratio) for ratio in ratios], rel=0.02)
    assert max(pressures) > 1.05 * pressures[-1]
    highest = max(ball_pressure(ratio) for ratio in np.linspace(1.5, 8, 500))
    assert found.limit_pressure_mpa == pytest.approx(highest, rel=0.02)
    assert found.end.tip_displacement_mm is None and found.end.chord_angle_deg is None


def test_a_column_between_two_planes_presses_on_them_as_hard_as_on_its_sides() -> None:
    """It is incompressible: its sides are pressed, it cannot become longer, and nothing moves.

    By what the contact lets it in, a thousandth of its length, it does.
    """
    pressure, side = 0.01, 2.0
    body = OwnBody.of(
        {"name": "column", "parts": [part(box(side, side, 4))],
         "surfaces": {"top": ">Z", "below": "<Z", "x": "<X", "y": "<Y", "sides": [">X", ">Y"]},
         "supports": {"clamped": [], "symmetry": {"top": "z", "x": "x", "y": "y"}},
         "pressurised": "sides", "load": {"pressure": pressure},
         "obstacles": [{"surface": "below", "point": [0, 0, 0], "normal": [0, 0, 2]}],
         "tip": {"point": [side, side, 1]}, "mesh": {"size": 2.0}}
    )  # fmt: skip
    found = evaluated(body, meshes=1)
    assert found.end.contact_force_n == pytest.approx(pressure * 8 * side**2, rel=1e-2)
    assert found.end.tip_displacement_mm == pytest.approx((0, 0, 0), abs=0.02)


@cache
def bent() -> BodyEvaluation:
    """The bar with its weight, on two meshes, read at half of its pressure as well."""
    return evaluate(bar(gravity={}), pressures=[0.002])


@pytest.mark.thorough
def test_a_bar_bends_away_from_its_hole_further_the_more_it_is_under_pressure() -> None:
    found = bent()
    assert found.converged and found.stable and not found.warnings
    half, whole = found.curve
    assert half.pressure_mpa == pytest.approx(0.002) and whole == found.end
    weight = found.path[0]
    assert weight.pressure_mpa == 0 and (weight.bending_angle_deg or 0) > 0
    assert (weight.bending_angle_deg or 0) < (half.bending_angle_deg or 0)
    assert (half.bending_angle_deg or 0) < (whole.bending_angle_deg or 0)
    assert 0 < (whole.chord_angle_deg or 0) < (whole.bending_angle_deg or 0)
    assert whole.tip_displacement_mm is not None and whole.tip_displacement_mm[1] == 0


def test_the_chord_is_that_from_the_clamp_to_the_tip() -> None:
    """Both ends at the height of their faces' centres, 5 mm."""
    moved = np.array(bent().end.tip_displacement_mm)
    angle = np.degrees(np.arctan2(-moved[2], 20 + moved[0]))
    assert bent().end.chord_angle_deg == pytest.approx(angle, rel=1e-9)


def test_the_estimated_error_is_that_between_two_meshes() -> None:
    found = bent()
    coarse, fine = (each.reading for each in found.meshes)
    assert len(found.computation.solved) == 2
    estimate = found.error_estimate
    change = abs((coarse.bending_angle_deg or 0) / (fine.bending_angle_deg or 1) - 1)
    assert estimate.bending_angle_percent == pytest.approx(200 * max(change, 0.005), rel=1e-6)
    assert estimate.tip_displacement_percent and estimate.max_von_mises_percent
    assert estimate.contact_force_percent is None and estimate.pressure_percent is None


def test_the_air_of_both_halves_is_read() -> None:
    undeformed = bent().path[0].cavity_volume_mm3
    assert undeformed == pytest.approx(14 * 4 * 3, rel=0.02)


def test_the_chord_of_a_whole_body_lies_in_its_plane_of_symmetry() -> None:
    """Upper half of a wedge: the faces at its ends have their centres at different heights."""
    outline = cq.Workplane("XZ").polyline([(0, 0), (10, 0), (10, 1), (0, 3)]).close()
    wedge = OwnBody.of(
        {
            "name": "wedge", "parts": [part(outline.extrude(4))], "pressurised": "tip",
            "surfaces": {"root": "<X", "tip": ">X", "middle": "<Z"},
            "supports": {"symmetry": {"middle": "z"}}, "load": {"pressure": -0.003},
            "mesh": {"size": 4.0},
        }
    )  # fmt: skip
    found = evaluated(wedge, meshes=1).end
    assert found.chord_angle_deg == pytest.approx(0, abs=1e-9) and found.bending_angle_deg == 0
    assert found.tip_displacement_mm is not None and found.tip_displacement_mm[0] > 0.1


def test_a_path_that_ends_at_a_limit_names_the_load_that_goes_on() -> None:
    limited = replace(bent(), converged=False, limit_pressure_mpa=0.0035)
    assert any("load.largest_volume" in text for text in limited.warnings)


def test_weight_across_a_plane_of_symmetry_is_warned_of() -> None:
    tilted = replace(bent(), body=bar(gravity={"direction": [0, -1, -1]}))
    assert any("across the plane of symmetry “middle”" in text for text in tilted.warnings)


def test_a_name_whose_faces_lie_between_parts_is_refused() -> None:
    surfaces = {"root": "<X", "skin": ">X", "middle": {"box": [[1, 1, 2], [9, 3, 2]]}}
    parts = [part(box(10, 4, 2), "low"), part(box(10, 4, 2, at=(0, 0, 2)), "high")]
    loads = {"pressurised": "skin", "load": {"pressure": 0.001}, "mesh": {"size": 4.0}}
    body = OwnBody.of({"name": "two", "parts": parts, "surfaces": surfaces, **loads})
    with pytest.raises(DesignError, match=r"surfaces.middle lies between parts: .* low\|high"):
        evaluated(body, meshes=1)


def test_a_point_outside_of_the_body_is_refused() -> None:
    with pytest.raises(DesignError, match="lies outside of the body"):
        evaluated(bar(tip={"point": [30, 0, 0]}), meshes=1)


@pytest.mark.parametrize(
    ("body", "asked", "sentence"),
    [
        (bar(), {"pressures": [0.005]}, "must lie between 0"),
        (bar(), {"accuracy_percent": 1000}, "accuracy = 1000 %"),
        (bar(load={"largest_volume": 2.0}), {"pressures": [0.001]}, "load.points"),
        (bar(), {"model": "half"}, "takes no model"),
    ],
)
def test_what_cannot_be_asked_is_refused(
    body: OwnBody, asked: dict[str, object], sentence: str
) -> None:
    with pytest.raises(DesignError, match=sentence):
        evaluate(body, **asked)
