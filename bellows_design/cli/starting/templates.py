"""Commented files to start from: a design, a scene, a printer, a filament, a material, an own body.

All but the last come from the records themselves: the keys, what they mean, their units and bounds;
the values are those of something shipped, or of what is to be started from.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from bellows_design.cli.own_body.template import body_template
from bellows_design.cli.starting.kinds import Kind
from bellows_design.errors import DesignError
from bellows_design.validation.file_names import names_a_file
from bellows_design.validation.quoting import did_you_mean, quoted
from bellows_design.validation.sentences import nested_model

STARTS: Mapping[Kind, str] = {
    Kind.DESIGN: "finger",
    Kind.PRINTER: "prusa_i3",
    Kind.FILAMENT: "ninjaflex_85a",
    Kind.MATERIAL: "ninjaflex",
    Kind.SCENE: "blocked",
}
"""Whose values are filled in unless others are asked for."""

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
    "mass_g": 50.0,
    "size": 20.0,
    "distance": 15.0,
    "place": 35.0,
    "height": 10.0,
}
"""Values for keys that the shipped ones leave out and that have no default."""

_BOUNDS = (("ge", "at least"), ("gt", "above"), ("le", "at most"), ("lt", "below"))


def template(kind: Kind, name: str, source: str | None = None) -> str:
    """A commented TOML file of that kind, for a thing called ``name``.

    Its values are those of ``source``: a name or a file; without it of something shipped. Raises
    ``DesignError`` and ``PrintersError``.
    """
    if kind is Kind.BODY:
        if source is not None:
            raise DesignError("--from is for all but own bodies; leave it out.")
        return body_template(name)
    if kind is Kind.SCENE:
        return scene_template(source or STARTS[kind])
    header, model, values = {
        Kind.DESIGN: _design,
        Kind.PRINTER: _printer,
        Kind.FILAMENT: _filament,
        Kind.MATERIAL: _material,
    }[kind](source or STARTS[kind])
    lines = [f"# {line}" for line in header]
    return "\n".join([*lines, *_table(model, values | {"name": name}, "")]) + "\n"


def scene_template(kind: str) -> str:
    """A commented TOML file of a scene of that kind; keys of the other kinds are commented out.

    Raises ``DesignError``.
    """
    from bellows_design.design.scenes.scene import KINDS

    if kind not in KINDS:
        raise DesignError(f"unknown kind of scene {quoted(kind)}{did_you_mean(kind, KINDS)}")
    lines = [
        "# What stands around the finger where it exerts forces. Lengths in mm, masses in g.",
        "# Use it with bellows force --scene FILE, or in a design as the table [scenes.NAME].",
    ]
    for name in sorted(KINDS, key=lambda each: each != kind):
        about = (KINDS[name].__doc__ or name).split("\n")[0].rstrip(".")
        lines += ["", f"# {name}: {about}" if name == kind else f"# instead, {name}: {about}"]
        for field, (about, key) in zip(
            KINDS[name].model_fields.values(), _pairs(_keys_left_out(KINDS[name])), strict=True
        ):
            left_out = name != kind or (field.default is None and not field.is_required())
            lines += [about, key if left_out else key.removeprefix("# ")]
    return "\n".join(lines) + "\n"


def _pairs(lines: Iterator[str]) -> Iterator[tuple[str, str]]:
    """A comment and the key below it."""
    return zip(lines, lines, strict=True)


def name_from(stem: str) -> str:
    """A name that files and folders may have, close to ``stem``."""
    slug = re.sub(r"[^A-Za-z0-9_-]+", "_", stem)[:64].lstrip("-")
    return slug if names_a_file(slug) else f"my_{slug}"


Start = tuple[list[str], type[BaseModel], dict[str, Any]]
"""Comments at the beginning, the record, and its values."""


def _design(source: str) -> Start:
    from bellows_design.design.design import Design
    from bellows_design.design.shipped import load_design

    design = load_design(source)
    values = design.model_dump(mode="json") | {"material": _material_of(design)}
    header = [
        "A bellows actuator. Lengths in mm, pressures and stresses in MPa.",
        "Lines that begin with # are comments; keys in them are optional.",
        f"The numbers are those of the {'shipped ' * (not is_path(source))}design {design.name}.",
    ]
    return header, Design, values | {"description": ""}


def _material_of(design: Any) -> Any:
    """Its name, where the library has it by that; else the whole of it."""
    from bellows_design.materials.library import load_material, material_names

    material = design.material
    if material.name in material_names() and load_material(material.name) == material:
        return material.name
    return material.model_dump(mode="json", exclude_none=True)


def _printer(source: str) -> Start:
    from printers import PrinterProfile, load_profile

    profile = load_profile(source)
    values = profile.model_dump(mode="json")
    for table in ("slicer", "filament"):
        if values.get(table):
            values[table]["sources"] = [f"copied from {profile.name}: replace by your own"]
    header = [
        "A printer with its nozzle. Lengths in mm, angles in degrees.",
        'Use it with --printer FILE, or in a design as printer = "FILE".',
        "Keys may be left out that are as on a printer which the key extends names.",
        f"The numbers are those of {profile.name}: replace them by your own.",
    ]
    return header, PrinterProfile, values | {"description": f"Copied from {profile.name}"}


def _filament(source: str) -> Start:
    from printers import Filament, load_filament

    filament = load_filament(source)
    values = filament.model_dump(mode="json")
    header = [
        "A filament. Temperatures in °C, flow in mm³/s.",
        'Use it with bellows check --filament FILE, or in a printer as filament = "FILE".',
        f"The numbers are those of {filament.name}: replace them by your own.",
    ]
    copied = [f"copied from {filament.name}: replace by your own"]
    return header, Filament, values | {"sources": copied, "description": ""}


def _material(source: str) -> Start:
    from bellows_design.materials.laws import LAWS
    from bellows_design.materials.library import load_material, material_at
    from bellows_design.materials.material import Material

    material = material_at(Path(source)) if is_path(source) else load_material(source)
    header = [
        "A material: an incompressible rubber with a yield strength. Stresses in MPa.",
        'Use it in a design as material = "FILE". From measurements: bellows fit -o FILE.',
        f"Models: {', '.join(LAWS)}; some are written with constants of their own.",
        f"The numbers are those of {material.name}: replace them by your own.",
    ]
    copied = f"copied from {material.name}: replace by your own"
    return header, Material, material.model_dump(mode="json") | {"source": copied}


def is_path(source: str) -> bool:
    """Whether a file is meant, not a name."""
    return source.endswith(".toml")


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
        given = None if field.is_required() else field.default
        example = EXAMPLES.get(name) if given is None else given
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
        known = ((key, inner) for key, inner in value.items() if inner is not None)
        return "{ " + ", ".join(f"{key} = {_as_toml(inner)}" for key, inner in known) + " }"
    if isinstance(value, list | tuple) and any(isinstance(each, Mapping) for each in value):
        return f"[{', '.join(_as_toml(each) for each in value)}]"
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
