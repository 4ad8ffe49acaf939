"""``bellows force``: what an actuator exerts in a scene, from its options to its answer."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.options import BudgetOptions, DesignOptions
from bellows_design.cli.output_files import require_plot
from bellows_design.cli.pressures import parse_pressures
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store
from bellows_design.errors import DesignError

if TYPE_CHECKING:
    from bellows_design.force.result import ForceCurve

LEAST_FLOW, MOST_FLOW = 0.01, 10_000.0
"""L/min."""


@dataclass(frozen=True)
class ForceOptions:
    """What is asked, as it stands on the command line."""

    design: DesignOptions
    scene: str
    pressure: str | None = None
    by_distance: bool = False
    flow: float | None = None
    picture: Path | None = None
    plot: Path | None = None
    limits: BudgetOptions = field(default_factory=BudgetOptions)
    cached: bool = True

    def require(self) -> None:
        """Refuse what cannot be done before anything is computed. Raises ``DesignError``."""
        flow = self.flow
        if flow is not None and not (math.isfinite(flow) and LEAST_FLOW <= flow <= MOST_FLOW):
            raise DesignError(
                f"--flow is {flow:g} L/min but must be {LEAST_FLOW:g} to {MOST_FLOW:g} L/min."
            )
        require_plot(self.picture)
        require_plot(self.plot)


def force_answer(options: ForceOptions) -> Answer:
    """Compute the force curve of a design in a scene, and draw what is asked for."""
    from bellows_design.reports.force.tables import force_tables

    found = _computed(options)
    failed = unwritten(*_drawings(options, found))
    status = DONE if found.converged else NOT_SOLVED
    return Answer(found.to_dict(), force_tables(found, options.by_distance), status, failed)


def _drawings(options: ForceOptions, found: ForceCurve) -> list[Callable[[], None]]:
    """What draws the files that are asked for."""
    from bellows_design.reports.force.picture import draw_scene
    from bellows_design.reports.force.plot import plot_force

    asked = ((draw_scene, options.picture), (plot_force, options.plot))
    return [partial(draw, found, path) for draw, path in asked if path is not None]


def _computed(options: ForceOptions) -> ForceCurve:
    """The force curve; all that can be refused is refused before."""
    from bellows_design.design.scenes.scene import check_fits, named_scene

    require_working_folder()
    require_address_space(EVALUATION)
    pressures = () if options.pressure is None else parse_pressures(options.pressure)
    design = options.design.load(pressures[-1] if pressures else None)
    name, scene = named_scene(options.scene, design.scenes)
    check_fits(scene, f"scene {name}", design.finger_length)
    options.require()
    budget = options.limits.budget()
    from bellows_design.force.air import FLOW
    from bellows_design.force.curve import force_curve

    with solving() as progress:
        return force_curve(
            design,
            scene,
            pressures or (design.load.pressure,),
            name=name,
            flow=FLOW if options.flow is None else options.flow,
            progress=progress,
            budget=budget,
            store=usual_store(progress) if options.cached else None,
        )
