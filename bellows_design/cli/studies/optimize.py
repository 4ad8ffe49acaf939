"""``bellows optimize``: the best design of a kind, from its options to its files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, cast

from bellows_design.cli.answer import DONE, NOT_SOLVED, REFUSED, Answer, unwritten
from bellows_design.cli.layout.said import stated
from bellows_design.cli.options import DesignOptions
from bellows_design.cli.output_files import require_file, require_plot
from bellows_design.cli.studies.workers import who_works
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving
from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted, quoted_path

if TYPE_CHECKING:
    from bellows_design.design.design import Design
    from bellows_design.study.optimize.goal import Goal, Quantity
    from bellows_design.study.optimize.space.choices import Bounds
    from bellows_design.study.optimize.stages import Effort, Optimization

LONGEST_MINUTES = 10_000.0


@dataclass(frozen=True)
class GoalOptions:
    """What is sought, as it stands on the command line."""

    quantity: str
    angle: float | None = None
    stress: float | None = None
    strain: float | None = None
    touching: bool = False
    least_force: float | None = None

    def goal(self, base: Design) -> Goal:
        """Within the design's own limit of the stress if none is given. Raises ``DesignError``."""
        from bellows_design.study.optimize.goal import LEAST_GAP, Goal

        most = base.max_von_mises if self.stress is None else self.stress
        if most > base.max_von_mises:
            raise DesignError(
                f"--stress is {most:g} MPa but must not exceed the design's limit of "
                f"{base.max_von_mises:g} MPa; --set limits.max_von_mises changes that."
            )
        strain = None if self.strain is None else self.strain / 100
        gap = None if self.touching else LEAST_GAP
        quantity = cast("Quantity", self.quantity)
        return Goal(quantity, most, self.angle, strain, gap, self.least_force)


@dataclass(frozen=True)
class CountOptions:
    """Which counts are looked at, as they stand on the command line."""

    lines: str | None = None
    bubbles: str | None = None
    indents: bool = True
    gap: float | None = None
    passage: float | None = None

    def bounds(self, base: Design) -> Bounds:
        """Raises ``DesignError`` for what is no count, or less than the printer's."""
        from bellows_design.study.optimize.space.choices import Bounds

        profile = base.profile()
        for name, value, least in (
            ("gap", self.gap, profile.minimum_gap),
            ("passage", self.passage, profile.line_width),
        ):
            if value is not None and not least <= value <= 20:
                raise DesignError(f"--{name} is {value:g} mm but must be {least:g} to 20 mm.")
        return Bounds(
            counts("lines", self.lines, profile.minimum_lines, 20),
            counts("bubbles", self.bubbles, 3, 100),
            self.indents,
            self.gap,
            self.passage,
        )


@dataclass(frozen=True)
class OptimumFiles:
    """Where the optimum goes: a folder with its results, its designs and a summary."""

    folder: Path
    plot: Path | None = None

    def require(self) -> None:
        """Refuse a folder that cannot be written, by trying it. Raises ``DesignError``."""
        if self.folder.exists() and not self.folder.is_dir():
            raise DesignError(f"{quoted_path(self.folder)} is a file, not a folder to write to.")
        if not self.folder.parent.is_dir():
            raise DesignError(f"there is no folder {quoted_path(self.folder.parent)} to write to.")
        if self.folder.is_dir() and any(self.folder.iterdir()) and not self.results.is_file():
            raise DesignError(
                f"{quoted_path(self.folder)} holds other files; name a folder of its own for the "
                "optimum."
            )
        if self.plot is not None and self.plot.parent != self.folder:
            require_plot(self.plot)
        self.folder.mkdir(exist_ok=True)
        require_file(self.results, ".sqlite")
        require_plot(self.plot)

    @property
    def results(self) -> Path:
        """All answers; a run that is interrupted goes on from them."""
        return self.folder / "optimum.sqlite"


def counts(name: str, text: str | None, least: int, most: int) -> tuple[int, ...]:
    """Whole numbers written as ``3,4`` or ``7-10``; none for all. Raises ``DesignError``."""
    if text is None:
        return ()
    found: set[int] = set()
    for part in text.split(","):
        first, dash, last = part.partition("-")
        try:
            low, high = int(first), int(last if dash else first)
        except ValueError:
            raise DesignError(
                f"--{name} is {quoted(text)} but must be whole numbers, such as 3,4 or 7-10."
            ) from None
        if not least <= low <= high <= most:
            raise DesignError(
                f"--{name} is {quoted(text)} but must lie between {least} and {most}."
            )
        found.update(range(low, high + 1))
    return tuple(sorted(found))


def optimize(
    options: DesignOptions,
    sought: GoalOptions,
    counted: CountOptions,
    files: OptimumFiles,
    minutes: float,
    seed: int,
    verify: bool,
    half: bool,
    workers: int | None,
    scheduler: str | None,
) -> Answer:
    """Search until the time is over; write the front as designs, and what the best is."""
    from bellows_design.batch.results import opened
    from bellows_design.reports.studies.optimum import optimum_tables
    from bellows_design.reports.studies.optimum_plot import plot_optimum
    from bellows_design.study.optimize.designs import content_of, designs_of, write_designs
    from bellows_design.study.optimize.run import optimize as search
    from bellows_design.study.optimize.run import study_of

    require_working_folder()
    require_address_space(EVALUATION)
    if sought.least_force is not None and not verify:
        raise DesignError("--least-force is kept by the verification; leave out --no-verify.")
    if not (math.isfinite(minutes) and 0 < minutes <= LONGEST_MINUTES):
        raise DesignError(
            f"--minutes is {minutes:g} but must lie above 0 and not above {LONGEST_MINUTES:g}."
        )
    optimization = _optimization(options, sought, counted, seed)
    executor = who_works(workers, scheduler)
    files.require()
    with (
        solving() as progress,
        opened(files.results, study_of(optimization)) as results,
    ):
        found = search(optimization, results, executor, minutes, verify, half, progress)
    designs = designs_of(found)
    content = stated(content_of(found, designs))
    writers = [partial(write_designs, designs, content, files.folder)]
    if files.plot is not None:
        writers.append(partial(plot_optimum, found, files.plot))
    failed = unwritten(*writers)
    status = NOT_SOLVED if found.best is None else DONE if found.holds else REFUSED
    return Answer(content, optimum_tables(found, designs, files.folder), status, failed)


def _optimization(
    options: DesignOptions, sought: GoalOptions, counted: CountOptions, seed: int
) -> Optimization:
    from bellows_design.study.optimize.search.global_stage import require_optuna
    from bellows_design.study.optimize.stages import Optimization

    if seed < 0:
        raise DesignError(f"--seed is {seed} but must be 0 or more.")
    base = options.load()
    base.profile()
    require_optuna()
    if base.load.pressure < 0:
        raise DesignError(
            f"load.pressure is {base.load.pressure:g} MPa, but an optimization needs one above 0."
        )
    goal, bounds = sought.goal(base), counted.bounds(base)
    optimization = Optimization(base, goal, bounds, _effort(seed))
    if not optimization.choices:
        raise DesignError(
            f"no number of bubbles fits into length = {base.bellows.length:g} mm after offset = "
            f"{base.bellows.offset:g} mm within these lines, gaps and passages."
        )
    return optimization


def _effort(seed: int) -> Effort:
    """As much as the time allows."""
    from bellows_design.study.optimize.stages import Effort

    return Effort(seed=seed)
