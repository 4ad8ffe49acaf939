"""Run all hard cases and write docs/hard-cases.md.

python tests/hard_cases/document.py [words of names of cases to run and print instead ...]
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from hard_case import Finding, HardCase, row
from hard_catalogue import DOCUMENT, all_cases, families

INTRODUCTION = """# Hard cases

What breaks finite element solvers of soft bodies, and what this one does. Written by
`python tests/hard_cases/document.py`; the tests in `tests/hard_cases` run the same cases and fail
when one does not behave as said here, or prints something else. Bounds are rounded up to 1, 2 or 5
times a power of ten. Units: mm, N, MPa.
"""

HEADING = "| case | what could go wrong | what we do | measured |\n|---|---|---|---|"


def run(case: HardCase) -> tuple[Finding, ...]:
    """Run a case unless it is open; report seconds and what is wrong on the terminal."""
    start, findings = time.process_time(), () if case.missing else case.run()
    print(f"{case.name}: {time.process_time() - start:.1f} s of processor time", flush=True)
    for finding in findings:
        if not finding.good:
            print(f"  NOT GOOD: {finding.text} (found {finding.detail})", flush=True)
    return findings


def document() -> str:
    """The whole document."""
    text = INTRODUCTION
    for title, cases in families().items():
        rows = "\n".join(row(case, run(case)) for case in cases)
        text += f"\n## {title}\n\n{HEADING}\n{rows}\n"
    return text


def main(words: list[str]) -> None:
    """Write the document, or print the rows of the cases whose names have one of the words."""
    if not words:
        DOCUMENT.write_text(document(), encoding="utf-8")
        return
    for case in all_cases():
        if any(word in case.name for word in words):
            findings = case.run()
            print(row(case, findings))
            print(*(f"    {f.good} {f.text}: {f.detail}" for f in findings), sep="\n", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
