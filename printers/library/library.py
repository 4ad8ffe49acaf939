"""A library of TOML files: those shipped, those of other packages, and a user's own.

Other packages add theirs as data files through an entry-point group, whose values name packages
that hold `*.toml` files.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from printers.errors import PrintersError, near, quoted


@dataclass(frozen=True)
class Library:
    """Where files of one kind are found.

    Attributes:
        noun: What one of them is called in sentences.
        folder: Of this package that holds those shipped.
        entry_points: Group under which other packages announce theirs.
        links: Keys of such a file that may name another file.
    """

    noun: str
    folder: str
    entry_points: str
    links: tuple[str, ...] = ()

    def names(self) -> tuple[str, ...]:
        """Names of the shipped files and of those that other installed packages bring, sorted.

        Raises PrintersError if an installed package announces files but cannot be imported.
        """
        return tuple(sorted({*self._shipped(), *self._third_party()}))

    def find(self, name_or_path: str | Path, folder: Path | None = None) -> Traversable:
        """The file of that name, or at that path if it ends in `.toml`, counted from the `folder`.

        Shipped files cannot be replaced by another package's of the same name. Raises PrintersError
        if there is none of the name; whether a path leads to a file is seen when it is read.
        """
        if is_path(name_or_path):
            return Path(name_or_path) if folder is None else folder / name_or_path
        name = str(name_or_path)
        shipped = self._shipped()
        if name in shipped:
            return shipped[name]
        known = {**self._third_party(), **shipped}
        if name not in known:
            hint = near(name, known) or f"; known: {', '.join(sorted(known))}"
            raise PrintersError(f"there is no {self.noun} {quoted(name)}{hint}")
        return known[name]

    def _shipped(self) -> dict[str, Traversable]:
        return _toml_files(files("printers") / self.folder)

    def _third_party(self) -> dict[str, Traversable]:
        found: dict[str, Traversable] = {}
        for entry_point in entry_points(group=self.entry_points):
            found.update(_toml_files(_folder_of(entry_point)))
        return found


def is_path(name_or_path: str | Path) -> bool:
    """Whether a file is meant, not a name."""
    return isinstance(name_or_path, Path) or name_or_path.endswith(".toml")


def _folder_of(entry_point: EntryPoint) -> Traversable:
    try:
        return files(entry_point.value)
    except Exception as error:  # importing another's package may raise anything
        raise PrintersError(
            f"entry point {entry_point.name!r} of {entry_point.group} names "
            f"{entry_point.value!r}, which is no importable package: {quoted(str(error))}"
        ) from None


def _toml_files(folder: Traversable) -> dict[str, Traversable]:
    return {
        entry.name.removesuffix(".toml"): entry
        for entry in folder.iterdir()
        if entry.name.endswith(".toml")
    }
