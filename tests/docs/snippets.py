"""Blocks of code in the documents, with what a comment before them says of how they are tested.

``<!-- slow -->``: the block runs with the slow tests. ``<!-- not run: REASON -->``: it does not.
``<!-- with`` and lines of Python up to ``-->``: what readers of the page have at hand, run before.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCUMENTS = sorted([ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")])

BLOCK = re.compile(
    r"(?P<comments>(?:^<!--(?:(?!-->).)*-->\s*\n)*)^```(?P<kind>\w*)\n(?P<code>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
COMMENT = re.compile(r"<!--\s*(.*?)\s*-->", re.DOTALL)


@dataclass(frozen=True)
class Snippet:
    """A block of code: its page, its line there, what it is written in, and how it is tested."""

    page: str
    line: int
    kind: str
    code: str
    notes: tuple[str, ...]

    @property
    def name(self) -> str:
        """Where it stands."""
        return f"{self.page}:{self.line}"

    @property
    def slow(self) -> bool:
        """Whether it takes more than a few seconds."""
        return "slow" in self.notes

    @property
    def reason(self) -> str:
        """Why it is not run; empty if it is."""
        reasons = [note.partition(":")[2] for note in self.notes if note.startswith("not run")]
        return "".join(reasons).strip()

    @property
    def before(self) -> str:
        """Code that runs before it."""
        return "".join(note[5:] + "\n" for note in self.notes if note.startswith("with\n"))

    def commands(self) -> Iterator[list[str]]:
        """The words of each command of a shell block."""
        for line in self.code.replace("\\\n", " ").splitlines():
            for command in re.split(r"\s(?:&&|\|\||;)\s", line.partition(" #")[0]):
                words = shlex.split(command)
                while words and re.fullmatch(r"\w+=\S*", words[0]):
                    words = words[1:]
                if words:
                    yield words


def snippets(*kinds: str) -> list[Snippet]:
    """All blocks of these kinds in all documents, in their order."""
    return [found for page in DOCUMENTS for found in _of(page) if found.kind in kinds]


def _of(page: Path) -> Iterator[Snippet]:
    text = page.read_text("utf-8")
    for block in BLOCK.finditer(text):
        line = text.count("\n", 0, block.start("code"))
        notes = tuple(COMMENT.findall(block["comments"]))
        name = page.relative_to(ROOT).as_posix()
        yield Snippet(name, line, block["kind"], block["code"], notes)
