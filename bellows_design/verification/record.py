"""What a verification found."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from bellows_design.approval import Verdict

State = Literal["as written", "changed", "missing", "not listed", "no file"]


@dataclass(frozen=True)
class FileCheck:
    """A file of the folder, or one that should be there; ``why`` is empty if it is as written."""

    name: str
    state: State
    why: str = ""


@dataclass(frozen=True)
class Rebuilt:
    """A file beside what this version makes of the design in the manifest.

    Attributes:
        name: Of the file.
        same_bytes: Whether this version writes the same bytes.
        difference: What is wrong with the file; empty if nothing is known to be.
        not_compared: What could not be compared, as other programs decide it; empty if all could.
    """

    name: str
    same_bytes: bool
    difference: str = ""
    not_compared: str = ""


@dataclass(frozen=True)
class Difference:
    """A version, or a field of the manifest, then and now; None where there was or is none.

    Name and values come from a file of anyone: they are text that a terminal may be given.
    """

    name: str
    then: Any
    now: Any


@dataclass(frozen=True)
class Verification:
    """All that was found out about an export.

    Attributes:
        folder: Of the export.
        design: Name of the design; empty if the manifest cannot be read.
        digest: Of the design, as the manifest states it.
        files: Every file that is listed or there.
        rebuilt: The files beside what this version makes of the design.
        versions: Programs that differ from those of the export, the processor among them.
        fields: Fields of the manifest that this version fills otherwise; of a quick verification
            those that need no evaluation.
        verdict: This version's on the design; None if it could not be found. A quick one is that of
            printability alone.
        quick: Evaluation and leak test were left out.
        failure: Why the design could not be rebuilt; empty if it could.
    """

    folder: Path
    design: str
    digest: str
    files: tuple[FileCheck, ...]
    rebuilt: tuple[Rebuilt, ...] = ()
    versions: tuple[Difference, ...] = ()
    fields: tuple[Difference, ...] = ()
    verdict: Verdict | None = None
    quick: bool = False
    failure: str = ""

    @property
    def same_bytes(self) -> bool:
        """This version writes the same files."""
        return bool(self.rebuilt) and all(file.same_bytes for file in self.rebuilt)

    @property
    def problems(self) -> tuple[str, ...]:
        """A sentence for each thing that is wrong; other versions alone are none."""
        return tuple(self._problems())

    @property
    def not_compared(self) -> tuple[str, ...]:
        """A sentence for each thing that may be right, and that other programs decide."""
        return tuple(
            f"{each.name}: {each.not_compared}" for each in self.rebuilt if each.not_compared
        )

    @property
    def verified(self) -> bool:
        """All was compared that this verification looks at, and nothing is wrong."""
        return not self.problems and not self.not_compared

    def _problems(self) -> Iterator[str]:
        for file in self.files:
            if file.state != "as written":
                yield f"{file.name}: {file.state}{f', {file.why}' if file.why else ''}"
        if self.failure:
            yield f"the design cannot be rebuilt: {self.failure}"
        for each in self.rebuilt:
            if each.difference:
                yield f"{each.name}: {each.difference}"
        if self.verdict is not None and not self.verdict.approved:
            rules = ", ".join(dict.fromkeys(reason.rule for reason in self.verdict.reasons))
            yield f"this version would refuse the design: {rules}"

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "folder": str(self.folder),
            "design": self.design,
            "digest": self.digest,
            "verified": self.verified,
            "problems": list(self.problems),
            "not_compared": list(self.not_compared),
            "files": [asdict(file) for file in self.files],
            "rebuilt": [asdict(file) for file in self.rebuilt],
            "same_bytes": self.same_bytes,
            "versions": [asdict(each) for each in self.versions],
            "fields": [asdict(each) for each in self.fields],
            "quick": self.quick,
            "failure": self.failure or None,
            "verdict": None if self.verdict is None else self.verdict.to_dict(),
        }
