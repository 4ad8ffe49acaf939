"""The error whose sentences are meant for users, and how they quote values. Imports nothing."""

from __future__ import annotations

from collections.abc import Iterable

LONGEST_QUOTE = 200
"""Characters."""


class PrintersError(ValueError):
    """A profile or a part that cannot be checked: one sentence on what is wrong with it.

    Examples:
        >>> from printers import PrintersError, load_profile
        >>> try:
        ...     load_profile("prusa_i4")
        ... except PrintersError as error:
        ...     print(str(error).split(";")[0])
        there is no printer profile 'prusa_i4'
    """


def quoted(value: object) -> str:
    """``value`` as it may stand in a sentence: on one line and not too long."""
    try:
        return shortened(repr(value))
    except (ValueError, RecursionError):  # 4300 digits, 1000 levels
        return "a huge number" if isinstance(value, int) else "too much to show"


def near(unknown: str, known: Iterable[str]) -> str:
    """`; did you mean a?` for the known word that looks most like `unknown`; empty if none does."""
    import difflib

    found = difflib.get_close_matches(unknown[:LONGEST_QUOTE], list(known), n=1, cutoff=0.6)
    return f"; did you mean {found[0]}?" if found else ""


def shortened(text: str) -> str:
    """``text``, cut after ``LONGEST_QUOTE`` characters."""
    return text if len(text) <= LONGEST_QUOTE else text[: LONGEST_QUOTE - 1] + "…"
