"""What is found about one thing, and all of it together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

Verdict = Literal["ok", "warn", "fail"]


@dataclass(frozen=True)
class Finding:
    """One line of the examination.

    Attributes:
        group: What it belongs to, such as ``libraries``.
        name: Of the thing.
        verdict: ``ok``; ``warn``: something works less well, or not at all, but not everything;
            ``fail``: nothing can be computed or written without it.
        said: What was found.
        mend: How to mend it; empty where nothing is to be mended.
    """

    group: str
    name: str
    verdict: Verdict
    said: str
    mend: str = ""


@dataclass(frozen=True)
class Examination:
    """All findings, and the seconds that they took."""

    findings: Sequence[Finding]
    seconds: float

    @property
    def healthy(self) -> bool:
        """Whether everything that is needed is there."""
        return all(each.verdict != "fail" for each in self.findings)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        counts = {
            verdict: sum(each.verdict == verdict for each in self.findings)
            for verdict in ("ok", "warn", "fail")
        }
        return {
            "healthy": self.healthy,
            "counts": counts,
            "findings": [asdict(each) for each in self.findings],
            "seconds": self.seconds,
        }
