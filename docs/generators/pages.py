"""All pages that are generated, written where the site finds them."""

from __future__ import annotations

from pathlib import Path

from generators import commands, fields, gallery, names, schemas
from generators.links import COPIES, ROOT, within_the_site


def write_pages(folder: Path) -> None:
    """Write the generated pages into ``folder``; those that are as before stay untouched."""
    folder.mkdir(exist_ok=True)
    written = {name: _written(folder / name, text) for name, text in generated(folder).items()}
    for stale in set(folder.iterdir()) - {folder / name for name in written}:
        stale.unlink()


def generated(folder: Path) -> dict[str, str]:
    """File name -> text of every generated page."""
    pages = {"commands.md": commands.page(), "gallery.md": gallery.page()}
    pages["schemas.md"] = schemas.page()
    pages |= {f"{name}.md": text for name, text in fields.pages()}
    pages |= {f"{name}.rst": text for name, text in names.pages()}
    return pages | _copied(folder)


def _copied(folder: Path) -> dict[str, str]:
    """Pages that stand at the top of the repository."""
    return {
        copy.name: within_the_site(page.read_text("utf-8"), ROOT, folder)
        for page, copy in COPIES.items()
    }


def _written(path: Path, text: str) -> None:
    if not path.exists() or path.read_text("utf-8") != text:
        path.write_text(text, "utf-8")
