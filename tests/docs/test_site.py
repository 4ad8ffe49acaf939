"""The site of the documentation: it builds without a warning, offline, and holds every page."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

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


@pytest.mark.slow
def test_the_site_builds_without_a_warning_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    pytest.importorskip("sphinx", reason="the site needs the extra docs")
    built = tmp_path / "site"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    done = subprocess.run(
        [*command, "-d", str(tmp_path / "doctrees"), str(SITE), str(built)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    pages = [*built.rglob("*.html"), *built.rglob("*.css")]
    assert built / "tutorial.html" in pages and built / "generated/api-solver.html" in pages
    fetched = {page.name: LOADED.findall(page.read_text("utf-8")) for page in pages}
    assert not {name: found for name, found in fetched.items() if found}
