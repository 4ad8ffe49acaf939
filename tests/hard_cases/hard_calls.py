"""Other kinds of values than belong there, in the arguments of every function of the solver."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from hard_bodies import CLAMPED, NEO_HOOKE
from hard_case import Finding, HardCase, refused, true
from meshes import box_mesh

from solver import (
    Checkpoint,
    Contact,
    Mesh,
    Ogden,
    Problem,
    Solution,
    SolverOptions,
    Supports,
    cavity_volume,
    contact_forces,
    folded_elements,
    inflate,
    membrane_forces,
    nodal_cauchy,
    nodal_von_mises,
    peak_von_mises,
    peaks_by_region,
    potential,
    reaction,
    rotation,
    solve,
    strain_energy,
    trace,
    transfer,
    work,
    write_vtu,
)

BOX = box_mesh((1, 1, 1))
SHEET = Problem(
    box_mesh((1, 1, 1), (3.0, 3.0, 0.5)),
    NEO_HOOKE,
    Supports(("x1", "y1"), {"x0": 0, "y0": 1}),
    ("z0",),
)
Calls = dict[str, tuple[Callable[[], object], str]]
STRANGE = ("x", 1.5, True, ("x", 1), {"x": 1}, np.zeros((2, 2)), object())


@cache
def solution() -> Solution:
    """A pulled block."""
    return solve(Problem(BOX, NEO_HOOKE, CLAMPED, ("x1",)), -0.01)


def _each(function: Callable[..., object], name: str, values: tuple[Any, ...], words: str) -> Calls:
    """A call with each value of one parameter; the sentence must have the ``words``."""
    label = f"{function!r} {name}"
    return {
        f"{label} {number} = {value!r}": (partial(function, **{name: value}), words)
        for number, value in enumerate(values)
    }


def paths() -> Calls:
    """Arguments that the three walks share, and their own."""
    sizes = {solve: {}, trace: {"pressure": 0.01}, inflate: {"volume": 0.1}}
    calls: Calls = {}
    for function, given in sizes.items():
        calls |= _each(partial(function, **given), "problem", (None, *STRANGE), "problem must be")
        walk = partial(function, SHEET, **given)
        calls |= _each(walk, "options", STRANGE, "options must be")
        calls |= _each(walk, "listener", STRANGE, "listener must be a function")
        calls |= _each(walk, "after", (*STRANGE, SHEET), "after must be")
    number = (None, "1", True, (1.0,), np.zeros(2), 1j)
    calls |= _each(partial(solve, SHEET), "pressure", number, "pressure must be")
    calls |= _each(partial(inflate, SHEET), "volume", number, "volume must be")
    calls |= _each(partial(trace, SHEET, 0.01), "steps", number, "steps must be")
    calls |= _each(partial(trace, SHEET, 0.01), "longest_step", number, "longest_step must be")
    calls |= _each(partial(trace, SHEET, 0.01), "until", STRANGE, "until must be")
    several = (None, "01", 1.0, ("1",), ((1.0,),), np.zeros((2, 2)), {"x": 1})
    calls |= _each(partial(solve, SHEET, 0.01), "stops", several, "stops")
    calls |= _each(partial(inflate, SHEET, 0.1), "stops", several, "stops")
    calls |= _each(partial(solve, SHEET, 0.01), "resume", STRANGE, "resume must be")
    calls |= _each(partial(solve, SHEET, 0.01), "guard", STRANGE, "guard must be a function")
    calls |= _each(partial(solve, SHEET, 0.01), "initial", STRANGE, "initial")
    for answer in (True, 1, object(), np.zeros(2)):
        guard, until = (lambda _, answer=answer: answer for _ in range(2))
        calls[f"guard that returns {answer!r}"] = (
            partial(solve, SHEET, 0.01, guard=guard), "guard must return"
        )  # fmt: skip
        if answer is not True:
            calls[f"until that returns {answer!r}"] = (
                partial(trace, SHEET, 0.01, until=until), "until must return"
            )  # fmt: skip
    return calls


def results() -> Calls:
    """What is read from a solution."""
    calls: Calls = {}
    readers = (strain_energy, potential, folded_elements, contact_forces, membrane_forces)
    for reader in (*readers, peaks_by_region, nodal_cauchy, nodal_von_mises, peak_von_mises):
        calls |= _each(reader, "solution", (None, *STRANGE), "solution must be")
    calls |= _each(partial(reaction, surface="x0"), "solution", STRANGE, "solution must be")
    calls |= _each(partial(transfer, finer_mesh=BOX), "solution", STRANGE, "solution must be")
    calls |= _each(partial(write_vtu, "x.vtu"), "solution", STRANGE, "solution must be")
    point = (None, 0.0, "origin", (0.0, 0.0), (0.0, 0.0, "z"), (0.0, 0.0, float("nan")))
    calls |= _each(partial(reaction, solution(), "x0"), "about", point, "about (mm) must be")
    calls |= _each(partial(contact_forces, solution()), "about", point, "about (mm) must be")
    calls |= _each(partial(transfer, solution()), "finer_mesh", STRANGE, "finer_mesh must be")
    paths = (None, 3, ("x.vtu",), "x.stl", "x")
    calls |= _each(partial(write_vtu, solution=solution()), "path", paths, "path must")
    calls |= _each(work, "solutions", (*STRANGE, solution(), (None,)), "solutions must be")
    still = np.zeros(BOX.nodes.shape)
    moved = (None, 0.0, still[0], still[1:], still + float("nan"), still.astype(str))
    for read in (partial(rotation, surface="x1"), partial(cavity_volume, surfaces=("x1",))):
        calls |= _each(partial(read, displacement=still), "mesh", STRANGE, "mesh must be")
        calls |= _each(partial(read, mesh=BOX), "displacement", moved, "displacement must be")
    calls |= _each(partial(rotation, BOX, still), "surface", STRANGE[1:], "surface must be")
    calls |= _each(partial(cavity_volume, BOX, still), "surfaces", ("x1", 3), "surfaces must be")
    return calls


def parts() -> Calls:
    """Truth values for axes, which would select by themselves; files, constants, options."""
    calls: Calls = {}
    for axis in (True, False, 1.0, np.zeros(2)):
        calls[f"axis {axis!r}"] = (partial(Supports, symmetry={"x0": axis}), "symmetry axis")
        node = {(0.0, 0.0, 0.0): axis}
        calls[f"axis of a node {axis!r}"] = (partial(Supports, nodes=node), "axis of the node")
        calls[f"axis of a contact {axis!r}"] = (partial(Contact, "x1", 0.1, axis), "axis must be")
    for read in (Checkpoint.load_from,):
        calls |= _each(read, "path", (None, 3, ("x",)), "path must be")
    constant = (None, "0.1", (0.1,), {"c": 1}, True)
    calls |= _each(partial(Ogden.mooney_rivlin, c01=0.1), "c10", constant, "c10 must be")
    calls |= _each(Ogden.yeoh, "c10", constant, "c10 must be")
    solvers = (None, 3, {"x": 1}, np.zeros(2))
    calls |= _each(SolverOptions, "linear_solver", solvers, "linear_solver must be")
    complex_nodes = partial(Mesh, tets=BOX.tets)
    calls |= _each(complex_nodes, "nodes", (BOX.nodes + 0j,), "nodes must be numbers")
    return calls


def arguments() -> tuple[Finding, ...]:
    """All of them; and what is as good as the kind asked for is taken."""
    stops = np.array([0.004])
    found = solve(SHEET, np.float64(0.01), stops=stops, guard=lambda state: "")
    return (
        refused("walks", paths()),
        refused("results", results()),
        refused("parts of problems", parts()),
        true("arrays and numbers of NumPy are taken", len(found.at_stops) == 1),
    )


ARGUMENTS = HardCase(
    "Arguments of another kind, in every function",
    "an error from the depths, a truth value that counts as an axis, a point that is no point",
    "refused with the argument's name and what belongs there",
    arguments,
)
