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


def json_text(content: Mapping[str, Any], only_ascii: bool = False) -> str:
    """``content`` as JSON: numbers that are not finite, which JSON lacks, become null.

    Bytes of a file's name that are no text become ``?``; ``only_ascii`` writes all other
    characters beyond it as JSON's escapes.
    """
    plain = _plain(content)
    return json.dumps(plain, indent=2, ensure_ascii=only_ascii, allow_nan=False) + "\n"


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {_text(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, int | None):
        return value
    if isinstance(value, str | Path):
        return _text(value)
    number = float(value)  # also NumPy's
    return number if math.isfinite(number) else None


def _text(value: object) -> str:
    return str(value).encode("utf-8", "replace").decode("utf-8")
