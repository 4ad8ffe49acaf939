"""The indent of Prototype 2, searched for kind by kind, and verified.

    python tests/benchmarks/indent_search.py [tests/benchmarks/indent_search.json [points]]

For every side and shape so many points (12 without) are spread over the room there is, and walks
lead from the best towards both aims, by ordinary evaluations. What was found, the front of each
kind and the indents of ``CHOSEN`` are evaluated to ``VERIFIED`` percent, against Prototype 2
evaluated likewise. Prints the tables of docs/paper.md and draws docs/indent.png.

Trials are written as they come, below ``trials`` of their kind; a kind whose search is done is not
searched again, and what the store of results has is not computed again. About twenty minutes.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from bellows_design import load_design
from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluation import Evaluation
from bellows_design.budget import Budget
from bellows_design.design.design import Design
from bellows_design.design.indent import Indent
from bellows_design.files.json_files import write_json
from bellows_design.reports.studies.indent_plot import plot_indents
from bellows_design.store import Store, evaluated
from bellows_design.study.changes import Changes
from bellows_design.study.indent.kinds import KINDS, Kind
from bellows_design.study.indent.search import IndentStudy, searched
from bellows_design.study.indent.tester import Tester
from bellows_design.study.indent.trial import Trial, front

VERIFIED = 2.0
"""%. No estimate of the stress is below that."""

BUDGET = Budget(memory=6.0, seconds=600.0)


def evaluate(design: Design, accuracy: float | None = VERIFIED) -> Evaluation:
    """From the store of results, or computed."""
    return evaluated(design, accuracy_percent=accuracy, budget=BUDGET, store=Store.usual())


def survey(design: Design) -> Evaluation:
    """What the search goes by: ordinary evaluations, whose meshes err alike."""
    return evaluate(design, None)


def verified(indent: Indent | None) -> Trial:
    """Prototype 2 with an indent against none."""
    tester = Tester(load_design("prototype_2"), evaluate, _ignored)
    found = tester.plain if indent is None else tester.tried(indent, "verified")
    assert found is not None
    return tester.trial(found, "verified")


def _ignored(_: Trial) -> None:
    pass


def _outside(depth: float, width: float, fillet: float) -> Indent:
    return Indent(side="outside", shape="rectangular", depth=depth, width=width, fillet=fillet)


CHOSEN = (
    _outside(0.4, 2.4, 0.3),  # the one that is shipped
    _outside(0.3, 3.8, 0.3),
    _outside(0.4, 3.4, 0.2),
    _outside(0.49, 3.38, 0.11),
    _outside(0.55, 3.0, 0.12),
    _outside(0.7, 2.3, 0.37),
    _outside(0.8, 1.6, 0.4),
    Indent(side="outside", shape="arc", depth=0.4, width=3.6),
    Indent(side="inside", shape="rectangular", depth=0.3, width=1.2, fillet=0.3),
)
"""What docs/paper.md speaks of; the search began with their like."""


class File:
    """The results so far."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.content: dict[str, Any] = (
            json.loads(path.read_text("utf-8")) if path.is_file() else {"kinds": {}}
        )

    def written(self) -> None:
        """Write it."""
        write_json(self.content, self.path)


def search_kind(kind: Kind, points: int, file: File) -> None:
    """Search one kind, and write every trial."""
    entry: dict[str, Any] = {"done": False, "trials": []}
    file.content["kinds"][kind.name] = entry

    def tell(trial: Trial) -> None:
        entry["trials"].append(trial.to_dict())
        file.written()
        print(kind.name, trial.how, trial.indent, trial.changes, flush=True)

    base = load_design("prototype_2")
    study = searched(base, survey, points, (kind,), tell=tell)
    entry |= {**study.to_dict(), "verified": []}
    best = [trial for trial in study.front if trial.indent is not None and trial.how != "step"]
    for trial in [*(each.trial for each in study.found), *best]:
        entry["verified"].append(verified(trial.indent).to_dict())
        file.written()
    entry["done"] = True
    file.written()


def verify_chosen(file: File) -> None:
    """Prototype 2 without an indent, and with those of ``CHOSEN``; what is there is kept."""
    known = file.content.setdefault("chosen", [])
    file.content.setdefault("plain", verified(None).to_dict())
    for indent in CHOSEN[len(known) :]:
        known.append(verified(indent).to_dict())
        file.written()
        print(line(trial_of(known[-1])), flush=True)


def print_tables(content: dict[str, Any]) -> None:
    """What was found for each kind, and the front of all that were verified."""
    print("| aim | indent, mm | angle | stress | printable |\n" + "|---" * 5 + "|")
    for entry in content["kinds"].values():
        for found, checked in zip(entry["found"], entry["verified"], strict=False):
            print(f"| {found['aim']} {line(trial_of(checked))} {found['printable']} |")
    print("\n| front | angle | stress |\n" + "|---" * 3 + "|")
    for trial in front([trial_of(content["plain"]), *all_verified(content)]):
        print(line(trial))


def line(trial: Trial) -> str:
    """The cells of one trial."""
    changes, error = trial.changes, trial.error_estimate
    return (
        f"| {trial.label} | {changes.bending_angle_percent:+.1f} % "
        f"(± {error.bending_angle_percent:.1f}) | {changes.max_von_mises_percent:+.1f} % "
        f"(± {error.max_von_mises_percent:.1f}) |"
    )


def all_verified(content: dict[str, Any]) -> list[Trial]:
    """Every verified trial of a file."""
    entries = content["kinds"].values()
    found = [trial_of(each) for entry in entries for each in entry.get("verified", ())]
    return [*found, *map(trial_of, content["chosen"])]


def trial_of(row: dict[str, Any]) -> Trial:
    """A trial from its row."""
    indent = None if row["indent"] is None else Indent.model_validate(row["indent"])
    return Trial(
        indent,
        row["how"],
        row["bending_angle_deg"],
        row["max_von_mises_mpa"],
        ErrorEstimate(**row["error_estimate"]),
        Changes(**row["changes"]),
    )


def draw(content: dict[str, Any], path: Path) -> None:
    """All trials, and the verified ones with their front."""
    rows = [row for entry in content["kinds"].values() for row in entry["trials"]]
    trials, base = tuple(map(trial_of, rows)), load_design("prototype_2")
    study = IndentStudy(base, trial_of(content["plain"]), trials, ())
    plot_indents(study, path, all_verified(content))


def main(target: str = "tests/benchmarks/indent_search.json", points: str = "12") -> None:
    """Search what is not searched yet, and print."""
    file = File(Path(target))
    verify_chosen(file)
    for kind in KINDS:
        if not file.content["kinds"].get(kind.name, {}).get("done"):
            search_kind(kind, int(points), file)
    print_tables(file.content)
    draw(file.content, Path("docs/indent.png"))


if __name__ == "__main__":
    main(*sys.argv[1:3])
