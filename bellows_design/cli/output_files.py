"""Files the user wants written: refused before anything is computed if they cannot be."""

from __future__ import annotations

import re
from pathlib import Path

from bellows_design.errors import DesignError
from bellows_design.validation.quoting import quoted


def require_file(path: Path | None, suffix: str) -> None:
    """Refuse a file that cannot be written or whose name does not end in ``suffix``.

    Raises ``DesignError``; nothing is refused where no file is wanted.
    """
    if path is None:
        return
    if path.suffix.lower() != suffix:
        hint = f"; did you mean {quoted(str(path.with_suffix(suffix)))}?" if path.name else "."
        raise DesignError(f"{quoted(str(path))} must end in {suffix}{hint}")
    require_folder(path)


def require_folder(path: Path) -> None:
    """Refuse a file that cannot be written, by trying it.

    Raises ``DesignError`` if its folder is missing or it is a folder, else ``CannotWrite``.
    """
    from bellows_design.files.atomic import require_writable

    if not path.parent.is_dir():
        raise DesignError(f"there is no folder {quoted(str(path.parent))} to write to.")
    if path.is_dir():
        raise DesignError(f"{quoted(str(path))} is a folder, not a file to write.")
    require_writable(path)


def require_plot(path: Path | None) -> None:
    """Refuse a picture that cannot be written, or not be drawn for want of matplotlib.

    Raises ``DesignError``; nothing is refused where no picture is wanted.
    """
    require_file(path, ".png")
    if path is not None:
        from bellows_design.reports.plots import require_matplotlib

        require_matplotlib()


def name_of(output: Path, otherwise: str) -> str:
    """What the content of a file is called: its name without signs that no name has."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", output.stem).strip("_-")[:64] or otherwise
