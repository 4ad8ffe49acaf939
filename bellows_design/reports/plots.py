"""What all pictures share: matplotlib from the extra ``pictures``, their size and colours."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.errors import DesignError
from bellows_design.files.atomic import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")
"""Distinguishable for colour-blind people too (Okabe and Ito)."""


def require_matplotlib() -> None:
    """Raise ``DesignError`` if it is not installed. Imports nothing."""
    if find_spec("matplotlib") is None:
        raise DesignError(
            "a plot needs matplotlib, which comes with the extra “pictures”: "
            "pip install -e '.[pictures]'."
        )


@contextmanager
def one_axes(title: str, path: Path) -> Iterator[Axes]:
    """One pair of axes; after the block they are written to ``path`` as PNG, as ``two_axes``."""
    with _axes(title, path, 1, (7.5, 5.2)) as (axes,):
        yield axes


@contextmanager
def two_axes(title: str, path: Path) -> Iterator[tuple[Axes, Axes]]:
    """Two axes beside each other; after the block they are written to ``path`` as PNG.

    The file is complete or not there. Raises ``DesignError`` without matplotlib.
    """
    with _axes(title, path, 2, (11, 4.8)) as (left, right):
        yield left, right


@contextmanager
def _axes(title: str, path: Path, number: int, size: tuple[float, float]) -> Iterator[list[Axes]]:
    require_matplotlib()
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    figure.suptitle(title, parse_math=False)  # $ is a sign like others
    yield list(figure.subplots(1, number, squeeze=False)[0])
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=130, format="png")
