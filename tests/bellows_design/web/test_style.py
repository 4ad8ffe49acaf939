"""The look of pages: readable colours, alike in page and viewer, verdicts by more than colour."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from bellows_design.web.style import page_style

VIEWER = Path(__file__).parents[3] / "bellows_design/web/javascript/source/style.js"
THEMES = {
    "light": ":root {",
    "dark": ":root:not([data-theme",
    "chosen dark": ':root[data-theme="dark"]',
}
TEXTS = [
    (text, ground)
    for text in ("ink", "muted", "accent", "pass", "warn", "fail")
    for ground in ("page", "card", "stage")
] + [
    ("pass", "pass-soft"),
    ("warn", "warn-soft"),
    ("fail", "fail-soft"),
    ("ink", "accent-soft"),
    ("muted", "none-soft"),
    ("muted", "faint"),
    ("card", "accent"),
]


def colours(theme: str) -> dict[str, str]:
    """Custom properties of a theme, without their prefix."""
    style = page_style()
    begin = style.index(THEMES[theme])
    block = style[begin : style.index("}", begin)]
    return dict(re.findall(r"--bellows-([\w-]+): (#[0-9a-f]{6});", block))


def luminance(colour: str) -> float:
    """Relative luminance as WCAG 2 defines it."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [x / 12.92 if x <= 0.03928 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize(("text", "ground"), TEXTS)
def test_text_stands_out_from_what_is_behind_it(theme: str, text: str, ground: str) -> None:
    """WCAG 2 asks a ratio of 4.5."""
    found = colours(theme)
    one, other = sorted((luminance(found[text]), luminance(found[ground])), reverse=True)
    assert (one + 0.05) / (other + 0.05) >= 4.5


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("number", range(1, 7))
def test_curves_stand_out_from_their_card(theme: str, number: int) -> None:
    """WCAG 2 asks a ratio of 3 of what is no text."""
    found = colours(theme)
    one, other = luminance(found[f"series-{number}"]), luminance(found["card"])
    assert (max(one, other) + 0.05) / (min(one, other) + 0.05) >= 3


def test_a_dark_page_is_the_same_by_the_system_and_by_choice() -> None:
    assert colours("dark") == colours("chosen dark")
    assert colours("dark").keys() == colours("light").keys()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_viewer_has_the_page_s_colours(theme: str) -> None:
    source = VIEWER.read_text("utf-8")
    begin = source.index(f"const {theme.upper()} = {{")
    own = dict(re.findall(r'(\w+): "(#[0-9a-f]{6})"', source[begin : source.index("};", begin)]))
    page = colours(theme)
    assert len(own) == 12 and own == {name: page[name] for name in own}


def test_badges_differ_by_a_sign_too() -> None:
    signs = re.findall(r'\.badge(\.\w+)?::before \{ content: "(.)"', page_style())
    assert {kind for kind, _ in signs} == {"", ".pass", ".warn", ".fail"}
    assert len({sign for _, sign in signs}) == 4


def test_the_style_loads_nothing() -> None:
    assert "@import" not in page_style() and "url(" not in page_style()
    assert page_style().count("{") == page_style().count("}")
