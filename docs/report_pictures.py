"""The reports of all shipped designs, opened in Chromium, as one picture: `docs/reports.png`.

    python docs/report_pictures.py [FOLDER]

The reports stay in FOLDER, if one is named. Each is shown wide in light, wide in dark and narrow;
the program fails if a page has an error or is wider than its window.
"""

from __future__ import annotations

import sys
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from browser import NARROW, opened, running_browser, wider_than_the_window

from bellows_design.design.shipped import load_design, shipped_designs
from bellows_design.pipeline import examine
from bellows_design.reports.page.findings import findings_of
from bellows_design.reports.page.make import report_html
from bellows_design.store import Store

if TYPE_CHECKING:
    from playwright.sync_api import Browser

PICTURE = Path(__file__).with_name("reports.png")
WIDE, HEIGHT, SHOWN = 1100, 1500, 520
"""px of the window, and the height of each page in the picture."""

COLOURS = 256
"""Of the picture, so chosen that those of small areas, such as a legend's ends, stay."""


def written(name: str, folder: Path) -> Path:
    """The report of a shipped design, as ``bellows report`` makes it."""
    path = folder / f"{name}_report.html"
    if not path.exists():
        found = findings_of(examine(load_design(name), store=Store.usual()))
        path.write_bytes(report_html(found))
    return path


def pictures(browser: Browser, path: Path) -> list[Image.Image]:
    """The top of the page: wide in light, wide in dark, narrow."""
    ways = ((WIDE, "light"), (WIDE, "dark"), (NARROW, "light"))
    return [_picture(browser, path, width, theme) for width, theme in ways]


def _picture(browser: Browser, path: Path, width: int, theme: str) -> Image.Image:
    with opened(browser, path, width=width, height=HEIGHT, theme=theme) as (page, seen):
        page.evaluate("Bellows.startAll()")
        page.wait_for_selector("#deformed .bellows-view[data-ready]", timeout=120_000)
        if wider_than_the_window(page) or seen.all:
            raise SystemExit(f"{path.name}: {seen.all or 'wider than its window'}")
        page.wait_for_timeout(500)
        return Image.open(BytesIO(page.screenshot())).convert("RGB")


def joined(rows: list[list[Image.Image]]) -> Image.Image:
    """A row for each design."""
    small = [
        [each.resize((each.width * SHOWN // each.height, SHOWN)) for each in row] for row in rows
    ]
    gap = 8
    width = max(sum(each.width + gap for each in row) for row in small) + gap
    sheet = Image.new("RGB", (width, (SHOWN + gap) * len(small) + gap), "#8a94a0")
    for number, row in enumerate(small):
        left = gap
        for each in row:
            sheet.paste(each, (left, gap + number * (SHOWN + gap)))
            left += each.width + gap
    return sheet


def main(folder: Path) -> None:
    """All shipped designs."""
    paths = [written(name, folder) for name in shipped_designs()]
    with running_browser() as browser:
        rows = [pictures(browser, path) for path in paths]
    sheet = joined(rows).quantize(COLOURS, Image.Quantize.MAXCOVERAGE)
    sheet.save(PICTURE, optimize=True)
    print(f"{PICTURE}: {PICTURE.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(Path(sys.argv[1]))
    else:
        with TemporaryDirectory() as made:
            main(Path(made))
