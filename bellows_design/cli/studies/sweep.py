"""``bellows study sweep``: many designs around one, in a file that outlives interruptions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, NOT_SOLVED, Answer, unwritten
from bellows_design.cli.options import DesignOptions
from bellows_design.cli.output_files import require_file
from bellows_design.cli.studies.workers import who_works
from bellows_design.cli.surroundings.environment import require_working_folder
from bellows_design.cli.surroundings.memory import EVALUATION, require_address_space
from bellows_design.cli.surroundings.solving import solving
from bellows_design.errors import DesignError
from bellows_design.files.errors import CannotWrite

if TYPE_CHECKING:
    from bellows_design.batch.results import Results
    from bellows_design.study.sweep.plan import Space


@dataclass(frozen=True)
class SpaceOptions:
    """What is looked at, as it stands on the command line."""

    design: DesignOptions
    vary: tuple[str, ...]
    sampling: str
    number: int | None
    seed: int
    ordinary: bool
    accuracy: float | None

    def space(self) -> Space:
        """The space that is meant. Raises ``DesignError``."""
        from bellows_design.study.sweep.plan import Space
        from bellows_design.study.sweep.sampling import Sampling
        from bellows_design.study.sweep.space import axes

        if self.accuracy is not None and not self.ordinary:
            raise DesignError(
                "--accuracy needs --ordinary: a design that is reached from a neighbour is as "
                "accurate as that one."
            )
        if self.accuracy is not None and not 0.01 <= self.accuracy <= 100:
            raise DesignError(f"accuracy = {self.accuracy:g} % must lie between 0.01 and 100 %.")
        if self.seed < 0:
            raise DesignError(f"--seed is {self.seed} but must be 0 or more.")
        base = self.design.load()
        return Space(
            base,
            axes(self.vary, base),
            Sampling(self.sampling),
            self.number,
            self.seed,
            "ordinary" if self.ordinary else "nearest",
            self.accuracy,
        )


@dataclass(frozen=True)
class Files:
    """What is written: the results, and the same as a table."""

    results: Path
    csv: Path | None = None
    parquet: Path | None = None

    def require(self) -> None:
        """Refuse what cannot be written, by trying it, or for want of a library."""
        for path, suffix in (
            (self.results, ".sqlite"),
            (self.csv, ".csv"),
            (self.parquet, ".parquet"),
        ):
            require_file(path, suffix)
        if self.parquet is not None:
            from bellows_design.batch.export import require_pyarrow

            require_pyarrow()

    def export(self, results: Results) -> CannotWrite | None:
        """Write the tables; why the first that fails cannot be."""
        from bellows_design.batch.export import write_csv, write_parquet

        writers: list[Callable[[], None]] = []
        if self.csv is not None:
            writers.append(partial(write_csv, results, self.csv))
        if self.parquet is not None:
            writers.append(partial(write_parquet, results, self.parquet))
        return unwritten(*writers)


def sweep(
    options: SpaceOptions,
    files: Files,
    workers: int | None,
    scheduler: str | None,
    retry_failed: bool,
) -> Answer:
    """Answer what the file does not have yet, and count what it has."""
    from bellows_design.reports.studies.sweep import sweep_tables

    require_working_folder()
    require_address_space(EVALUATION)
    files.require()
    space = options.space()
    executor = who_works(workers, scheduler)
    from bellows_design.batch.results import opened
    from bellows_design.study.sweep.plan import planned
    from bellows_design.study.sweep.run import run

    with solving() as progress:
        progress.stage("which designs, and in which order")
        plan = planned(space)
        with opened(files.results, plan.study) as results:
            outcome = run(plan, results, executor, retry_failed, progress)
            failure = files.export(results)
            text = sweep_tables(plan, results, outcome)
    content = {
        "design": space.base.name,
        "digest": space.base.digest,
        "file": str(files.results),
        "options": dict(plan.study.options),
        **outcome.to_dict(),
    }
    return Answer(content, text, DONE if outcome.done else NOT_SOLVED, failure)
