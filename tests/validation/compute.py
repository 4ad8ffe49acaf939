"""Run the computations of cases and store them, one by one, beside the cases' modules.

    python tests/validation/compute.py NAME [COMPUTATION ...]

NAME is that of a module ``case_NAME.py``. Without computations, runs those that are not stored
yet; with some, runs these anew. Then write the document: ``python tests/validation/document.py``.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from stored import all_cases, results_of, store, timed


def main(name: str, *wanted: str) -> None:
    """Compute and store."""
    case = all_cases()[name]
    todo = wanted or [key for key in case.computations if key not in results_of(name)]
    for key in todo:
        found = timed(case.computations[key])
        store(name, {**results_of(name), key: found})
        print(f"{name}, {key}: {found.seconds} s", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
