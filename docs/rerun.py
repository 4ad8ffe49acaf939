"""Run the commands of a page again and write what they print below them.

    python docs/rerun.py docs/tutorial.md

A block of commands (``sh``) with a comment ``<!-- output -->`` behind it is followed by a block of
text: what the commands print on stdout, or the last lines of it where the comment says
``<!-- output: last 12 -->``. All commands of a page run one after the other in one new folder.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

SHOWN = re.compile(
    r"^```sh\n(?P<commands>(?:(?!```).*\n)*)```\n\s*"
    r"(?P<comment><!-- output(?:: last (?P<last>\d+))? -->)\n"
    r"```text\n(?P<text>(?:(?!```).*\n)*)```$",
    re.MULTILINE,
)
WIDTH = 80
"""Columns of the terminal that the output is for."""


def rerun(page: str) -> str:
    """``page`` (Markdown) with the outputs of its commands as they are now."""
    with TemporaryDirectory(prefix="bellows-page-") as folder:
        return SHOWN.sub(lambda block: _shown(block, Path(folder)), page)


def _shown(block: re.Match[str], folder: Path) -> str:
    printed = "".join(_printed(line, folder) for line in _lines(block["commands"]))
    lines = [line.rstrip() for line in printed.strip("\n").splitlines()]
    kept = lines[-int(block["last"]) :] if block["last"] else lines
    head = f"```sh\n{block['commands']}```\n\n{block['comment']}\n```text\n"
    return head + "\n".join(kept) + "\n```"


def _lines(commands: str) -> list[str]:
    """Commands on one line each, without comments."""
    joined = commands.replace("\\\n", " ").splitlines()
    return [line.partition(" #")[0] for line in joined if line.strip()]


def _printed(line: str, folder: Path) -> str:
    """What a command of ours prints on stdout; it is done, or a refusal."""
    program, *arguments = shlex.split(line)
    if Path(program).name != "bellows":
        raise SystemExit(f"{line!r} is no command of this program.")
    surroundings = {"COLUMNS": str(WIDTH), "NO_COLOR": "1", "BELLOWS_CACHE": str(folder / "cache")}
    done = subprocess.run(
        [sys.executable, "-m", "bellows_design", *arguments],
        cwd=folder,
        env=os.environ | surroundings,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode not in (0, 1):
        raise SystemExit(f"{line}\n{done.stderr}")
    return done.stdout.replace(f"{folder}/", "")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name)
        path.write_text(rerun(path.read_text("utf-8")), "utf-8")
