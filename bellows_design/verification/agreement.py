"""How far an export and what this version makes agree, where programs are others than then.

Nothing is forgiven because a program differs: only what depends on that program may differ, and it
is then not compared rather than right. Figures must agree all the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any, Literal

from bellows_design.export.companions import LEAK_TEST, is_settings
from bellows_design.print_sheet.names import is_sheet
from bellows_design.validation.quoting import quoted
from bellows_design.verification.record import Difference

FIGURES_APART = 0.05
"""Relative: by so much may figures of other versions differ. Our choice, somewhat above the 2 to
4 % to which meshes are refined."""

NOISE = 1e-6
"""Relative: what another library's rounding may move; between threads it moves 3e-13."""

FIGURES = tuple(
    f"evaluation.{name}"
    for name in ("pressure_mpa", "bending_angle_deg", "max_von_mises_mpa", "cavity_volume_mm3")
)
"""Fields of the manifest that are figures of the part."""

COMPUTED = ("evaluation.", "scenes", "check.rules", "verdict.warnings", "leak_test.")
"""Fields whose words and small numbers follow from the libraries."""

SLICED = ("leak_test.", "verdict.warnings", "verdict.not_judged")
"""Fields that follow from the slicer, or from that there is none."""

CLAIM = "verdict.approved"
"""An export is of an approved design, whatever made it."""

TOLD = "evaluation.versions"
"""Fields that are told as versions."""

OWN = "bellows-design"

_NUMBER = re.compile(r"(?<!\w)\d+(?:\.\d+)?(?!\w)")
_ERROR = re.compile(r"± ?[\d.]+")

Judgement = Literal["agrees", "is another", "not compared"]


@dataclass(frozen=True)
class Others:
    """Which kinds of programs are others than those of the export.

    Attributes:
        own: This program.
        slicer: The slicer, or there is none here or was none there.
        libraries: Any library, Python, or the processor.
    """

    own: bool = False
    slicer: bool = False
    libraries: bool = False

    @property
    def any(self) -> bool:
        """Whether anything is."""
        return self.own or self.slicer or self.libraries


def others(versions: Iterable[Difference]) -> Others:
    """The kinds of the programs that differ."""
    names = {each.name for each in versions}
    return Others(OWN in names, "slicer" in names, bool(names - {OWN, "slicer"}))


def field_judgement(field: Difference, others: Others) -> Judgement:
    """Whether a field of the manifest that is filled otherwise is a fault."""
    apart = _apart(field.then, field.now)
    if field.name == CLAIM:
        return "is another"
    if field.name.startswith(TOLD) and others.any:
        return "agrees"
    if field.name in FIGURES and others.any:
        return "agrees" if apart <= FIGURES_APART else "is another"
    if others.libraries and apart <= NOISE:
        return "agrees"
    excused = (
        others.own
        or (others.slicer and field.name.startswith(SLICED))
        or (others.libraries and field.name.startswith(COMPUTED))
    )
    return "not compared" if excused else "is another"


def text_judgement(name: str, then: bytes, now: bytes, others: Others) -> tuple[Judgement, str]:
    """Whether a text with other bytes is a fault, and in what it differs."""
    if is_settings(name):
        return ("not compared" if others.own else "is another"), "its settings are others"
    if name == LEAK_TEST:
        return ("not compared" if others.any else "is another"), "its result is another"
    if is_sheet(name):
        return _sheet_judgement(then, now, others)
    return "is another", "it is another file"


def _sheet_judgement(then: bytes, now: bytes, others: Others) -> tuple[Judgement, str]:
    """Words and figures of a sheet; what the leak test says only with the same slicer."""
    lines = [_lines(each, without_leak_test=others.slicer) for each in (then, now)]
    pairs = [pair for pair in zip_longest(*lines, fillvalue="") if pair[0] != pair[1]]
    for pair in pairs:
        same_words = _words(pair[0]) == _words(pair[1])
        excused = others.own or others.libraries
        if not (excused and _near(*pair) if same_words else others.own):
            return "is another", f"it says {_where(*pair)}"
    if others.own or others.slicer:
        return "not compared", "its words, as far as other programs choose them"
    return "agrees", ""


def _lines(content: bytes, without_leak_test: bool) -> list[str]:
    text = content.decode("utf-8", "replace").splitlines()
    return [line for line in text if not (without_leak_test and _of_the_test(line))]


def _of_the_test(line: str) -> bool:
    """Whether a line follows from the leak test on G-code, which a slicer must be there for."""
    return bool(re.match(r"(<p>)?(Leak test on|Warning: The leak test)", line)) or not line.strip()


def _words(line: str) -> str:
    return _NUMBER.sub("#", _ERROR.sub("±", line))


def _near(then: str, now: str) -> bool:
    """Whether the figures of two lines of equal words agree; estimated errors are no figures."""
    numbers = [map(float, _NUMBER.findall(_ERROR.sub("±", line))) for line in (then, now)]
    return all(_apart(*pair) <= FIGURES_APART for pair in zip(*numbers, strict=True))


def _where(then: str, now: str) -> str:
    """The place where two lines part."""
    start = next((i for i, pair in enumerate(zip_longest(then, now)) if pair[0] != pair[1]), 0)
    start = max(0, start - 20)
    return f"{quoted(then[start : start + 50])} instead of {quoted(now[start : start + 50])}"


def _apart(then: Any, now: Any) -> float:
    """Relative difference of two numbers; infinite for anything else that differs."""
    if then == now and type(then) is type(now):
        return 0.0
    plain = all(
        isinstance(each, int | float) and not isinstance(each, bool) for each in (then, now)
    )
    if not plain:
        return float("inf")
    return abs(then - now) / max(abs(then), abs(now), 1e-300)


def differing(fields: Iterable[Difference], others: Others) -> Mapping[Judgement, list[Difference]]:
    """The fields by what is to be thought of them."""
    found: dict[Judgement, list[Difference]] = {"agrees": [], "is another": [], "not compared": []}
    for field in fields:
        found[field_judgement(field, others)].append(field)
    return found
