"""``bellows compare``: a measurement against the model, from its options to its answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer, unwritten
from bellows_design.cli.options import BudgetOptions, DesignOptions
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving, usual_store
from bellows_design.errors import DesignError
from bellows_design.measured.comparison import CompareOptions, Comparison
from bellows_design.measured.reading.load import CurveOptions

if TYPE_CHECKING:
    from bellows_design.budget import Budget
    from bellows_design.design.design import Design
    from bellows_design.materials.material import Material
    from bellows_design.measured.model.question import Question
    from bellows_design.measured.reading.curve import MeasuredCurve
    from bellows_design.own_body import OwnBody
    from bellows_design.reports.measured.tables import MeasuredReport


@dataclass(frozen=True)
class ComparingOptions:
    """What is asked, as it stands on the command line."""

    design: DesignOptions
    data: Path
    reading: CurveOptions = field(default_factory=CurveOptions)
    compared: CompareOptions = field(default_factory=CompareOptions)
    angle: str = "tangent"
    scene: str | None = None
    part: str | None = None
    material: Path | None = None
    plot: Path | None = None
    limits: BudgetOptions = field(default_factory=BudgetOptions)
    cached: bool = True

    def require(self) -> None:
        """Refuse what cannot be done before anything is computed. Raises ``DesignError``."""
        require_file(self.material, ".toml")
        require_plot(self.plot)
        if self.material is not None and not self.compared.fit:
            raise DesignError("--write-material needs the factor; leave out --no-fit.")
        if self.compared.offset and not self.compared.fit:
            raise DesignError("--fit-offset needs the fit; leave out --no-fit.")


def compare_answer(options: ComparingOptions) -> Answer:
    """Compare; write a material and a plot if asked.

    Exit status 1, and no material, if one was asked for and no factor is determined.
    """
    from bellows_design.reports.measured.tables import MeasuredReport, measured_text

    options.require()
    found = _compared(options)
    report, writers = _with_files(options, MeasuredReport(found, plot_file=options.plot))
    failed = unwritten(*writers)
    if failed is not None:
        report = replace(report, material_file=None, plot_file=None)
    status = REFUSED if report.material_refused else DONE
    return Answer(report.to_dict(), measured_text(report), status, failed)


def _compared(options: ComparingOptions) -> Comparison:
    """The comparison; all that can be refused is refused before anything is solved."""
    from bellows_design.cli.own_body.evaluate import body_named
    from bellows_design.measured.reading.load import load_curve

    require_working_folder()
    require_address_space(EVALUATION)
    body = body_named(options.design, "auto", False)
    measured = load_curve(options.data, options.reading)
    budget = options.limits.budget()
    if body is not None:
        return _of_body(options, body, measured, budget)
    return _of_bellows(options, measured, budget)


def _of_bellows(options: ComparingOptions, measured: MeasuredCurve, budget: Budget) -> Comparison:
    from bellows_design.measured.comparison import compare
    from bellows_design.measured.model.bellows import BellowsModel

    if options.part is not None:
        raise DesignError("--part is for own bodies: a bellows is one part.")
    design = options.design.load()
    question = _question(options, design, measured)
    with solving() as progress:
        store = usual_store(progress) if options.cached else None
        model = BellowsModel(design, progress, budget, store)
        return compare(
            design.name, design.material, measured, partial(model.curve, question), options.compared
        )


def _of_body(
    options: ComparingOptions, body: OwnBody, measured: MeasuredCurve, budget: Budget
) -> Comparison:
    """Of a body of one's own, of which nothing is kept."""
    from bellows_design.measured.comparison import compare
    from bellows_design.measured.model.body import BodyModel
    from bellows_design.measured.model.question import Question

    if options.scene is not None:
        raise DesignError("--scene is for bellows: an own body has obstacles in its file.")
    question = Question(measured.quantity, options.angle, sign=_sign(measured))
    with solving() as progress:
        model = BodyModel(body, progress, budget, options.part)
        if options.material is not None and model.materials > 1:
            raise DesignError(
                "--write-material writes one material, but the parts have several; --part names "
                "one of them."
            )
        return compare(
            body.name, model.material, measured, partial(model.curve, question), options.compared
        )


def _sign(measured: MeasuredCurve) -> float:
    """Of the pressures: -1 for a vacuum."""
    return -1.0 if measured.pressure[-1] < 0 else 1.0


def _question(options: ComparingOptions, design: Design, measured: MeasuredCurve) -> Question:
    from bellows_design.design.scenes.scene import check_fits, named_scene
    from bellows_design.measured.model.question import Question

    sign = _sign(measured)
    if options.scene is None:
        return Question(measured.quantity, options.angle, sign=sign)
    name, scene = named_scene(options.scene, design.scenes)
    check_fits(scene, f"scene {name}", design.finger_length)
    exerting = scene.kind in ("blocked", "grip")
    if exerting != measured.quantity.by_force:
        needed = "blocked or grip" if measured.quantity.by_force else "free or payload"
        raise DesignError(
            f"--scene {name} is of the kind {scene.kind}, but a {measured.quantity.words} needs "
            f"one of the kind {needed}."
        )
    return Question(measured.quantity, options.angle, scene, name, sign)


def _with_files(
    options: ComparingOptions, report: MeasuredReport
) -> tuple[MeasuredReport, list[Callable[[], None]]]:
    """The report with the files that can be written, and what writes them."""
    from bellows_design.materials.library import write_material
    from bellows_design.reports.measured.plot import plot_measured

    writers: list[Callable[[], None]] = []
    if options.plot is not None:
        writers.append(partial(plot_measured, report.found, options.plot))
    if options.material is not None:
        material, refused = _material(report.found, options.material)
        file = None if material is None else options.material
        report = replace(report, material_file=file, material_refused=refused)
        if material is not None:
            writers.append(partial(write_material, material, options.material))
    return report, writers


def _material(found: Comparison, file: Path) -> tuple[Material | None, str | None]:
    """The material with the factor; or why there is none."""
    from bellows_design.cli.output_files import name_of
    from bellows_design.measured.calibrated import calibrated_material

    factor = found.factor
    if factor is None:
        return None, found.fitted.refused
    name = name_of(file, "calibrated")
    try:
        ends = (factor.value, factor.low, factor.high)
        return calibrated_material(found.material, *ends, name, found.measured.name), None
    except DesignError as error:
        return None, str(error)
