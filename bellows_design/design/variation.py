"""The numbers of a design that may be varied a little, and what follows when they are.

A fillet that is a full round, or close enough to be built as one, follows what it rounds, so that
the body keeps its faces; it is no parameter of its own then.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from bellows_design.design.bellows_parameters import BellowsParameters
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.design.lengths import FULL_ROUND_SNAP
from bellows_design.design.topology import FLOORS, NOTHING, same_topology, signature
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import did_you_mean, quoted

__all__ = [
    "between",
    "counted",
    "followed",
    "geometric_parameters",
    "kinked",
    "led_along",
    "parameters",
    "same_topology",
    "settable",
    "varied",
]

BELLOWS = tuple(name for name in BellowsParameters.model_fields if name != "number_of_bubbles")
INDENT = ("indent.depth", "indent.width", "indent.fillet")

_ENTRY = re.compile(r"(\w+)\[(\d+)\]")


def parameters(design: Design) -> dict[str, float]:
    """Free parameters and their values, by dotted name as ``bellows design --set`` names them.

    First the geometric ones (mm), then the material's constants (moduli in MPa), each as
    ``material.mu[0]``, and ``load.pressure`` (MPa).
    """
    others = dict(_material(design)) | {"load.pressure": design.load.pressure}
    return geometric_parameters(design) | others


def geometric_parameters(design: Design) -> dict[str, float]:
    """Those that change the body, mm. A fillet that is zero or a full round is none of them."""
    values, bound = _lengths(design), led_along(design)
    return {
        name: value
        for name, value in values.items()
        if name not in bound and not (name.endswith("fillet") and value == 0)
    }


def led_along(design: Design) -> dict[str, tuple[str, ...]]:
    """Fillets that are full rounds, and by which parameters each is led along.

    The fraction of the largest possible radius that it is stays the same.
    """
    return {fillet: _leaders(limits) for fillet, limits in _full_rounds(design)}


def settable(design: Design) -> tuple[str, ...]:
    """What :func:`varied` takes: parameters, and fillets that are none for being 0 or full."""
    return tuple(_lengths(design) | parameters(design))


def varied(design: Design, changes: Mapping[str, float]) -> Design:
    """``design`` with other values of some parameters; fillets that are full rounds follow.

    Args:
        design: The design to start from; it stays as it is.
        changes: New values by the names of :func:`parameters`, mm and MPa. A fillet that is a full
            round may be given a value too, and then does not follow.

    Raises:
        DesignError: An unknown name, or values that describe no design.

    Examples:
        >>> from bellows_design import load_design, varied
        >>> wider = varied(load_design("finger"), {"bubble_width": 20.5, "load.pressure": 0.08})
        >>> print(wider.bellows.bubble_width, "mm,", wider.load.pressure, "MPa")
        20.5 mm, 0.08 MPa
    """
    known = settable(design)
    for name in changes:
        if name not in known:
            raise DesignError(f"unknown parameter {quoted(name)}{did_you_mean(name, known)}")
    table = design.model_dump()
    for name, value in changes.items():
        _put(table, name, float(value))
    return Design.of(followed(design, table, frozenset(changes)))


def followed(design: Design, table: dict[str, Any], given: frozenset[str]) -> dict[str, Any]:
    """``table``, made of the design's, with full rounds that are not ``given`` led along.

    The table is changed, and not checked yet: it may be of no design.
    """
    lengths = _lengths(design)
    for fillet, limits in _full_rounds(design):
        if fillet not in given and fillet in _limits_in(table):
            _follow(table, fillet, lengths[fillet], min(limits.values()))
    return table


def counted(design: Design) -> Design:
    """``design`` with the number of bubbles that it has as a given number."""
    table = design.model_dump()
    table["bellows"]["number_of_bubbles"] = design.bellows.bubble_count
    return Design.of(table)


def kinked(design: Design) -> tuple[str, ...]:
    """Parameters at which the body, and so its response, has two one-sided derivatives.

    Where the floors of channel and chambers are level, either one alone makes a step, whose place
    depends on which of them is higher.
    """
    level = abs(signature(design)[FLOORS]) < NOTHING
    return ("bubble_thickness", "tendon_thickness") if level else ()


def between(design: Design, other: Design, share: float) -> Design:
    """The design so far along the straight way from one to another in parameters, 0 to 1.

    Both have the same parameters; what is no parameter is taken from the first.

    Raises:
        DesignError: There is no such design, or the two have other parameters.
    """
    if share == 1.0:
        return other
    here, there = parameters(design), parameters(other)
    if here.keys() != there.keys():
        odd = sorted(here.keys() ^ there.keys())
        raise DesignError(f"the designs do not share the parameters {', '.join(odd)}.")
    return varied(
        design,
        {
            name: value + share * (there[name] - value)
            for name, value in here.items()
            if there[name] != value
        },
    )


def _lengths(design: Design) -> dict[str, float]:
    """All lengths that shape the body, mm."""
    values = {name: float(getattr(design.bellows, name)) for name in BELLOWS}
    if design.indent is not None:
        names = INDENT[:2] if design.indent.shape == "arc" else INDENT
        values |= {name: float(getattr(design.indent, name[7:])) for name in names}
    return values


def _material(design: Design) -> Iterator[tuple[str, float]]:
    """The constants of the material's law that may be chosen freely."""
    from bellows_design.materials.laws import LAWS

    material = design.material
    fixed = bool(LAWS[material.model].exponents)
    for field in ("mu", *(() if fixed else ("alpha",)), "higher", "constants"):
        for index, value in enumerate(getattr(material, field)):
            yield f"material.{field}[{index}]", value


def _put(table: dict[str, Any], name: str, value: float) -> None:
    """Set the parameter of that name in a design's table."""
    *parents, last = name.split(".") if "." in name else ("bellows", name)
    for parent in parents:
        table = table[parent]
    entry = _ENTRY.fullmatch(last)
    if entry is None:
        table[last] = value
        return
    values = list(table[entry[1]])
    values[int(entry[2])] = value
    table[entry[1]] = tuple(values)


Limits = dict[tuple[str, ...], float]


def _limits(bellows: BellowsParameters, indent: Indent | None) -> dict[str, Limits]:
    """For each fillet the lengths that bound it, mm, by the parameters each depends on."""
    chamber = (
        ("chamber_length",),
        ("bubble_width", "bubble_thickness"),
        ("bubble_height", "bubble_thickness"),
    )
    bubble = (("chamber_length", "bubble_thickness"), ("bubble_width",), ("bubble_height",))
    limits = {
        "inner_fillet": _halves(chamber, bellows.chamber_size),
        "outer_fillet": _halves(bubble, bellows.bubble_size),
    }
    if indent is None or indent.shape == "arc":
        return limits
    return limits | {"indent.fillet": _limits_of_indent(indent, bellows)}


def _limits_of_indent(indent: Indent, bellows: BellowsParameters) -> Limits:
    if indent.side == "outside":
        return {("indent.depth",): indent.depth, ("indent.width",): indent.width / 2}
    heights = ("tendon_height", "tendon_thickness", "bubble_thickness", "indent.depth")
    names = (("indent.width",), ("bubble_width", "bubble_thickness", "inner_fillet"), heights)
    return _halves(names, indent.inside_size(bellows))


def _halves(names: tuple[tuple[str, ...], ...], sizes: tuple[float, ...]) -> Limits:
    return {key: size / 2 for key, size in zip(names, sizes, strict=True)}


def _full_rounds(design: Design) -> Iterator[tuple[str, Limits]]:
    """The fillets that are built as full rounds, and what bounds them."""
    lengths = _lengths(design)
    for fillet, limits in _limits(design.bellows, design.indent).items():
        snapped = fillet != "indent.fillet" or (design.indent and design.indent.side == "inside")
        gap = min(limits.values()) - lengths[fillet]
        if lengths[fillet] > 0 and gap < (FULL_ROUND_SNAP if snapped else NOTHING):
            yield fillet, limits


def _leaders(limits: Limits) -> tuple[str, ...]:
    """The parameters that the least of the limits depends on."""
    most = min(limits.values())
    names = [name for key, limit in limits.items() if limit - most < NOTHING for name in key]
    return tuple(dict.fromkeys(names))


def _follow(table: dict[str, Any], fillet: str, radius: float, most: float) -> None:
    """Make a fillet of a varied design the fraction ``radius / most`` of what is possible now.

    One a hair short of a full round comes no farther from it, so that it stays one.
    """
    after = min(_limits_in(table)[fillet].values())
    _put(table, fillet, after - (most - radius) * min(1.0, after / most))


def _limits_in(table: Mapping[str, Any]) -> dict[str, Limits]:
    """The limits of fillets in the table of a design that is not checked yet."""
    indent = table["indent"]
    return _limits(
        BellowsParameters.model_construct(**table["bellows"]),
        None if indent is None else Indent.model_construct(**indent),
    )
