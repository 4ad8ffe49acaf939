"""Write docs/validation.md and its figures from the stored results.

python tests/validation/document.py
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from printed import document, report
from stored import DOCUMENT, all_cases, results_of


def main() -> None:
    """Document and figures."""
    DOCUMENT.write_text(document(), encoding="utf-8")
    for name, case in all_cases().items():
        if case.draw is not None:
            case.draw(results_of(name), str(DOCUMENT.parent / report(name).figure))


if __name__ == "__main__":
    main()
