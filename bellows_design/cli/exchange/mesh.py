"""From the options of ``bellows mesh`` to its answer."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import Answer
from bellows_design.cli.output_files import require_folder
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving

if TYPE_CHECKING:
    from bellows_design.cli.options import BudgetOptions, DesignOptions
    from bellows_design.exchange import Written


def mesh(
    options: DesignOptions,
    output: Path,
    model: str | None,
    program: str | None,
    size: float | None,
    limits: BudgetOptions,
) -> Answer:
    """Mesh the design's body and write it for another program."""
    from bellows_design.exchange.files import write_design_mesh
    from bellows_design.exchange.formats import names_of_files, program_for

    require_working_folder()
    require_address_space(EVALUATION)
    design, budget = options.load(), limits.budget()
    for path in names_of_files(output, program_for(output, program)):
        require_folder(path)
    with solving() as progress:
        progress.stage(f"mesh for {output.name}")
        written = write_design_mesh(design, output, model, program, size, budget)
    content = {
        "design": design.name,
        "digest": design.digest,
        "model": written.model,
        "program": written.program or None,
        "files": [str(path) for path in written.files],
        "pressure_mpa": design.load.pressure if written.program else None,
        "nodes": len(written.mesh.nodes),
        "elements": len(written.mesh.tets),
        "surfaces": {name: len(each) for name, each in written.mesh.surfaces.items()},
        "notes": list(written.notes),
    }
    return Answer(content, _text(written))


def _text(written: Written) -> list[str]:
    mesh, main = written.mesh, written.files[0]
    lines = [f"{main}: {written.model}, {len(mesh.tets)} tetrahedra, {len(mesh.nodes)} nodes"]
    lines += [f"{path}" for path in written.files[1:]]
    return lines + [f"note: {note}" for note in written.notes]
