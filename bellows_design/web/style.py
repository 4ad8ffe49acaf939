"""The look of all pages: light and dark, on paper, from 360 pixels on."""

from __future__ import annotations

from functools import cache
from importlib.resources import files


@cache
def page_style() -> str:
    """CSS of a page: text, tables, cards, badges, charts; its custom properties begin --bellows-.

    `<html data-theme="dark">` or `"light"` overrides what the reader's system prefers.
    """
    return files(__package__).joinpath("assets", "page.css").read_text("utf-8")
