"""The Python API: one page for each package that other programs import names from."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType

PACKAGES = {
    "bellows_design": "The whole pipeline",
    "bellows_design.evaluation": "Angles and stresses",
    "bellows_design.deformed": "The whole actuator under pressure",
    "bellows_design.design": "Designs",
    "bellows_design.materials": "Materials",
    "bellows_design.geometry": "Solids",
    "bellows_design.plugin": "CadQuery",
    "solver": "The solver",
    "solver.mesh": "Meshes",
    "solver.meshing": "Meshing",
    "printers": "Printers",
}
"""Package -> title of its page."""

HOMES = {"RULES": "printers.rule_table.RULES"}
"""Values, whose descriptions stand in the module that defines them."""


INDENTED = re.compile(r"(?<!::\n\n)^(?:    .*\n(?:\n(?=    ))?)+", re.MULTILINE)


def public_names(package: ModuleType) -> tuple[str, ...]:
    """Names that a package offers, but for its version; of a module those that it defines."""
    defined = (name for name, found in vars(package).items() if _of(package, found))
    return tuple(n for n in getattr(package, "__all__", defined) if not n.startswith("_"))


def _of(package: ModuleType, found: object) -> bool:
    return getattr(found, "__module__", None) == package.__name__


def pages() -> Iterator[tuple[str, str]]:
    """Name and text (reStructuredText, as docstrings are) of each page."""
    yield "python-names", _overview()
    described: dict[int, str] = {}
    for name, title in PACKAGES.items():
        package = import_module(name)
        head = f"``{name}``"
        about = with_code(inspect.getdoc(package) or "")
        lines = [head, "=" * len(head), "", f"{title}.", "", about, ""]
        yield _page(name), "\n".join([*lines, *_entries(name, package, described)])


def with_code(text: str) -> str:
    """A docstring whose indented lines are code, where reStructuredText would see a quotation."""
    return INDENTED.sub(r"::\n\n\g<0>", f"{text}\n")


def _page(package: str) -> str:
    return f"api-{package.replace('.', '-').replace('_', '-')}"


def _overview() -> str:
    listed = "\n".join(f"   {title}: {name} <{_page(name)}>" for name, title in PACKAGES.items())
    text = (
        "Every name here has its shapes, units and errors, and an example that the tests run. "
        "Lengths are in mm, forces in N, pressures and stresses in MPa, angles in degrees."
    )
    return f"Python API\n==========\n\n{text}\n\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n"


def _entries(name: str, package: ModuleType, described: dict[int, str]) -> Iterator[str]:
    """What is said of each name; of one that an earlier page has, where that is."""
    for public in public_names(package):
        found = getattr(package, public)
        if id(found) in described:
            yield f"``{public}`` is :py:obj:`{described[id(found)]}`.\n"
        else:
            described[id(found)] = f"{name}.{public}"
            yield _entry(name, public, found)


def _entry(package: str, public: str, found: object) -> str:
    if inspect.isclass(found):
        fields = ", ".join(_fields(found))
        return f".. autoclass:: {package}.{public}\n   :members:\n   :exclude-members: {fields}\n"
    if callable(found):
        return f".. autofunction:: {package}.{public}\n"
    return f".. autodata:: {HOMES.get(public, f'{package}.{public}')}\n   :no-value:\n"


def _fields(found: type) -> list[str]:
    """Fields of a record, which its attributes list already."""
    fields = getattr(found, "model_fields", None) or getattr(found, "__dataclass_fields__", {})
    return [*fields, "model_config", "args"]
