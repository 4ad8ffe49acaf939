"""Results as JSON: as text, and as files that are complete or not there."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bellows_design.files.atomic import replacing


def write_json(content: Mapping[str, Any], path: Path) -> None:
    """Write ``content`` as JSON, completely or not at all.

    Raises:
        OSError: The file cannot be written.
    """
    with replacing(path) as temporary:
        temporary.write_text(json_text(content), "utf-8")


def json_text(content: Mapping[str, Any]) -> str:
    """``content`` as JSON; numbers that are not finite, which JSON lacks, become null."""
    return json.dumps(_finite(content), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _finite(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(inner) for inner in value]
    if isinstance(value, str | int | None):
        return value
    if isinstance(value, Path):
        return str(value)
    number = float(value)  # also NumPy's
    return number if math.isfinite(number) else None
