"""A verification as text for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from rich.console import RenderableType
from rich.text import Text

from bellows_design.validation.quoting import quoted_path

if TYPE_CHECKING:
    from bellows_design.verification.record import Difference, Verification


def verification_table(found: Verification) -> Sequence[RenderableType]:
    """Files, what differs, the verdict of this version, and all that is wrong."""
    return list(_lines(found))


def _lines(found: Verification) -> Iterator[RenderableType]:
    whole = sum(file.state == "as written" for file in found.files)
    yield f"{quoted_path(found.folder)}: {whole} of {len(found.files)} files are as written"
    if found.rebuilt:
        same = sum(file.same_bytes for file in found.rebuilt)
        yield f"rebuilt: {same} of {len(found.rebuilt)} files have the same bytes"
    yield from (Text(f"other version: {_difference(each)}") for each in found.versions)
    yield from (Text(f"other in the manifest: {_difference(each)}") for each in found.fields)
    yield from _verdict(found)
    yield from (Text(f"  - {problem}") for problem in found.problems)
    yield from (Text(f"  - not compared: {each}") for each in found.not_compared)
    if found.problems:
        yield Text("NOT VERIFIED", style="bold red")
    elif found.not_compared:
        yield Text("NOT COMPARED: nothing is known to be wrong", style="bold yellow")
    else:
        yield Text("VERIFIED", style="bold green")


def _verdict(found: Verification) -> Iterator[str]:
    if found.verdict is None:
        return
    if found.quick:
        judged = "pass" if found.verdict.approved else "fail"
        yield f"printability: {judged}; evaluation and leak test were left out (--quick)"
        return
    again = "would approve it again" if found.verdict.approved else "would refuse it"
    yield f"this version {again}"


def _difference(each: Difference) -> str:
    """Then and now."""
    return f"{each.name}, {_or_none(each.then)} there, {_or_none(each.now)} here"


def _or_none(value: object) -> str:
    return "none" if value is None else str(value)
