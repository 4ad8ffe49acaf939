"""Keys of ``--set`` and what they mean, from a file: the records themselves take long to load.

``tests/bellows_design/cli/completion`` checks that the file says what the records do, and
``python -m bellows_design.cli.completion.settings`` writes it anew.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

from bellows_design.cli.completion.names import beginning, design_table, materials, printers, silent

FILE = "settings.json"


def described_keys() -> dict[str, str]:
    """Every key that may be set, with what it means and its unit."""
    content: dict[str, str] = json.loads(
        (files("bellows_design.cli.completion") / FILE).read_text("utf-8")
    )
    return content


@silent
def settings(design: str, incomplete: str) -> Iterator[tuple[str, str]]:
    """``key=`` with the value that the ``design`` has, to be changed; after ``=`` known names."""
    key, equals, value = incomplete.partition("=")
    if equals:
        for name in _values(key, value):
            yield f"{key}={name}", ""
        return
    table = design_table(design)
    for name, about in described_keys().items():
        if name.startswith(incomplete):
            yield f"{name}={_value_in(table, name)}", about


def _values(key: str, value: str) -> Iterator[str]:
    """Known names that a value may be."""
    if key == "material":
        yield from (name for name, _ in beginning(value, materials()))
    if key == "printer":
        yield from (name for name, _ in printers(value))


def _value_in(table: dict[str, Any], key: str) -> str:
    """The value of a key, as it is written; empty where the design has none."""
    value: Any = table
    path = key.split(".") if "." in key or key in table else ["bellows", key]
    for part in path:
        value = value.get(part) if isinstance(value, dict) else None
    if isinstance(value, bool):
        return str(value).lower()
    return str(value) if isinstance(value, int | float | str) else ""


def records_described() -> dict[str, str]:
    """The same from the records."""
    from bellows_design.design.bellows_parameters import BellowsParameters
    from bellows_design.design.design import Design
    from bellows_design.design.overrides import known_keys
    from bellows_design.validation.sentences import field_at, unit_at

    found = {}
    for key in known_keys():
        path = ["bellows", key] if key in BellowsParameters.model_fields else key.split(".")
        field, unit = field_at(Design, path), unit_at(Design, path)
        about = (field.description if field is not None else None) or ""
        found[key] = ", ".join(each for each in (about, unit) if each)
    return found


def _write() -> None:
    """The file, from the records."""
    text = json.dumps(records_described(), indent=2, ensure_ascii=False)
    Path(__file__).with_name(FILE).write_text(text + "\n", "utf-8")


if __name__ == "__main__":
    _write()
