"""Another kind of value than belongs there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from hard_bodies import CLAMPED, NEO_HOOKE
from hard_calls import ARGUMENTS
from hard_case import Finding, HardCase, refused, true
from meshes import box_mesh

from solver import (
    AxialForce,
    BodyForce,
    Contact,
    Couple,
    EdgeForce,
    Membrane,
    Mesh,
    NodeSpring,
    Ogden,
    PointForce,
    Problem,
    SlenderAxis,
    SolverOptions,
    Supports,
    Traction,
    solve,
    trace,
)
from solver.material.mooney_rivlin import MooneyRivlin
from solver.meshing import MeshOptions, mesh_solid

BOX = box_mesh((1, 1, 1))
PULL = Traction("x1", (0.1, 0.0, 0.0))
FILM = Membrane("x1", 1.0, 0.3, 0.1)
Calls = dict[str, tuple[Callable[[], object], str]]


def _problem(**change: Any) -> Problem:
    given = {"mesh": BOX, "material": NEO_HOOKE, "supports": CLAMPED, "pressurised": ("x1",)}
    return Problem(**{**given, **change})


def _each(make: Callable[..., object], words: str, **wrong: tuple[Any, ...]) -> Calls:
    """A call for each wrong value of each parameter; the sentence must name the parameter."""
    calls: Calls = {}
    for name, values in wrong.items():
        for value in values:
            label = f"{name} = {value!r}"
            call = lambda name=name, value=value: make(**{name: value})  # noqa: E731
            calls[label] = (call, f"{words}{name}")
    return calls


def problems() -> Calls:
    """A single thing where several belong, texts for names, numbers for objects."""
    return _each(
        _problem,
        "",
        mesh=(None, "box.msh", BOX.nodes),
        material=(1.0, None, "ninjaflex", Ogden),
        supports=(None, ("x0",), {"x0": 0}, "x0"),
        pressurised=("x1", 3, (3,), {"x1": 1}),
        loads=(PULL, "x1", 0.1, (0.1,), (PULL, "x1"), {"x1": PULL}),
        axis=((0.0, 1.0), 1.0),
        moving_plane=(("x1",), 1),
        sharp_edge_radius=("0.2", None, (0.2,)),
        contacts=(Contact("x1", 0.01, 0), "x1", ("x1",), 0.1),
        springs=(NodeSpring((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), "x1", (0.1,), 0.1, None),
        materials=(NEO_HOOKE, (NEO_HOOKE,), {"lid": NEO_HOOKE}, {1: NEO_HOOKE}, "lid", None),
        membranes=(FILM, "x1", ("x1",), {"x1": FILM}, 0.1, None),
    )


def supports() -> Calls:
    """Supports: a bare name, an axis where a dict belongs, a constant for a motion."""
    calls = _each(
        Supports,
        "supports: ",
        clamped=("x0", 0, (0,), {"x0": 0}),
        symmetry=(0, "x0", ("x0", 0), [("x0", 0)]),
        prescribed=("x1", ("x1",), 0.1),
        nodes=((0.0, 0.0, 0.0), [((0.0, 0.0, 0.0), 0)]),
    )
    for axis in (3, -1, "x", 1.0, (0, 3), (), None, (0, "y"), True):
        axis = 5 if axis is True else axis
        calls[f"axis {axis!r}"] = (lambda axis=axis: Supports(symmetry={"x0": axis}), "symmetry")
        calls[f"axis of a node {axis!r}"] = (
            lambda axis=axis: Supports(nodes={(0.0, 0.0, 0.0): axis}), "node"
        )  # fmt: skip
    for motion in (0.1, (0.1, 0.0, 0.0), np.zeros((6, 3)), None, "up"):
        call = lambda motion=motion: Supports(prescribed={"x1": motion})  # noqa: E731
        calls[f"motion {motion!r}"] = (call, "'x1' must be a function")
    for place in ("origin", 0.0, (0.0, 0.0), (0.0, 0.0, "z"), (0.0, 0.0, float("nan"))):
        call = lambda place=place: Supports(nodes={place: 0})  # noqa: E731
        calls[f"position {place!r}"] = (call, "position of a node")
    for answer in ("up", None, 0.1, {"x": 1}):
        led = Supports(("x0",), prescribed={"x1": lambda at, load, answer=answer: answer})
        calls[f"motion that returns {answer!r}"] = (
            lambda led=led: _problem(supports=led), "motion of 'x1'"
        )  # fmt: skip
    return calls


def laws() -> Calls:
    """Constants of materials."""
    calls = _each(
        lambda **change: Ogden(**{"mu": (1.0,), "alpha": (2.0,), **change}),
        "Ogden: ",
        mu=(1.0, "1", None, ("1",), {1.0: 2.0}),
        alpha=(2.0, "2", None, (None,)),
        higher=(0.1, "0.1", (None,)),
        bulk_modulus=("stiff", None, (50.0,)),
        volumetric=(1, None, "cubic"),
    )
    calls |= _each(
        lambda **change: MooneyRivlin(**{"c10": 0.5, **change}),
        "MooneyRivlin: ",
        c10=("0.5", None, (0.5,)),
        c02=("0.5", None),
    )
    return calls


def loads() -> Calls:
    """Dead loads, stations, contacts, options."""
    calls: Calls = {}
    for bad in ("up", None, 0.1, (1.0, "y", 0.0), {"x": 1}):
        for load in (Traction("x1", bad), BodyForce(bad), PointForce((1.0, 1.0, 1.0), bad)):
            problem = _problem(loads=(load,))
            calls[f"{load}"] = (lambda problem=problem: solve(problem), "load")
        edge = lambda bad=bad: EdgeForce(("x1", "z1"), bad)  # noqa: E731
        calls[f"edge force {bad!r}"] = (edge, "edge force: force")
        calls[f"stations {bad!r}"] = (lambda bad=bad: SlenderAxis(bad), "stations")
    for bad in ("1", None, (1.0,)):
        calls[f"couple {bad!r}"] = (
            lambda bad=bad: solve(_cell(Couple(bad))), "a couple's moment"
        )  # fmt: skip
        calls[f"axial force {bad!r}"] = (
            lambda bad=bad: solve(_cell(AxialForce(bad))), "an axial force"
        )  # fmt: skip
        calls[f"penetration {bad!r}"] = (lambda bad=bad: Contact("x1", bad, 0), "penetration")
    for bad in ("0.1", None, (0.1,)):
        calls[f"solve at {bad!r}"] = (lambda bad=bad: solve(_problem(), bad), "pressure must be")
        calls[f"trace to {bad!r}"] = (lambda bad=bad: trace(_problem(), bad), "pressure must be")
    for name in ("first_step", "growth", "tolerance", "maximum_steps", "seconds"):
        calls[f"option {name}"] = (lambda name=name: SolverOptions(**{name: "1"}), name)
    for bad in (0, "y0 ", ("y0",)):
        calls[f"surface {bad!r}"] = (
            lambda bad=bad: _problem(loads=(Traction(bad, (0.1, 0.0, 0.0)),)), "surface"
        )  # fmt: skip
        film = lambda bad=bad: _problem(membranes=(Membrane(bad, 1.0, 0.3, 0.1),))  # noqa: E731
        calls[f"surface of a film {bad!r}"] = (film, "surface")
        weight = _problem(loads=(BodyForce((0.0, 0.0, 0.1), bad),))
        calls[f"region {bad!r}"] = (lambda weight=weight: solve(weight), "no region")
    calls |= _each(
        lambda **change: Membrane(
            **{"surface": "x1", "young_modulus": 1, "poisson_ratio": 0.3, "thickness": 1, **change}
        ),
        "membranes: ",
        young_modulus=("1", None, (1.0,), float("nan"), 0.0),
        poisson_ratio=("0.3", None, float("nan"), 0.6),
        thickness=("1", None, float("inf"), -1.0),
    )
    return calls


def _cell(load: Couple | AxialForce) -> Problem:
    supports = Supports(symmetry={"x0": 0, "y0": 1})
    return _problem(supports=supports, moving_plane="x1", pressurised=(), loads=(load,))


def meshes() -> Calls:
    """Meshes and what they are made from."""
    calls = _each(
        lambda **change: Mesh(**{"nodes": BOX.nodes, "tets": BOX.tets, **change}),
        "mesh: ",
        nodes=("nodes.csv", None, [["a", "b", "c"]]),
        tets=("tets.csv", None, BOX.tets + 0.5, BOX.tets * float("nan")),
        surfaces=(["x0"], "x0", 3),
        regions=(["lid"], "lid", 3),
    )
    for bad in ("lid", None, 0, (), (0.5,), (True,), ((0,),), (0, 0), (-1,), (2**32,), {0}, "0"):
        region = lambda bad=bad: Mesh(BOX.nodes, BOX.tets, {}, {"lid": bad})  # noqa: E731
        calls[f"region of {bad!r}"] = (region, "the region 'lid'")
    wide = BOX.tets.astype(np.int64) + 2**32
    calls["node numbers of 64 bits"] = (lambda: Mesh(BOX.nodes, wide), "mesh: tets")
    named = {"x0": "x1"}
    calls["a text for triangles"] = (lambda: Mesh(BOX.nodes, BOX.tets, named), "surface 'x0'")
    made = lambda **change: mesh_solid(**{"brep": b"", "face_names": ("a",), **change})  # noqa: E731
    calls |= _each(
        made,
        "mesh: ",
        brep=("solid.brep", None, 3),
        face_names=("side", 3, (3,)),
        options=({"size": 2.0}, 2.0),
        seconds=("60", None),
    )
    calls |= _each(
        MeshOptions,
        "mesh: ",
        size=("2", None),
        smallest_size=("0.1",),
        elements_per_circle=(None,),
        field=(np.ones(3),),
    )
    return calls


def kinds() -> tuple[Finding, ...]:
    """All of them; and what is as good as the kind asked for is taken."""
    from_lists = Problem(BOX, NEO_HOOKE, Supports(["x0"], {"y0": np.int64(1)}), ["x1"], [PULL])
    return (
        refused("problems", problems()),
        refused("supports", supports()),
        refused("laws", laws()),
        refused("loads and options", loads()),
        refused("meshes", meshes()),
        true("lists and whole numbers of NumPy are taken", solve(from_lists).converged),
    )


def classical() -> tuple[Finding, ...]:
    """Treloar's rubber in Ogden's own form, which has a negative constant."""
    original = {"mu": (0.63, 0.0012, -0.01), "alpha": (1.3, 5.0, -2.0)}
    converted = tuple(m * a / 2 for m, a in zip(*original.values(), strict=True))
    rubber = Ogden(converted, original["alpha"])
    stretch = np.array([1.5, 1 / np.sqrt(1.5), 1 / np.sqrt(1.5)])
    energy = sum(m / a * (np.sum(stretch**a) - 3) for m, a in zip(*original.values(), strict=True))
    off = abs(rubber.energy(np.log(stretch)) / energy - 1)
    return (
        refused("as they stand", {"mu": (lambda: Ogden(**original), "mu alpha / 2")}),
        true("after the conversion that is named the energy is the original's", off < 1e-12, off),
    )


CASES = (
    HardCase(
        "A single thing for several, a text for a name, a number for an object",
        "an error from the depths of Python, or letters taken one by one for names",
        "refused with the parameter's name and what belongs there",
        kinds,
    ),
    ARGUMENTS,
    HardCase(
        "Ogden's constants as he wrote them",
        "another definition of μ: a material that is off by α/2, or a refusal without a hint",
        "the refusal of a negative μ says how to convert",
        classical,
    ),
)
