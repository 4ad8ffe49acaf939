"""The examination as an answer: a table by groups, and how to mend what is not well."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bellows_design.cli.answer import DONE, REFUSED, Answer
from bellows_design.cli.doctor.finding import Examination, Finding

if TYPE_CHECKING:
    from rich.console import RenderableType

_STYLES = {"ok": "green", "warn": "yellow", "fail": "bold red"}


def doctor() -> Answer:
    """Examine; exit status 1 if something that is needed is missing or broken."""
    from bellows_design.cli.doctor.examine import examine

    found = examine()
    return Answer(found.to_dict(), _text(found), DONE if found.healthy else REFUSED)


def _text(found: Examination) -> list[RenderableType]:
    from rich.text import Text

    groups = dict.fromkeys(each.group for each in found.findings)
    tables = [
        _table(group, [each for each in found.findings if each.group == group]) for group in groups
    ]
    verdict = "everything that is needed is there" if found.healthy else "something is missing"
    warned = sum(each.verdict == "warn" for each in found.findings)
    more = f"; {warned} warning{'s' * (warned != 1)}" if warned else ""
    style = "bold green" if found.healthy else "bold red"
    return [*tables, Text(f"{verdict}{more}", style=style)]


def _table(group: str, findings: list[Finding]) -> RenderableType:
    from rich.box import SIMPLE
    from rich.table import Table
    from rich.text import Text

    table = Table(title=group, title_justify="left", box=SIMPLE, show_header=False)
    table.add_column(no_wrap=True)
    table.add_column(no_wrap=True)
    table.add_column()
    for each in findings:
        said = Text(each.said)
        if each.mend:
            said.append(f"\n→ {each.mend}", style=_STYLES[each.verdict])
        table.add_row(Text(each.verdict, style=_STYLES[each.verdict]), Text(each.name), said)
    return table
