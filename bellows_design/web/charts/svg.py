"""SVG as text: elements with attributes and children, everything that is text escaped."""

from __future__ import annotations

from collections.abc import Iterable
from hashlib import sha256
from html import escape

Attribute = str | float | int | None


def tag(name: str, *children: str, **attributes: Attribute) -> str:
    """An element; `children` are elements or text that was escaped.

    Underscores of attribute names become hyphens, one at the end goes (`class_`); None leaves an
    attribute out.
    """
    written = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{_value(value)}"'
        for key, value in attributes.items()
        if value is not None
    )
    return f"<{name}{written}>{''.join(children)}</{name}>" if children else f"<{name}{written}/>"


def text(content: str, x: float, y: float, **attributes: Attribute) -> str:
    """Text at a place."""
    return tag("text", escape(content), x=x, y=y, **attributes)


def path(points: Iterable[tuple[float, float]], close: bool = False) -> str:
    """The `d` of straight lines through points."""
    steps = "L".join(f"{_number(x)} {_number(y)}" for x, y in points)
    return f"M{steps}{'Z' if close else ''}" if steps else ""


def picture(
    title: str, description: str, size: tuple[float, float], body: str, class_: str = "chart"
) -> str:
    """A whole `<svg>` that says to those who do not see it what it shows."""
    name = f"chart-{sha256((title + description + body).encode()).hexdigest()[:10]}"
    said = tag("title", escape(title), id=f"{name}-title")
    said += tag("desc", escape(description), id=f"{name}-desc")
    return tag(
        "svg",
        said,
        body,
        class_=class_,
        viewBox=f"0 0 {_number(size[0])} {_number(size[1])}",
        role="img",
        aria_labelledby=f"{name}-title {name}-desc",
        xmlns="http://www.w3.org/2000/svg",
    )


def _value(value: str | float | int) -> str:
    return escape(value) if isinstance(value, str) else _number(value)


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")
