"""The files of the page: found once, by their names; no path of a request is ever joined."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable

KINDS = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".woff2": "font/woff2",
}
"""What is handed out, by the ends of names."""

INDEX = "page/index.html"


@dataclass(frozen=True)
class Asset:
    """Content of a file, and its type."""

    content: bytes
    kind: str


def assets() -> Mapping[str, Asset]:
    """The page's own files below ``page/``, the viewer and the style that all pages share."""
    own = dict(_below(files("bellows_design.studio") / "page", "page/"))
    shared = dict(_below(files("bellows_design.web") / "assets", ""))
    return own | shared | {"style.css": shared["page.css"]}


def _below(folder: Traversable, prefix: str) -> Iterator[tuple[str, Asset]]:
    if not folder.is_dir():
        return
    for each in folder.iterdir():
        kind = next((kind for end, kind in KINDS.items() if each.name.endswith(end)), None)
        if each.is_dir():
            yield from _below(each, f"{prefix}{each.name}/")
        elif kind is not None:
            yield f"{prefix}{each.name}", Asset(each.read_bytes(), kind)
