"""An input file as blocks: a keyword with its parameters, and the lines of data below it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from solver.errors import SolverError

WITH_DATA_ELSEWHERE = ("NODE", "ELEMENT")
"""Keywords whose ``INPUT=`` names a file of lines of data."""

DEEPEST = 8
"""Files within files: more is a file that includes itself."""


@dataclass(frozen=True)
class Line:
    """Fields of a line of data, without blanks around them; ``place`` for messages."""

    place: str
    fields: list[str]


@dataclass
class Block:
    """A keyword in capitals, its parameters (names in capitals), and its lines of data."""

    keyword: str
    parameters: dict[str, str]
    place: str
    lines: list[Line] = field(default_factory=list)

    def parameter(self, name: str) -> str:
        """A parameter's value. Raises ``SolverError`` without it."""
        if not self.parameters.get(name):
            raise SolverError(f"{self.place}: *{self.keyword} lacks {name}=.")
        return self.parameters[name]


def blocks(path: Path, depth: int = 0) -> list[Block]:
    """The blocks of a file, and of those that it includes. Raises ``SolverError``, ``OSError``."""
    found: list[Block] = []
    text = path.read_text("utf-8-sig", errors="replace")
    for number, line in enumerate(_joined(text.splitlines()), start=1):
        content, place = line.strip(), f"line {number}" if not depth else f"{path.name}, {number}"
        if not content or content.startswith("**"):
            continue
        if not content.startswith("*"):
            _add_data(found, content, place)
            continue
        block = _block(content, place)
        found.append(block)
        if block.keyword == "INCLUDE":
            found += blocks(_other(path, block, depth), depth + 1)
        elif block.keyword in WITH_DATA_ELSEWHERE and "INPUT" in block.parameters:
            _add_file_of_data(found, _other(path, block, depth))
    return found


def _joined(lines: list[str]) -> Iterator[str]:
    """Lines; that of a keyword which ends in a comma with the next, an empty one in its place."""
    waiting = ""
    for line in lines:
        bare = line.strip()
        if waiting:
            bare = waiting + bare
        waiting = bare if bare.startswith("*") and bare[1:2] != "*" and bare.endswith(",") else ""
        yield "" if waiting else (bare if bare.startswith("*") else line)


def _block(content: str, place: str) -> Block:
    keyword, *parts = (part.strip() for part in content[1:].split(","))
    pairs = (part.partition("=") for part in parts if part)
    parameters = {
        name.strip().upper().replace(" ", ""): value.strip().strip('"') for name, _, value in pairs
    }
    return Block(" ".join(keyword.upper().split()), parameters, place)


def _add_data(found: list[Block], content: str, place: str) -> None:
    if not found:
        raise SolverError(f"{place}: data stand before the first keyword, as in no input file.")
    fields = [each.strip().strip('"') for each in content.split(",")]
    found[-1].lines.append(Line(place, fields))


def _add_file_of_data(found: list[Block], path: Path) -> None:
    text = path.read_text("utf-8-sig", errors="replace")
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.strip()
        if content.startswith("*") and not content.startswith("**"):
            raise SolverError(f"{path.name}, {number}: a keyword among lines of data.")
        if content and not content.startswith("**"):
            _add_data(found, content, f"{path.name}, {number}")


def _other(path: Path, block: Block, depth: int) -> Path:
    """The file that a block names, beside ``path``."""
    other = path.parent / block.parameter("INPUT")
    if depth >= DEEPEST:
        raise SolverError(f"{block.place}: more than {DEEPEST} files within each other.")
    if not other.is_file():
        raise SolverError(f"{block.place}: there is no file {str(other)!r} to include.")
    return other
