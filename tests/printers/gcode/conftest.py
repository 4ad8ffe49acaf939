"""G-code written by hand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from printers.gcode.reading import GCode, read_gcode


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., GCode]:
    """Reads text as a file of G-code, with filament of 1.75 mm."""

    def reading(text: str | bytes, filament_diameter: float | None = 1.75) -> GCode:
        path = tmp_path / "written.gcode"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_gcode(path, filament_diameter)

    return reading
