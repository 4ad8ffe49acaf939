"""What pictures are made with: PyVista and matplotlib, from the extra ``pictures``."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec

from bellows_design.errors import DesignError


def require_pictures() -> None:
    """Raise ``DesignError`` if either is not installed. Imports nothing."""
    missing = [name for name in ("pyvista", "matplotlib") if find_spec(name) is None]
    if missing:
        raise DesignError(
            f"--png and --pdf need {' and '.join(missing)}, of the extra “pictures”: "
            "pip install -e '.[pictures]'."
        )


@contextmanager
def without_glyph_warnings() -> Iterator[None]:
    """Letters that matplotlib's font does not have are boxes, of which nothing is said."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        yield
