"""The digest of a design: the same for the same part, material, load and limits.

Stored results and manifests are found by it, so it must outlive versions of this program. Hence
one rule for all fields that come later: a field that is not among ``FIRST_FIELDS`` is left out
while it has its default, and counts as soon as it differs.
"""

from __future__ import annotations

import hashlib
import json
from typing import Any

from pydantic import BaseModel

LABELS = {
    "name",
    "description",
    "material.name",
    "material.source",
    "material.valid_strain",
    "printer.name",
    "printer.description",
    "printer.slicer.sources",
    "printer.filament.name",
    "printer.filament.description",
    "printer.filament.sources",
}
"""Fields that name a design without changing what is built or decided."""

FIRST_FIELDS = {
    "": "bellows indent port material load printer limits",
    "bellows": "bubble_width bubble_height bubble_thickness tendon_width tendon_height "
    "tendon_thickness chamber_length bubble_distance inner_fillet outer_fillet length offset "
    "number_of_bubbles",
    "indent": "side shape depth width fillet",
    "port": "tube_diameter depth wall",
    "material": "model mu alpha yield_strength elongation_at_break",
    "load": "pressure",
    "limits": "max_von_mises cross_section_width cross_section_height",
    "scenes.*": "kind",
}
"""Table -> the fields of its first version, which always count; ``*`` for tables of any name."""


def digest_of(design: BaseModel) -> str:
    """SHA-256 of what is built and decided, as 64 hexadecimal digits.

    Independent of the order of keys, the spelling of numbers, and of names and descriptions.
    """
    content = _counting(design, design.model_dump(mode="json"), "")
    canonical = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(canonical.encode("ascii")).hexdigest()


def _counting(model: BaseModel, dumped: dict[str, Any], table: str) -> dict[str, Any]:
    """The fields of ``dumped``, which ``model`` gave, that the digest depends on."""
    content = {}
    for name, field in type(model).model_fields.items():
        key, value = f"{table}.{name}".lstrip("."), getattr(model, name)
        later = name not in FIRST_FIELDS.get(table, "").split()
        if key in LABELS or (later and value == field.get_default(call_default_factory=True)):
            continue
        content[name] = _content(value, dumped[name], key)
    return content


def _content(value: Any, dumped: Any, table: str) -> Any:
    """What the digest depends on of one field's ``value``, which gave ``dumped``."""
    if isinstance(value, BaseModel):
        return _counting(value, dumped, table)
    if isinstance(value, dict):
        return {name: _content(value[name], dumped[name], f"{table}.*") for name in value}
    return _without_signed_zero(dumped)


def _without_signed_zero(content: Any) -> Any:
    if isinstance(content, dict):
        return {key: _without_signed_zero(value) for key, value in content.items()}
    if isinstance(content, list):
        return [_without_signed_zero(value) for value in content]
    return content + 0.0 if isinstance(content, float) else content
