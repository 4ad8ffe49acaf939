"""Viewers as parts of a page that needs no other file."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from functools import cache
from html import escape
from importlib.resources import files
from typing import Any

from bellows_design.web.packing import packed
from bellows_design.web.scene import SceneError, Shown, Surface, frames_of

CONTROLS = ("frames", "fields", "section", "surfaces", "reset", "picture")
"""Parts of the bar below a viewer."""


def viewer_element(
    surfaces: Sequence[Shown],
    *,
    height_px: int = 420,
    label: str = "3D view",
    controls: bool | Sequence[str] = True,
    field: str | None = None,
    frame: float = 0,
    section: str | None = None,
    view: str = "corner",
) -> str:
    """HTML of a viewer with its data inside; the page needs `viewer_script` once, anywhere.

    Args:
        surfaces: What is shown.
        height_px: Of the picture, without the bar below it.
        label: What is shown, for those who do not see it; also the name of a saved picture.
        controls: True for the whole bar below, False for none, or names of `CONTROLS`.
        field: That colours the surfaces at first; None for none.
        frame: Shown at first, from 0.
        section: "x", "y" or "z": the axis the scene is cut along at first; None for no cut.
        view: "corner", "front", "back", "left", "right", "top" or "bottom".

    Raises:
        SceneError: The scene cannot be shown, or no surface has the field or the frame.
    """
    data = packed(surfaces)
    _require_start(surfaces, field, frame)
    options: dict[str, Any] = {
        "height": height_px,
        "label": label,
        "controls": controls if isinstance(controls, bool) else _known(controls),
        "view": view,
        "frame": frame,
    }
    options |= {} if field is None else {"field": field}
    options |= {} if section is None else {"section": {"axis": section}}
    return element("scene", data, options)


def element(kind: str, data: bytes, options: dict[str, Any]) -> str:
    """HTML of a view of one `kind` that `viewer_script` starts."""
    return (
        f'<div class="bellows-view" data-kind="{kind}" '
        f'data-options="{escape(json.dumps(options, allow_nan=False))}">'
        f'<script type="application/octet-stream+base64">{base64.b64encode(data).decode()}</script>'
        "<noscript>This view needs JavaScript.</noscript></div>"
    )


def viewer_script(nonce: str = "") -> str:
    """The `<script>` that starts all viewers of the page; it needs no other file.

    A page whose Content-Security-Policy admits scripts by `nonce` gives it here.
    """
    attribute = f' nonce="{escape(nonce)}"' if nonce else ""
    return f"<script{attribute}>{viewer_bundle()}</script>"


@cache
def viewer_bundle() -> str:
    """JavaScript of the viewer, with three.js; it makes the global `Bellows`."""
    return files(__package__).joinpath("assets", "viewer.js").read_text("utf-8")


def viewer_page(surfaces: Sequence[Shown], title: str = "3D view", **options: Any) -> str:
    """A whole page with one viewer, such as for the frame of a notebook.

    `options` are those of `viewer_element`.
    """
    from bellows_design.web.style import page_style

    shown = viewer_element(surfaces, **({"label": title} | options))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{page_style()}</style>\n</head>\n"
        f'<body class="bare">\n{shown}\n{viewer_script()}\n</body>\n</html>\n'
    )


def _require_start(surfaces: Sequence[Shown], field: str | None, frame: float) -> None:
    names = {one.name for shown in surfaces if isinstance(shown, Surface) for one in shown.fields}
    if field is not None and field not in names:
        raise SceneError(f"no surface has a field “{field}”: {', '.join(sorted(names)) or 'none'}.")
    last = max(len(frames_of(shown)) for shown in surfaces) - 1
    if not 0 <= frame <= last:
        raise SceneError(f"there is no frame {frame}: the last one is {last}.")


def _known(controls: Sequence[str]) -> list[str]:
    for name in controls:
        if name not in CONTROLS:
            raise SceneError(f"a viewer has no control “{name}”: {', '.join(CONTROLS)}.")
    return list(controls)
