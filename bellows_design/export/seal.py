"""JSON files that tell by themselves whether they are as they were written.

The last key of a sealed file is ``sha256``: the SHA-256 of the file's own bytes with these 64
digits written as zeros. So no second file is needed, and any flipped bit breaks the seal. A seal
is no signature: whoever changes a file on purpose can seal it again.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from typing import Any

from bellows_design.files.json_files import json_text

KEY = "sha256"
OPEN = "0" * 64
"""Stands for the digits while they are computed."""

_LAST_LINE = re.compile(rb'"sha256": "([0-9a-f]{64})"\n\}\n\Z')


def sealed(content: Mapping[str, Any]) -> bytes:
    """``content`` as JSON with its seal as the last key, in UTF-8."""
    text = json_text({**content, KEY: OPEN}).encode()
    start = len(text) - len(f'{OPEN}"\n}}\n')
    return text[:start] + hashlib.sha256(text).hexdigest().encode() + text[start + len(OPEN) :]


def seal_holds(content: bytes) -> bool:
    """True if ``content`` ends in the seal of just these bytes."""
    found = _LAST_LINE.search(content[-200:])
    if found is None:
        return False
    start = len(content) - len(content[-200:]) + found.start(1)
    opened = content[:start] + OPEN.encode() + content[start + len(OPEN) :]
    return hashlib.sha256(opened).hexdigest().encode() == found.group(1)
