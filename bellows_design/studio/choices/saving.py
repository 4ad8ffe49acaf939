"""A changed design as a TOML file with comments, under a name of its own."""

from __future__ import annotations

import re

from pydantic import BaseModel

from bellows_design.design.design import Design

HEADER = (
    "# A bellows actuator, saved by bellows studio.\n"
    "# Lengths in mm, pressures and stresses in MPa.\n"
)

_KEY = re.compile(r"^(\w+) = ")


def toml_text(design: Design) -> str:
    """The design as TOML: every key with its meaning and unit; it loads to the same digest."""
    lines, path = [HEADER], tuple[str, ...]()
    for line in design.to_toml().splitlines():
        if line.startswith("["):
            path = tuple(line.strip("[]").split("."))
        key = _KEY.match(line)
        about = _about((*path, key[1])) if key else ""
        lines.append(f"{line}  # {about}" if about and _is_whole(line) else line)
    return "\n".join(lines) + "\n"


def _is_whole(line: str) -> bool:
    """Whether a value ends on its line, outside of text: a comment may follow."""
    return not line.endswith(("[", "{", ",")) and '"""' not in line and "'''" not in line


def _about(path: tuple[str, ...]) -> str:
    """What a key means, and its unit."""
    from bellows_design.validation.sentences import nested_model

    model: type[BaseModel] = Design
    for name in path[:-1]:
        inner = model.model_fields.get(name)
        found = None if inner is None else nested_model(inner)
        if found is None:
            return ""
        model = found
    field = model.model_fields.get(path[-1])
    if field is None or not field.description:
        return ""
    extra = field.json_schema_extra
    unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
    return f"{field.description}; {unit}" if unit else str(field.description)
