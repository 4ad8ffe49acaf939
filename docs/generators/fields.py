"""The keys of TOML files, from the records that read them: meaning, unit, bounds, default."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from generators.tables import prose, table

HEADERS = {
    "design-fields": ("Keys of a design", "what `bellows run` takes", "design-file"),
    "body-fields": ("Keys of an own body", "what `bellows evaluate` takes", "own-bodies"),
    "material-fields": ("Keys of a material", "a file of the library, or yours", "materials"),
    "printer-fields": ("Keys of a printer", "a profile that `--printer` takes", "printability"),
}
"""Page -> title, what the file is, and the page that explains it."""

BOUNDS = (("ge", "at least"), ("gt", "above"), ("le", "at most"), ("lt", "below"))
COLUMNS = ("key", "meaning", "unit", "bounds", "default")


def pages() -> Iterator[tuple[str, str]]:
    """Name and text of each page."""
    for name, model in _models().items():
        title, about, explained = HEADERS[name]
        head = (
            f"# {title}\n\nOf {about}; explained in [{explained}](../{explained}.md). Made at the "
            "build of this page from the records that check the file.\n"
        )
        yield name, "\n".join([head, *_tables(model, "")])


def _models() -> dict[str, type[BaseModel]]:
    from bellows_design import Design, OwnBody
    from bellows_design.materials import Material
    from printers import PrinterProfile

    models = (Design, OwnBody, Material, PrinterProfile)
    return dict(zip(HEADERS, models, strict=True))


def _tables(model: type[BaseModel], path: str) -> Iterator[str]:
    """A table of the keys of ``model``, then those of the tables in it."""
    inner = _inner(model)
    meanings = _meanings(model)
    yield table(COLUMNS, (_row(n, f, meanings) for n, f in model.model_fields.items()))
    for name, (nested, field) in inner.items():
        if nested.__name__ in ("Material", "PrinterProfile"):
            continue
        yield f"## `{_bracketed(path + name, field)}`\n"
        yield prose((nested.__doc__ or "").split("\n\n")[0]) + "\n"
        yield from _tables(nested, f"{path}{name}.")


def _inner(model: type[BaseModel]) -> dict[str, tuple[type[BaseModel], FieldInfo]]:
    from bellows_design.validation.sentences import nested_model

    found = {name: (nested_model(field), field) for name, field in model.model_fields.items()}
    scenes = _scenes() if "scenes" in model.model_fields else {}
    return {name: (model, field) for name, (model, field) in found.items() if model} | scenes


def _scenes() -> dict[str, tuple[type[BaseModel], FieldInfo]]:
    """The kinds of a scene, each a table of its own."""
    from bellows_design.design.scenes.blocked import Blocked
    from bellows_design.design.scenes.free import Free
    from bellows_design.design.scenes.grip import Grip
    from bellows_design.design.scenes.payload import Payload

    kinds = (Free, Blocked, Payload, Grip)
    return {f"scenes.NAME, {k.__name__.lower()}": (k, FieldInfo(annotation=k)) for k in kinds}


def _bracketed(path: str, field: FieldInfo) -> str:
    return f"[[{path}]]" if "tuple" in str(field.annotation) else f"[{path}]"


def _row(name: str, field: FieldInfo, meanings: dict[str, str]) -> tuple[str, ...]:
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    meaning = prose(field.description or meanings.get(name, ""))
    return f"`{name}`", meaning, str(extra.get("unit", "")), _bounds(field, extra), _default(field)


def _bounds(field: FieldInfo, extra: dict[str, Any]) -> str:
    found = [
        f"{words} {getattr(rule, key):g}"
        for key, words in BOUNDS
        for rule in field.metadata
        if getattr(rule, key, None) is not None
    ]
    found += [f"{extra['least']:g} of either sign at the least"] if "least" in extra else []
    choices = re.findall(r"Literal\[([^]]*)\]", str(field.annotation))
    found += [re.sub(r"'?([\w-]+)'?(?:, )?", r"`\1` ", choice).strip() for choice in choices]
    return ", ".join(found)


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    if field.default_factory is not None or field.default in (None, (), "", {}):
        return "optional"
    return f"`{field.default}`"


def _meanings(model: type[BaseModel]) -> dict[str, str]:
    """What the docstring says of each field, where the field itself says nothing."""
    text = inspect.cleandoc(model.__doc__ or "")
    _, _, listed = text.partition("Attributes:\n")
    entries = re.findall(r"^    (\w+): (.*(?:\n        .*)*)", listed, re.MULTILINE)
    return {name: re.sub(r"\s+", " ", meaning) for name, meaning in entries}
