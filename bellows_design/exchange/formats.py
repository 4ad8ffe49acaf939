"""Endings of the files that other programs get; apart, so that a command knows them at once."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted

ACTUATOR_SUFFIXES = (".vtu", ".xdmf")
"""Of the whole deformed actuator."""

FORMATS = {
    ".inp": ("abaqus", "calculix"),
    ".vtk": ("sofa",),
    ".msh": ("",),
    ".vtu": ("",),
    ".xdmf": ("",),
}
"""Of a design's mesh, and the programs that a file with each may be for; the first where none is
named."""

MODEL_FOR = {"sofa": "full"}
"""The model for a program where it is not half of the actuator."""


def program_for(path: Path, program: str | None) -> str:
    """The program that a file is for, by its ending; empty for a mesh and nothing else.

    Raises ``DesignError`` for an ending that nothing is written with, or another program's.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise DesignError(f"{quoted(str(path))} must end in {_any_of(FORMATS)}.")
    known = FORMATS[suffix]
    if program is None:
        return known[0]
    if program not in known:
        fitting = [ending for ending, programs in FORMATS.items() if program in programs]
        if not fitting:
            every = [name for programs in FORMATS.values() for name in programs if name]
            raise DesignError(f"--for {quoted(program)} must be one of {', '.join(every)}.")
        raise DesignError(f"a file for {program} must end in {_any_of(fitting)}.")
    return program


def names_of_files(path: Path, program: str) -> tuple[Path, ...]:
    """The files that are written for a program."""
    if program != "sofa":
        return (path,)
    beside = (path.with_name(f"{path.stem}{end}") for end in ("_cavity.stl", "_scene.py"))
    return (path, *beside)


def check_model(path: Path, model: str) -> None:
    """Raise ``DesignError`` for a model whose loads a file cannot hold."""
    if path.suffix.lower() in (".inp", ".vtk") and model == "unit-cell":
        raise DesignError(
            f"{quoted(str(path))} holds loads as well, and no other program has the unit cell's "
            "moving plane; take --model half or full, or a mesh: .msh, .vtu or .xdmf."
        )


def _any_of(words: Iterable[str]) -> str:
    *others, last = words
    return f"{', '.join(others)} or {last}" if others else last
