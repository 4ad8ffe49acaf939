"""Names that may name files and folders on every system."""

from __future__ import annotations

import re

from bellows_design.validation.parameters import require
from bellows_design.validation.quoting import quoted

SLUG = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,63}")
_WINDOWS_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)", re.IGNORECASE)


def names_a_file(name: str) -> bool:
    """Whether a file or folder may have that name on every system."""
    return bool(SLUG.fullmatch(name)) and not _WINDOWS_DEVICE.fullmatch(name)


def require_file_name(name: str) -> None:
    """Raise ``ValueError``, which pydantic collects, unless a file may have that name."""
    require(
        names_a_file(name),
        f"name is {quoted(name)} but must be 1 to 64 letters, digits, _ or -, "
        "not begin with - and not be a device of Windows",
    )
