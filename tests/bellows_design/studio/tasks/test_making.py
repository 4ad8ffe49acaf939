"""What the page offers once a part is approved."""

from __future__ import annotations

from bellows_design.studio.tasks.making import in_order_of_use


def test_the_part_itself_comes_first_and_nothing_is_left_out() -> None:
    names = ["run.json", "a_sheet.md", "a.step", "a_report.html", "manifest.json", "a.stl", "a.3mf"]
    ordered = in_order_of_use(names)
    assert ordered[:4] == ["a.stl", "a.3mf", "a.step", "a_report.html"]
    assert ordered[4:] == ["a_sheet.md", "manifest.json", "run.json"]
