"""Links of pages that are read on the forge and in the site alike."""

from __future__ import annotations

import os
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
SITE = ROOT / "docs"

README = ROOT / "README.md"
COPIES = {
    ROOT / "CHANGELOG.md": SITE / "generated/changelog.md",
    ROOT / "CONTRIBUTING.md": SITE / "generated/contributing.md",
}
"""Pages outside of the documentation's folder, and where the site has them."""

LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^()\s]+)\)")
BLOCK = re.compile(r"^(```+|~~~+).*?^\1", re.MULTILINE | re.DOTALL)
PATTERN = re.compile(r"^(\[\w\]\S*)\n", re.MULTILINE)
MERMAID = re.compile(r"^```mermaid$", re.MULTILINE)


def within_the_site(text: str, folder: Path, page_folder: Path) -> str:
    """``text`` of a page in ``folder`` as a page of the site in ``page_folder``.

    A link to a file of the source code downloads it; one to a folder, or to a page that the site
    does not have, is text. Diagrams in
    Mermaid's notation, which only a script from elsewhere could draw, are shown as written.
    """
    pieces, at = [], 0
    for block in BLOCK.finditer(text):
        pieces += [_linked(text[at : block.start()], folder, page_folder)]
        pieces += [MERMAID.sub("```text", block[0])]
        at = block.end()
    return "".join([*pieces, _linked(text[at:], folder, page_folder)])


def with_pages_that_are_there(text: str, folder: Path) -> str:
    """``text`` without the patterns in its trees, such as ``[s]tudio``, that no page matches."""

    def kept(entry: re.Match[str]) -> str:
        return entry[0] if any(folder.glob(f"{entry[1]}.md")) else ""

    return PATTERN.sub(kept, text)


def _linked(text: str, folder: Path, page_folder: Path) -> str:
    return LINK.sub(lambda link: _link(link[1], link[2], folder, page_folder), text)


def _link(label: str, target: str, folder: Path, page_folder: Path) -> str:
    """A link in Markdown to the same page or file, or the label alone."""
    path, hash_sign, anchor = target.partition("#")
    if "://" in target or target.startswith(("mailto:", "/")) or not path:
        return f"[{label}]({target})"
    found = (folder / path).resolve()
    if found.is_dir() or _is_page_elsewhere(found):
        return label
    if found == README:  # in its place the site has a page with other headings
        return f"[{label}]({os.path.relpath(SITE / 'index.md', page_folder)})"
    place = COPIES.get(found, found)
    return f"[{label}]({os.path.relpath(place, page_folder)}{hash_sign}{anchor})"


def _is_page_elsewhere(found: Path) -> bool:
    """Whether this is a page that only the forge shows."""
    known = {README, *COPIES}
    return found.suffix == ".md" and found not in known and not found.is_relative_to(SITE)
