"""What must be there at once: the design of the page's values, what is wrong, lights, the shape."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bellows_design.design.overrides import renamed_if_changed
from bellows_design.errors import BellowsError
from bellows_design.studio.choices.changed import changed, design_of_text, opened_text, problems
from bellows_design.studio.choices.parameters import current_values, sliders
from bellows_design.studio.workers.reporting import Report

if TYPE_CHECKING:
    from collections.abc import Callable

    from bellows_design.design.design import Design
    from bellows_design.materials.material import Material
    from bellows_design.studio.display.morphed import Cells

    Values = dict[str, Any]
    Task = Callable[[Values, Values, Report], None]


def tasks() -> dict[str, Task]:
    """By their names."""
    from bellows_design.studio.display.morphed import Cells

    cells = Cells()
    return {
        "open": _open,
        "change": lambda values, arrays, report: _change(cells, values, report),
        "cell": lambda values, arrays, report: _take_cell(cells, values, arrays),
        "toml": _toml,
    }


def _open(values: Values, _: Values, report: Report) -> None:
    """Say what the page needs to know of a design: by its shipped name, or as TOML."""
    from bellows_design.design.shipped import load_design, shipped_designs
    from bellows_design.studio.protocol import known_or_hint

    if values["text"] is not None:
        design = opened_text(values["text"])
    else:
        known_or_hint(values["name"], shipped_designs(), "design")
        design = load_design(values["name"])
    report("start", **_start(design))


def _start(design: Design) -> Values:
    from bellows_design import __version__
    from bellows_design.design.shipped import load_design, shipped_designs
    from bellows_design.materials.library import material_names
    from printers import available_profiles

    return {
        "name": design.name,
        "description": design.description,
        "digest": design.digest,
        "designs": [
            {"name": name, "description": load_design(name).description}
            for name in shipped_designs()
        ],
        "materials": _described(material_names()),
        "printers": list(available_profiles()),
        "parameters": sliders(design),
        "material": design.material.name,
        "printer": design.printer if isinstance(design.printer, str) else design.printer.name,
        "indent": None if design.indent is None else design.indent.model_dump(mode="json"),
        "bubble_count": design.bellows.bubble_count,
        "limits": {
            **design.limits.model_dump(mode="json"),
            "stress_limit_mpa": design.max_von_mises,
        },
        "load": design.load.model_dump(mode="json"),
        "toml": design.to_toml(),
        "version": __version__,
    }


def _described(names: tuple[str, ...]) -> list[dict[str, str]]:
    from bellows_design.materials.library import load_material

    return [{"name": name, "description": _described_as(load_material(name))} for name in names]


def _described_as(material: Material) -> str:
    """A material's law, its stiffness when strained little, and where it yields."""
    modulus = material.hyperelastic().shear_modulus
    yields = f"yields at {material.yield_strength:g} MPa"
    return f"{material.model}, shear modulus {modulus:.3g} MPa, {yields}"


def _change(cells: Cells, values: Values, report: Report) -> None:
    """Problems, or none; then lights and shape of a design that is valid."""
    design = _checked(values, report)
    if design is None:
        return
    from bellows_design.studio.display.declared import declared_lights

    _show(cells, design, report)
    report("lights", source="declared", lights=declared_lights(design))


def _show(cells: Cells, design: Design, report: Report) -> None:
    """The shape, or that it follows."""
    shape = cells.shape_of(design)
    if shape is None:
        report("shape_follows", why="the shape has other faces than before: it follows")
        return
    from bellows_design.web.packing import packed
    from bellows_design.web.scene import Surface

    surface = Surface("actuator", shape.triangles, shape.points)
    report.shown("shape", packed([surface]), source="morph")


def _checked(values: Values, report: Report) -> Design | None:
    """The design of the page's values; None, and its problems reported, if there is none."""
    from printers.errors import PrintersError

    try:
        design = changed(design_of_text(values["base"]), values["values"])
        design.profile()
    except BellowsError as error:
        report("problems", problems=problems(error, values["values"]))
    except PrintersError as error:
        found = {"parameter": "printer", "parameters": ["printer"], "message": str(error)}
        report("problems", problems=[found])
    else:
        report("problems", problems=[], **_facts(design))
        return design
    return None


def _facts(design: Design) -> Values:
    return {
        "bubble_count": design.bellows.bubble_count,
        "values": current_values(design),
        "digest": design.digest,
        "stress_limit_mpa": design.max_von_mises,
    }


def _take_cell(cells: Cells, values: Values, arrays: Values) -> None:
    """Keep the mesh of a design's unit cell, which another process made."""
    from bellows_design.studio.display.morphed import MovedCell
    from solver import Mesh

    names = values["surfaces"]
    surfaces = {name: arrays[f"surface {name}"] for name in names}
    mesh = Mesh(arrays["nodes"], arrays["tets"], surfaces)
    cells.add(MovedCell.of(changed(design_of_text(values["base"]), values["values"]), mesh))


def _toml(values: Values, _: Values, report: Report) -> None:
    """The design as a file."""
    from bellows_design.studio.choices.saving import toml_text

    base = design_of_text(values["base"])
    design = renamed_if_changed(changed(base, values["values"]), base)
    report("toml", name=design.name, text=toml_text(design), digest=design.digest)
