"""The sections of a report, one module each: from findings to blocks."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bellows_design.reports.page.blocks import Section
    from bellows_design.reports.page.findings import Findings


def in_order() -> tuple[Callable[[Findings], Section], ...]:
    """What makes each section, in the order of the page."""
    from bellows_design.reports.page.sections.computation import computation
    from bellows_design.reports.page.sections.files import files
    from bellows_design.reports.page.sections.force import force
    from bellows_design.reports.page.sections.leak_test import leak_test
    from bellows_design.reports.page.sections.material import material
    from bellows_design.reports.page.sections.parameters import parameters
    from bellows_design.reports.page.sections.pressure import pressure
    from bellows_design.reports.page.sections.printability import printability
    from bellows_design.reports.page.sections.printing import printing
    from bellows_design.reports.page.sections.sensitivities import sensitivities
    from bellows_design.reports.page.sections.shape import deformed, part

    return (
        part,
        deformed,
        pressure,
        printability,
        leak_test,
        force,
        sensitivities,
        parameters,
        material,
        computation,
        files,
        printing,
    )
