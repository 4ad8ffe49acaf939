"""What is packed comes back within its bounds, and is small."""

from __future__ import annotations

import base64
from dataclasses import replace

import numpy as np
import pytest
from shapes_to_show import bent_grid, block, sheared
from unpacking import unpacked

from bellows_design.web.packing import packed
from bellows_design.web.scene import Field, Lines, SceneError, Surface


def test_positions_come_back_within_half_a_step_of_the_box_of_all_frames() -> None:
    surface = bent_grid(900, 4)
    found = unpacked(packed([surface])).positions(0)
    box = np.ptp(surface.positions, axis=(0, 1))
    assert found.shape == surface.positions.shape
    assert np.all(np.abs(found - surface.positions).max(axis=(0, 1)) <= box / 65535 / 2 * 1.0001)


def test_values_come_back_within_half_a_step_of_their_range() -> None:
    surface = bent_grid(900, 4)
    values = np.asarray(surface.fields[0].values)
    found = unpacked(packed([surface])).values(0, 0)
    assert np.abs(found - values).max() <= np.ptp(values) / 65534 / 2 * 1.0001


def test_missing_values_stay_missing_and_one_frame_serves_all() -> None:
    surface = sheared()
    thickness = np.asarray(surface.fields[1].values)
    found = unpacked(packed([surface])).values(0, 1)
    assert found.shape == (1, 8)
    np.testing.assert_array_equal(found[0], thickness)


def test_cells_come_back_exactly_also_beyond_16_bit() -> None:
    many = bent_grid(70_000, 1)
    assert many.positions.shape[1] > 65536
    found = unpacked(packed([many, sheared()]))
    np.testing.assert_array_equal(found.cells(0), many.triangles)
    np.testing.assert_array_equal(found.cells(1), sheared().triangles)
    widths = [surface["cells"]["bytes"] for surface in found.header["surfaces"]]
    assert widths == [4, 2]


def test_lines_and_what_they_are_called_come_back() -> None:
    points, _ = block(1, 2, 3)
    lines = Lines("Kante <b>", np.array([[0, 1], [1, 2]]), points, "#aa0011", visible=False)
    found = unpacked(packed([sheared(), lines]))
    np.testing.assert_array_equal(found.cells(1), lines.segments)
    np.testing.assert_allclose(found.positions(1)[0], points, atol=3 / 65535)
    about = found.header["surfaces"][1]
    assert (about["name"], about["colour"], about["visible"]) == ("Kante <b>", "#aa0011", False)
    assert found.header["surfaces"][0]["frame_labels"][2] == "0.04 MPa"
    assert found.header["surfaces"][0]["fields"][0]["limit"] == 0.8


def test_eleven_frames_of_30_000_points_take_less_than_three_megabytes_of_a_page() -> None:
    size = len(base64.b64encode(packed([bent_grid(30_000, 11)])))
    assert size < 3e6, f"{size / 1e6:.2f} MB"


def test_a_flat_surface_and_an_even_field_come_back() -> None:
    points, triangles = block(5, 5, 0)
    even = Field("even", "", np.full(8, 3.25))
    found = unpacked(packed([Surface("flat", triangles, points, (even,))]))
    np.testing.assert_allclose(found.positions(0)[0], points, atol=5 / 65535)
    np.testing.assert_array_equal(found.values(0, 0), 3.25)


BLOCK, TRIANGLES = block(1, 1, 1)
GOOD = Surface("part", TRIANGLES, BLOCK)
NOT_FINITE = np.where(np.arange(24).reshape(8, 3) == 5, np.nan, BLOCK)


@pytest.mark.parametrize(
    ("surfaces", "sentence"),
    [
        ([], "nothing to show"),
        ([GOOD, GOOD], "two surfaces have the same name, “part”"),
        ([replace(GOOD, positions=BLOCK[:, :2])], r"shape \(1, 8, 2\), not \(k, n, 3\)"),
        ([replace(GOOD, triangles=TRIANGLES[:, :2])], r"shape \(12, 2\), not \(m, 3\)"),
        ([replace(GOOD, triangles=TRIANGLES[:0])], r"shape \(0, 3\)"),
        ([replace(GOOD, triangles=TRIANGLES * 1.0)], "not whole numbers"),
        ([replace(GOOD, triangles=TRIANGLES + 1)], "names point 8, of 8"),
        ([replace(GOOD, triangles=TRIANGLES - 1)], "names point -1, of 8"),
        ([replace(GOOD, positions=NOT_FINITE)], "a coordinate is not a finite number"),
        ([replace(GOOD, frame_labels=("a", "b"))], "2 labels for 1 frames"),
        ([replace(GOOD, opacity=1.5)], "opacity is 1.5"),
        ([replace(GOOD, fields=(Field("t", "mm", np.zeros(7)),))], r"“t” has the shape \(7,\)"),
        ([replace(GOOD, fields=(Field("t", "mm", np.full(8, np.inf)),))], "infinite"),
        ([replace(GOOD, fields=(Field("t", "", np.zeros(8), limit=np.nan),))], "“limit” of its"),
        ([replace(GOOD, fields=(Field("t", "", np.zeros(8)),) * 2)], "two of its fields"),
    ],
)
def test_what_cannot_be_shown_is_refused_with_a_sentence(
    surfaces: list[Surface], sentence: str
) -> None:
    with pytest.raises(SceneError, match=sentence):
        packed(surfaces)


def test_a_colour_is_refused_unless_it_is_one() -> None:
    with pytest.raises(ValueError, match="“red; x” is no colour"):
        packed([replace(GOOD, colour="red; x")])
