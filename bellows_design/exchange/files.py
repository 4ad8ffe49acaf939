"""The mesh of a design as the files of another program, all of them or none."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.budget import DEFAULT, Budget
from bellows_design.design.design import Design
from bellows_design.exchange.formats import MODEL_FOR, check_model, names_of_files, program_for
from bellows_design.files.atomic import replacing

if TYPE_CHECKING:
    from solver import Mesh, Problem
    from solver.exchange.abaqus.deck import Program

Writer = Callable[[Path], None]


@dataclass(frozen=True)
class Written:
    """What was written, and what the files leave out, a sentence each."""

    problem: Problem
    model: str
    program: str
    files: tuple[Path, ...]
    notes: tuple[str, ...]

    @property
    def mesh(self) -> Mesh:
        """The mesh in the files."""
        return self.problem.mesh


def write_design_mesh(
    design: Design,
    path: Path | str,
    model: str | None = None,
    program: str | None = None,
    size: float | None = None,
    budget: Budget = DEFAULT,
) -> Written:
    """Mesh a design's body and write it for another program.

    Args:
        design: What is meshed, and loaded with its pressure.
        path: ``.inp``: a whole deck for Abaqus or CalculiX. ``.vtk``: the volume for SOFA, and
            beside it the surface of the cavity and a scene. ``.msh``, ``.vtu``, ``.xdmf``: the mesh
            with its named surfaces.
        model: ``half``, ``full`` or ``unit-cell``; without it half, for SOFA the whole.
        program: ``abaqus`` or ``calculix`` for an ``.inp``; without it Abaqus.
        size: Largest edge of a tetrahedron, mm.
        budget: As for ``design_problem``.

    Returns:
        The problem and the files. They are there completely, or as they were before.

    Raises:
        DesignError: another ending or program, a model that a deck cannot be made of, or what
            ``design_problem`` refuses.
        CannotWrite: a file cannot be written.
        MeshingError: no usable mesh, or none in time.
    """
    from bellows_design.exchange.design_mesh import design_problem

    target = Path(path)
    chosen = program_for(target, program)
    body = model or MODEL_FOR.get(chosen, "half")
    check_model(target, body)
    problem = design_problem(design, body, size, budget)
    notes: list[str] = []
    writers = _writers(design, problem, target, chosen, body, notes)
    _write_all(writers)
    return Written(problem, body, chosen, tuple(writers), tuple(notes))


def _writers(
    design: Design, problem: Problem, path: Path, program: str, model: str, notes: list[str]
) -> dict[Path, Writer]:
    """What writes each file; a writer may add to ``notes``."""
    if program == "sofa":
        return _sofa(design, problem, path, model == "half", notes)
    if path.suffix.lower() == ".inp":
        return {path: lambda place: notes.extend(_deck(design, problem, place, program))}
    from solver import write_mesh

    return {path: lambda place: write_mesh(place, problem.mesh)}


def _deck(design: Design, problem: Problem, path: Path, program: str) -> tuple[str, ...]:
    from solver import write_deck

    deck_for: Program = "calculix" if program == "calculix" else "abaqus"
    title = f"{design.name}, {design.load.pressure:g} MPa, by bellows-design"
    return write_deck(path, problem, design.load.pressure, deck_for, title)


def _sofa(
    design: Design, problem: Problem, path: Path, half: bool, notes: list[str]
) -> dict[Path, Writer]:
    from bellows_design.exchange.linear import cavity_walls, linear
    from bellows_design.exchange.sofa import scene_text, surface_stl, volume_text

    volume, cavity, scene = names_of_files(path, "sofa")
    mesh = linear(problem.mesh)
    notes.append("the scene was not run here; SOFA's linear tetrahedra are too stiff")
    if half:
        notes.append("the cavity of the half model is open at y = 0")
    return {
        volume: lambda place: _text(place, volume_text(mesh, design.name)),
        cavity: lambda place: _bytes(place, surface_stl(*cavity_walls(mesh))),
        scene: lambda place: _text(place, scene_text(design, volume, cavity, half)),
    }


def _text(path: Path, content: str) -> None:
    path.write_text(content, "utf-8")


def _bytes(path: Path, content: bytes) -> None:
    path.write_bytes(content)


def _write_all(writers: dict[Path, Writer]) -> None:
    """All files beside their places first, then each to its place."""
    with ExitStack() as stack:
        for path, write in writers.items():
            write(stack.enter_context(replacing(path)))
