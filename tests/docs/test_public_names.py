"""Every name that other programs import says what it is, in which units, with an example that runs.

Examples are the ``Examples:`` sections of docstrings. Those that evaluate designs are slow tests.
"""

from __future__ import annotations

import doctest
import inspect
import re
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import cadquery as cq
import pytest

from generators.names import PACKAGES, public_names

SLOW = {
    "Assembly",
    "BodyEvaluation",
    "Computation",
    "DeformedActuator",
    "Evaluation",
    "NeighbourEvaluation",
    "Neighbourhood",
    "Outcome",
    "Part",
    "Pool",
    "check",
    "deformed_actuator",
    "deformed_body",
    "deformed_surface",
    "evaluate",
    "evaluation_of",
    "examine",
    "force_curve",
    "full_body",
    "half_body",
    "plate",
    "preview",
    "refined",
    "run",
    "sensitivities of bellows_design",
    "started",
    "surface_frames",
    "write_part",
    "write_vtu of bellows_design.evaluation",
}
"""Names whose examples evaluate or check a whole design, or build one at length."""

UNITS = re.compile(
    r"\bmm\b|\bmm[³^²]|\bN\b|\bMPa\b|\bdegrees?\b|°|\bpercent\b|%|\bs\b|\bGiB\b|g/cm³|\brad\b"
    r"|without unit|fractions?\b|counts?\b"
)
NUMBERS = re.compile(r"\b(?:float|Reals|Floats|Vector|Millimetres|NDArray\[np\.float64\])\b")


@cache
def names() -> dict[str, tuple[str, Any]]:
    """Every public class and function once: the package it is first offered by, and itself."""
    found: dict[int, tuple[str, str, Any]] = {}
    for package in PACKAGES:
        module = import_module(package)
        for name in public_names(module):
            at = getattr(module, name)
            if callable(at):
                found.setdefault(id(at), (name, package, at))
    return {f"{package}.{name}": (package, at) for name, package, at in found.values()}


def is_slow(name: str) -> bool:
    package, _, last = name.rpartition(".")
    return bool({last, f"{last} of {package}"} & SLOW)


def parameters() -> list[Any]:
    """Each public name, those of which the example takes long marked as slow."""
    marks = {True: [pytest.mark.slow], False: []}
    return [pytest.param(name, marks=marks[is_slow(name)]) for name in names()]


def text_of(name: str) -> str:
    """The docstring; of a record that extends another, with that of the other."""
    at = names()[name][1]
    classes = at.__mro__ if inspect.isclass(at) else ()
    ours = [base for base in classes if base.__module__.split(".")[0] in TOPS]
    return "\n".join(inspect.getdoc(each) or "" for each in ours or [at])


TOPS = {package.split(".")[0] for package in PACKAGES}


def fields_with_units(at: Any) -> bool:
    """Whether the fields of a checked record state their units, which the site's tables show."""
    fields = getattr(at, "model_fields", {}).values()
    extras = [field.json_schema_extra for field in fields]
    return any(isinstance(extra, dict) and "unit" in extra for extra in extras)


def says_numbers(at: Any) -> bool:
    """Whether a name takes, holds or gives numbers with a fraction."""
    if inspect.isclass(at):
        owners = [base for base in at.__mro__ if base.__module__.split(".")[0] in TOPS]
        noted = [str(kind) for base in owners for kind in inspect.get_annotations(base).values()]
    else:
        noted = [str(kind) for kind in inspect.get_annotations(at).values()]
    return any(NUMBERS.search(kind) for kind in noted)


@pytest.mark.parametrize("name", list(names()))
def test_every_public_name_says_what_it_is_and_in_which_units(name: str) -> None:
    _, at = names()[name]
    text = text_of(name)
    first = (inspect.getdoc(at) or "").split("\n\n")[0]
    assert len(first) > 15 and first.endswith((".", ":", ";", ","))
    assert re.search(r"^Examples:\n    >>> ", inspect.getdoc(at) or "", re.MULTILINE), "no example"
    if says_numbers(at) and not fields_with_units(at):
        assert UNITS.search(text.split("Examples:")[0]), "numbers without a unit"


@pytest.mark.parametrize("name", list(names()))
def test_every_parameter_of_a_public_function_is_described(name: str) -> None:
    _, at = names()[name]
    if not inspect.isfunction(at):
        return
    text = inspect.getdoc(at) or ""
    named = [p for p in inspect.signature(at).parameters if not p.startswith("_")]
    assert not [p for p in named if not re.search(rf"\b{p}\b", text.split("Examples:")[0])]


@pytest.mark.parametrize("name", parameters())
@pytest.mark.thorough
def test_the_example_of_every_public_name_runs(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, at = names()[name]
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cq.Workplane, "bellows", None, raising=False)
    monkeypatch.delattr(cq.Workplane, "bellows")  # one that an example registers is gone after it
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(at) or "", {}, name, None, 0)
    said: list[str] = []
    found = doctest.DocTestRunner(optionflags=flags).run(example, out=said.append)
    assert found.attempted > 1 and not found.failed, "".join(said)


def test_the_example_in_the_description_of_the_rules_is_one() -> None:
    from printers import RULES, Rule

    assert RULES and all(isinstance(rule, Rule) and rule.description for rule in RULES.values())
