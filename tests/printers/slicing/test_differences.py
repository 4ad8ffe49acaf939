"""Settings as they were asked for and as they were used."""

from __future__ import annotations

import pytest

from printers.slicing.differences import differences


@pytest.mark.parametrize(
    ("asked", "used"),
    [
        ("0.4", "0.4"),
        ("0.10", "0.1"),
        ("1", "1.0"),
        ("50%", "50.0%"),
        ("G28\\nG92 E0", "G28\\nG92 E0"),
        ("0x0,250x0", "0x0,250x0"),
        ("0,0.5", "0.0,.5"),
    ],
)
def test_equal_values_are_no_difference(asked: str, used: str) -> None:
    assert list(differences({"key": asked}, {"key": used, "other": "1"})) == []


@pytest.mark.parametrize(
    ("asked", "used"),
    [("0.4", "0.41"), ("50%", "50"), ("50", "50%"), ("random", "aligned"), ("1", "1,1"), ("", "0")],
)
def test_other_values_are_named(asked: str, used: str) -> None:
    (difference,) = differences({"key": asked}, {"key": used})
    assert str(difference) == f"key = {asked} became {used}"


def test_a_dropped_setting_is_named() -> None:
    (difference,) = differences({"key": "1", "same": "2"}, {"same": "2"})
    assert str(difference) == "key = 1 was dropped"


def test_what_newer_versions_call_otherwise_is_the_same() -> None:
    key = "ensure_vertical_shell_thickness"
    assert not list(differences({key: "1"}, {key: "enabled"}))
    assert not list(differences({key: "1"}, {}))
    assert list(differences({key: "1"}, {key: "disabled"}))
