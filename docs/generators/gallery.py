"""The examples: what each does, its picture where there is one, and its source."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PICTURES = {"gripper.py": "gripper.png", "pneunet.py": "pneunet.png"}
"""Examples whose result is drawn on a page."""

HEADER = """\
# Gallery of examples

Programs to start from. Each is run by the tests; none is run at the build of this page.
"""


def page() -> str:
    """All programs of the folder of examples, in the order of their names."""
    programs = sorted((ROOT / "examples").glob("*.py"))
    return "\n".join([HEADER, *(_section(program) for program in programs)])


def _section(program: Path) -> str:
    source = program.read_text("utf-8")
    title, _, about = (ast.get_docstring(ast.parse(source)) or program.stem).partition("\n")
    picture = PICTURES.get(program.name)
    return "\n".join(
        [
            f"## {re.sub(r'[.:]$', '', title)}\n",
            f"![{title}](../{picture})\n" if picture else "",
            f"{_indented_as_blocks(about)}\n",
            f"[`{program.name}`](../../examples/{program.name})\n",
            f":::{{dropdown}} Source\n\n```python\n{source}```\n:::\n",
        ]
    )


def _indented_as_blocks(text: str) -> str:
    """Code of docstrings, which is indented, as fenced blocks."""
    return re.sub(
        r"(?:^    .*\n?)+",
        lambda code: f"```sh\n{re.sub(r'^    ', '', code[0], flags=re.MULTILINE).rstrip()}\n```\n",
        re.sub(r"``", "`", text.strip("\n")),
        flags=re.MULTILINE,
    )
