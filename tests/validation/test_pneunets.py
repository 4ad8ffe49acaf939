"""The silicone actuators: their bodies, and what is read off curves."""

from __future__ import annotations

import numpy as np
import pytest
from pneunets.body import Actuator, mesh, solid
from pneunets.comparison import DATA
from pneunets.features import Curve, computed_curve, measured_knee
from stored import results_of

BODY = Actuator(chambers=5, wall=7.0)


def volume(body: Actuator) -> float:
    """Of half the silicone in front of the clamp, mm^3."""
    outside = body.free_length * body.half_width * (body.height + body.layer)
    places = body.chambers - body.missing
    between = (places - 1) * body.wall * 1.0 * 2.0
    return outside - places * 2.0 * 4.0 * 8.0 - between


@pytest.mark.parametrize(
    "body", [BODY, Actuator(7, 7.0, layer=0.0, film=0.2), Actuator(5, 10.0, clamp=5.0, missing=1)]
)
def test_a_body_has_the_published_dimensions(body: Actuator) -> None:
    assert solid(body).Volume() == pytest.approx(volume(body))
    assert body.half_width == 4 + body.wall
    assert body.height == 8 + body.wall


def test_published_lengths() -> None:
    lengths = [Actuator(count, wall).length for count, wall in ((5, 7.0), (7, 7.0), (5, 10.0))]
    assert lengths == [52, 70, 70]


def test_film_and_clamp_share_nodes_with_the_silicone() -> None:
    body = Actuator(2, 7.0, layer=0.0, film=0.2, clamp=5.0)
    found = mesh(body, 4.0, 8.0)
    assert set(found.regions) == {"silicone", "film", "held"}
    assert all(len(found.surfaces[f"silicone|{name}"]) for name in ("film", "held"))
    lowest = found.nodes[found.triangles("cavity")].reshape(-1, 3)[:, 2].min()
    assert lowest == pytest.approx(0.0, abs=1e-9)  # the film closes the chambers itself


def test_a_value_is_that_of_the_last_time_the_path_is_at_a_pressure() -> None:
    curve = Curve(np.array([0.0, 2.0, 1.0, 3.0]), np.array([0.0, 10.0, 20.0, 30.0]))
    assert curve.at(1.5) == pytest.approx(22.5)
    assert np.isnan(curve.at(4.0))


def test_the_knee_of_a_computed_curve_is_where_it_is_steepest() -> None:
    angle = np.linspace(0.0, 40.0, 60)
    pressure = 35 + 6 * np.tanh((angle - 25) / 8) * abs(np.tanh((angle - 25) / 8)) + 0.2 * angle
    readings = {
        "volume_mm3": np.exp(angle / 10),
        "pressure_kpa": pressure - pressure[0],
        "angle_deg": angle,
    }
    expected = float(np.interp(25.0, angle, readings["pressure_kpa"]))
    assert computed_curve(readings, "angle_deg").knee == pytest.approx(expected, abs=0.2)


def test_the_knee_of_a_path_with_a_limit_point_is_there() -> None:
    angle = np.linspace(0.0, 40.0, 400)
    curve = Curve(30 + angle - 0.04 * angle**2 + 0.0005 * angle**3, angle)
    assert curve.knee == pytest.approx(curve.pressure[angle < 25].max(), abs=1e-9)


def test_measured_knees_are_those_of_the_publication() -> None:
    knees = {body: measured_knee(table) for body, table in DATA["angle"].items()}
    assert knees == {"c5-w7": 36.0, "c7-w7": 35.0, "c5-w10": 44.0}


FORCED = [name for name in results_of("pneunets") if name.startswith("force")]


@pytest.mark.parametrize("name", FORCED)
def test_the_plate_bears_what_the_clamp_holds(name: str) -> None:
    readings = results_of("pneunets")[name].readings
    # the tolerance of a solve leaves 0.4 mN where the plate begins to touch
    assert readings["force_n"] == pytest.approx(readings["clamp_force_n"], rel=2e-3, abs=1e-3)
