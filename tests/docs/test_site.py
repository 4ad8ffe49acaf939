"""The site of the documentation: it builds without a warning, offline, and holds every page."""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import NARROW, WIDE, ShownTheme, hard_to_read, opened, wider_than_the_window

if TYPE_CHECKING:
    from playwright.sync_api import Browser

ROOT = Path(__file__).parents[2]
SITE = ROOT / "docs"
LOADED = re.compile(
    r"""<(?:script|link|img|iframe|source|video|audio|object|embed)\b[^>]*?"""
    r"""\b(?:src|href|data)\s*=\s*["'](?:https?:)?//[^"']+|"""
    r"""url\(\s*["']?(?:https?:)?//[^)]+|@import\s+(?:url\()?["']?(?:https?:)?//[^;]+"""
)
"""What a browser fetches from elsewhere to show a page; a link to follow is none."""


def test_loads_from_elsewhere_are_found() -> None:
    fetched = (
        '<script src="https://cdn.example/x.js"></script>',
        '<link rel="stylesheet" href="//fonts.example/css">',
        "src: url('https://fonts.example/a.woff2')",
        '@import "https://fonts.example/css";',
    )
    assert all(LOADED.search(page) for page in fetched)
    assert not LOADED.search('<a href="https://cadquery.readthedocs.io">CadQuery</a>')


@dataclass(frozen=True)
class Site:
    """A built site, the status of the build and what it said of mistakes."""

    folder: Path
    status: int
    said: str


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Site:
    pytest.importorskip("sphinx", reason="the site needs the extra docs")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    done = subprocess.run(
        [*command, "-d", str(folder / "doctrees"), str(SITE), str(folder / "site")],
        capture_output=True,
        text=True,
        check=False,
    )
    return Site(folder / "site", done.returncode, done.stderr)


@pytest.mark.slow
def test_the_site_builds_without_a_warning_and_loads_nothing_from_elsewhere(site: Site) -> None:
    assert site.status == 0 and not site.said, site.said
    pages = [*site.folder.rglob("*.html"), *site.folder.rglob("*.css")]
    assert site.folder / "tutorial.html" in pages
    assert site.folder / "generated/api-solver.html" in pages
    fetched = {page.name: LOADED.findall(page.read_text("utf-8")) for page in pages}
    assert not {name: found for name, found in fetched.items() if found}


LOOKED_AT = ("index", "tutorial", "json", "generated/commands", "generated/gallery")


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.parametrize(("width", "theme"), [(NARROW, "light"), (WIDE, "dark")])
def test_pages_are_as_wide_as_the_window_and_can_be_read(
    site: Site, browser: Browser, width: int, theme: ShownTheme
) -> None:
    for name in LOOKED_AT:
        page_file = site.folder / f"{name}.html"
        with opened(browser, page_file, width=width, theme=theme) as (page, seen):
            assert not wider_than_the_window(page), name
            assert not seen.all, name
            assert not hard_to_read(page), name
