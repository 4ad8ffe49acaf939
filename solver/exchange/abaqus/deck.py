"""A problem as an input file that Abaqus or CalculiX computes: a cross-check by another program."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np

from solver.errors import SolverError
from solver.exchange.abaqus.boundary import held_lines, moved_lines
from solver.exchange.abaqus.loads import load_lines
from solver.exchange.abaqus.materials import differences, material_lines
from solver.exchange.abaqus.mesh_text import mesh_text, parts
from solver.input_types import check_instance, check_number, file_path
from solver.material.law import Hyperelastic
from solver.problem.problem import Problem

Program = Literal["abaqus", "calculix"]

ELEMENTS = {"abaqus": "C3D10H", "calculix": "C3D10"}
"""Hybrid elements where there are any: displacements alone lock in nearly incompressible rubber."""

STEP = {"abaqus": "*STEP, NLGEOM=YES, INC=1000", "calculix": "*STEP, NLGEOM, INC=1000"}

FIRST, SMALLEST, LARGEST = 0.02, 1e-6, 0.1
"""Increments as fractions of the load: soft bodies yield most at the start."""

MAIN = "main"
"""Name of the material of all elements whose region has none of its own."""


def write_deck(
    path: Path | str,
    problem: Problem,
    pressure: float = 0.0,
    program: Program = "abaqus",
    title: str = "",
) -> tuple[str, ...]:
    """Write a problem as an input file of Abaqus or CalculiX, to be computed there.

    Surfaces and regions keep their names; nodes and elements count from 1. The pressure follows the
    surfaces, dead loads are the same nodal forces as here. ``read_mesh`` reads the mesh back.

    Args:
        path: ``.inp``; the file is overwritten.
        problem: what is to be computed.
        pressure: MPa, of the whole load.
        program: ``abaqus`` (hybrid elements C3D10H, incompressible where the material is) or
            ``calculix`` (C3D10; incompressible materials get a bulk modulus of 20 shear moduli).
        title: a line for the head.

    Returns:
        What the deck leaves out (contact) and what differs in its materials, a sentence each.

    Raises:
        SolverError: another ending or program; a moving plane, springs, membranes, motions that do
            not grow in proportion to the load, or a material that the program does not have.
        OSError: the file cannot be written.

    Examples:
        >>> from pathlib import Path
        >>> from solver import Ogden, Problem, Supports, write_deck
        >>> from solver.mesh import block
        >>> shell = block((30, 10, 10), (6, 4, 4), hollow=((1, 1, 1), (5, 3, 3)))
        >>> problem = Problem(shell, Ogden.neo_hooke(0.5), Supports(("x0",)), ("cavity",))
        >>> write_deck("shell.inp", problem, 0.02)  # MPa; nothing is left out
        ()
        >>> "*HYPERELASTIC" in Path("shell.inp").read_text().upper()
        True
    """
    place = file_path("write_deck: path", path)
    check_instance("write_deck: problem", problem, Problem)
    check_number("write_deck: pressure", pressure)
    if place.suffix.lower() != ".inp":
        raise SolverError(f"write_deck: path must end in .inp, got {str(place)!r}.")
    if program not in ELEMENTS:
        raise SolverError(f"write_deck: program must be abaqus or calculix, got {program!r}.")
    _check_problem(problem, pressure)
    notes = (*_left_out(problem), *_of_materials(problem, program))
    lines = _lines(problem, pressure, program, title, notes)
    place.write_text("\n".join(lines) + "\n", "utf-8")
    return notes


def _lines(
    problem: Problem, pressure: float, program: str, title: str, notes: tuple[str, ...]
) -> Iterator[str]:
    yield "*HEADING"
    yield " ".join(title.split()) or "written by bellows-design"
    yield f"** for {program}; mm, N, MPa"
    yield from (f"** note: {sentence}" for sentence in notes)
    yield from mesh_text(problem.mesh, ELEMENTS[program])
    yield from _materials(problem, program)
    yield from held_lines(problem)
    yield STEP[program]
    yield "*STATIC"
    yield f"{FIRST}, 1.0, {SMALLEST}, {LARGEST}"
    yield from moved_lines(problem)
    yield from load_lines(problem, pressure)
    yield from _output(program)
    yield "*END STEP"


def _materials(problem: Problem, program: str) -> Iterator[str]:
    """Sections and materials, those that some element has."""
    for part, name in _used(problem).items():
        yield f"*SOLID SECTION, ELSET={part}, MATERIAL={name}"
    for name in dict.fromkeys(_used(problem).values()):
        yield from material_lines(name, _material(problem, name), program)


def _used(problem: Problem) -> dict[str, str]:
    """Names of the parts of the mesh that have elements, and of the material of each."""
    return {name: name if name in problem.materials else MAIN for name in parts(problem.mesh)}


def _material(problem: Problem, name: str) -> Hyperelastic:
    return problem.materials.get(name, problem.material)


def _of_materials(problem: Problem, program: str) -> Iterator[str]:
    """What differs in the materials, each sentence once."""
    names = dict.fromkeys(_used(problem).values())
    yield from dict.fromkeys(
        sentence for name in names for sentence in differences(_material(problem, name), program)
    )


def _output(program: str) -> Iterator[str]:
    if program == "abaqus":
        yield "*RESTART, WRITE, FREQUENCY=0"
        yield "*OUTPUT, FIELD, FREQUENCY=1"
        yield "*NODE OUTPUT"
        yield "U, RF"
        yield "*ELEMENT OUTPUT"
        yield "S, LE"
        return
    yield "*NODE FILE"
    yield "U"
    yield "*EL FILE"
    yield "S"


def _check_problem(problem: Problem, pressure: float) -> None:
    """Raise ``SolverError`` for what an input file would have to leave out wrongly."""
    if not np.isfinite(pressure):
        raise SolverError(f"write_deck: pressure must be a finite number of MPa, got {pressure}.")
    if problem.moving_plane is not None:
        raise SolverError(
            "write_deck: a moving plane turns by finite angles and stretches in itself, which no "
            "linear equation of an input file says; write the half or the whole body."
        )
    if MAIN in problem.materials:
        raise SolverError(f"write_deck: no region with a material may be called {MAIN!r}.")
    for what, members in (("springs", problem.springs), ("membranes", problem.membranes)):
        if members:
            raise SolverError(f"write_deck: {what} cannot be written to an input file yet.")


def _left_out(problem: Problem) -> tuple[str, ...]:
    if not problem.contacts:
        return ()
    return (
        f"{len(problem.contacts)} contacts of walls with each other or with planes are left out: "
        "compare at pressures below the first touch",
    )
