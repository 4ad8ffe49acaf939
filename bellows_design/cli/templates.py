"""Commented files to start from: a design, a printer profile, a material, an own body.

Everything in the first three comes from the records themselves: the keys, what they mean, their
units and bounds; the values are those of a shipped design, printer and material.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from enum import StrEnum
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from bellows_design.cli.own_body.template import body_template
from bellows_design.validation.file_names import names_a_file
from bellows_design.validation.sentences import nested_model

DESIGN, PRINTER, MATERIAL = "finger", "prusa_i3", "ninjaflex"
"""Whose values are filled in."""

EXAMPLES: Mapping[str, Any] = {
    "number_of_bubbles": 7,
    "max_von_mises": 4.0,
    "elongation_at_break": 600.0,
    "valid_strain": [-0.5, 2.0],
    "fit_error": 3.0,
    "fit_modulus_error": 3.0,
    "rules": {"overhang": "fail"},
    "kind": "flange",
    "length": 12.0,
    "width": 16.0,
    "thickness": 3.2,
}
"""Values for keys that the shipped ones leave out and that have no default."""

_BOUNDS = (("ge", "at least"), ("gt", "above"), ("le", "at most"), ("lt", "below"))


class Kind(StrEnum):
    """What a file to start from holds."""

    DESIGN = "design"
    PRINTER = "printer"
    MATERIAL = "material"
    BODY = "body"


def template(kind: Kind, name: str) -> str:
    """A commented TOML file of that kind, for a thing called ``name``."""
    if kind is Kind.BODY:
        return body_template(name)
    header, model, values = {
        Kind.DESIGN: _design,
        Kind.PRINTER: _printer,
        Kind.MATERIAL: _material,
    }[kind]()
    lines = [f"# {line}" for line in header]
    return "\n".join([*lines, *_table(model, values | {"name": name}, "")]) + "\n"


def name_from(stem: str) -> str:
    """A name that files and folders may have, close to ``stem``."""
    slug = re.sub(r"[^A-Za-z0-9_-]+", "_", stem)[:64].lstrip("-")
    return slug if names_a_file(slug) else f"my_{slug}"


def _design() -> tuple[list[str], type[BaseModel], dict[str, Any]]:
    from bellows_design.design.design import Design
    from bellows_design.design.shipped import load_design

    design = load_design(DESIGN)
    values = design.model_dump(mode="json") | {"material": design.material.name}
    header = [
        "A bellows actuator. Lengths in mm, pressures and stresses in MPa.",
        "Lines that begin with # are comments; keys in them are optional.",
        f"The numbers are those of the shipped design {DESIGN}.",
    ]
    return header, Design, values | {"description": ""}


def _printer() -> tuple[list[str], type[BaseModel], dict[str, Any]]:
    from printers import PrinterProfile, load_profile

    values = load_profile(PRINTER).model_dump(mode="json")
    for table in ("slicer", "filament"):
        values[table]["sources"] = [f"copied from {PRINTER}: replace by your own"]
    header = [
        "A printer with its nozzle. Lengths in mm, angles in degrees.",
        'Use it with --printer FILE, or in a design as printer = "FILE".',
        "Keys may be left out that are as on a printer which the key extends names.",
        f"The numbers are those of the shipped profile {PRINTER}: replace them by your own.",
    ]
    return header, PrinterProfile, values | {"description": f"Copied from {PRINTER}"}


def _material() -> tuple[list[str], type[BaseModel], dict[str, Any]]:
    from bellows_design.materials.laws import LAWS
    from bellows_design.materials.library import load_material
    from bellows_design.materials.material import Material

    values = load_material(MATERIAL).model_dump(mode="json")
    header = [
        "A material: an incompressible rubber with a yield strength. Stresses in MPa.",
        'Use it in a design as material = "FILE". From measurements: bellows fit -o FILE.',
        f"Models: {', '.join(LAWS)}; some are written with constants of their own.",
        f"The numbers are those of {MATERIAL}: replace them by your own.",
    ]
    return header, Material, values | {"source": f"copied from {MATERIAL}: replace by your own"}


def _table(model: type[BaseModel], values: Mapping[str, Any], path: str) -> Iterator[str]:
    """Lines of a table: its plain keys, then the tables in it; absent ones commented out."""
    inner = {}
    for name, field in model.model_fields.items():
        value, nested = values.get(name), nested_model(field)
        if nested is not None and (value is None or isinstance(value, Mapping)):
            inner[name] = (nested, value, field)
        else:
            yield from _key(name, field, value)
    for name, (nested, value, field) in inner.items():
        optional = " (optional: leave the table out without one)" * (field.default is None)
        about = (field.description or (nested.__doc__ or name).split("\n")[0]).rstrip(".")
        yield from ("", f"# {about}{optional}", f"{'# ' * (value is None)}[{path}{name}]")
        if value is None:
            yield from _keys_left_out(nested)
        else:
            yield from _table(nested, value, f"{path}{name}.")


def _keys_left_out(model: type[BaseModel]) -> Iterator[str]:
    """The keys of a table that is commented out, each with its default or an example."""
    for name, field in model.model_fields.items():
        about, _ = _key(name, field, None)
        example = EXAMPLES.get(name) if field.is_required() else field.default
        yield from (about, f"# {name} = {_as_toml(example)}")


def _key(name: str, field: FieldInfo, value: Any) -> Iterator[str]:
    """A comment on the key, and the key; commented out where its value is left open."""
    yield f"# {'; '.join(_about(field))}"
    empty = value is None or value in ([], {})
    shown = _example(name, field, value) if empty else value
    yield f"{'# ' * empty}{name} = {_as_toml(shown)}"


def _example(name: str, field: FieldInfo, value: Any) -> Any:
    """The field's own example, one by its name, or the value."""
    return field.examples[0] if field.examples else EXAMPLES.get(name, value)


def _as_toml(value: Any) -> str:
    """The value as it stands in TOML, on one line."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_as_toml(inner)}" for key, inner in value.items()) + " }"
    return json.dumps(value, ensure_ascii=False)


def _about(field: FieldInfo) -> Iterator[str]:
    """What the key means, its unit, its bounds, and whether it may be left out."""
    if field.description:
        yield field.description
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    if "unit" in extra:
        yield str(extra["unit"])
    bounds = [
        f"{words} {getattr(rule, key):g}"
        for key, words in _BOUNDS
        for rule in field.metadata
        if getattr(rule, key, None) is not None
    ]
    if "least" in extra:
        bounds.append(f"{extra['least']:g} of either sign at the least")
    choices = re.findall(r"'([^']*)'", str(field.annotation)) if "Literal" in repr(field) else []
    yield from [" or ".join(f'"{choice}"' for choice in choices)] if choices else []
    yield from [", ".join(bounds)] if bounds else []
    if not field.is_required():
        yield "optional"
