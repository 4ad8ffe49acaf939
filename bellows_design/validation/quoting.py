"""Words for messages: values as they may be shown, and the known words like an unknown one."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

_ESCAPE = re.compile(r"(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]")
"""A control sequence of ECMA-48."""

_FOLDERS = re.compile(r"(?<![\w/\\.~])(?:[A-Za-z]:|~|\.{1,2})?(?:[/\\][^\s/\\'\"“”:;,()]+)*[/\\]")
"""The folders of a path that begins at a root, at home, or where a program runs."""

_TEMPORARY = re.compile(r"\b(?:bellows-[\w-]*-|tmp)\w*\b")
"""Our temporary folders, and Python's."""

_LONGEST_SAID = 10_000
_LONGEST_QUOTE = 60
_MOST_NAMED = 13
_LONGEST_COMPARED = 200
_MOST_BESIDE = 1000
_AS_NEAR = 0.12
"""Similarity, of at most 1, by which a word may be farther than the nearest and still be named."""


def quoted(value: object) -> str:
    """``value`` as it may stand in a message: printable, on one line, at most 60 characters."""
    text = shown(value if isinstance(value, str) else _represented(value), _LONGEST_QUOTE)
    return f"“{text}”" if isinstance(value, str) else text


def shown(text: str, longest: int) -> str:
    """``text`` in printable characters, and no more of them than ``longest``."""
    text = "".join(sign if sign.isprintable() else "?" for sign in text[: longest + 1])
    return text if len(text) <= longest else text[: longest - 1] + "…"


def reproducible(text: str, longest: int = 300) -> str:
    """What another program said, as it may stand in a file that two runs write alike.

    Printable, on one line, without colours of a terminal, and of paths only the last name: folders
    differ from run to run and from machine to machine, temporary ones altogether.
    """
    plain = " ".join(_ESCAPE.sub("", text[:_LONGEST_SAID]).split())
    return shown(_TEMPORARY.sub("…", _FOLDERS.sub("", plain)), longest)


def quoted_path(path: str | Path) -> str:
    """The path as it may stand in a message: of a long one only the file's name."""
    whole = quoted(str(path))
    return quoted(Path(path).name) if "…" in whole else whole


def quoted_reason(error: Exception) -> str:
    """The message of ``error`` as part of a sentence: one line, no full stop."""
    return quoted(str(error).rstrip(".")).strip("“”")


def did_you_mean(unknown: str, known: Iterable[str]) -> str:
    """``; did you mean a or b?`` for the known words closest to ``unknown``, else the known ones.

    A dotted word is also compared by its last part: ``pressure`` finds ``load.pressure``.
    """
    words = list(known)
    unknown = unknown[:_LONGEST_COMPARED]
    last = unknown.rsplit(".", 1)[-1]
    by_part = {word.rsplit(".", 1)[-1]: word for word in reversed(words)}
    close = _nearest(unknown, words, 0.6)
    close += [by_part[part] for part in _nearest(last, by_part, 0.7)]
    if close:
        return f"; did you mean {' or '.join(dict.fromkeys(close))}?"
    more = f" and {len(words) - _MOST_NAMED} more" if len(words) > _MOST_NAMED else ""
    return f"; known are {', '.join(words[:_MOST_NAMED])}{more}."


def _nearest(unknown: str, words: Iterable[str], cutoff: float) -> list[str]:
    """At most three words of at least this similarity, all nearly as near as the nearest."""
    import difflib

    close = difflib.get_close_matches(unknown, words, n=3, cutoff=cutoff)
    likeness = [difflib.SequenceMatcher(None, word, unknown).ratio() for word in close]
    return [
        word for word, like in zip(close, likeness, strict=True) if like > likeness[0] - _AS_NEAR
    ]


def near(unknown: str, known: Iterable[str]) -> str:
    """``; did you mean a?`` for the known word closest to ``unknown``; empty if none is close."""
    words = list(known)
    swapped = [word for word in words if sorted(word) == sorted(unknown)]
    hint = did_you_mean(unknown, swapped or words)
    return hint.split(" or ")[0].rstrip("?") + "?" if hint.startswith("; did") else ""


def near_file(path: Path) -> str:
    """``; did you mean a?`` for the file or folder beside ``path`` whose name is closest to its.

    A suffix that both have makes no two names alike.
    """
    try:
        beside = [each for each in path.parent.iterdir() if not each.name.startswith(".")]
    except (OSError, ValueError):  # ValueError: a null byte in the path
        return ""
    others = [each for each in beside[:_MOST_BESIDE] if each.name != path.name]
    alike = {each.stem: each.name for each in others if each.suffix == path.suffix}
    rest = {each.name: each.name for each in others if each.suffix != path.suffix}
    name = _nearest_of(path.stem, alike) or _nearest_of(path.name, rest)
    return f"; did you mean {quoted_path(path.parent / name)}?" if name else ""


def _nearest_of(unknown: str, names: Mapping[str, str]) -> str | None:
    """What stands behind the key nearest to ``unknown``; None if none is close."""
    hint = near(unknown, names)
    return names.get(hint.removeprefix("; did you mean ").removesuffix("?"))


def _represented(value: object) -> str:
    if value is None or isinstance(value, bool):  # as they are written in files and options
        return str(value).lower()
    try:
        return repr(value)
    except (ValueError, RecursionError):  # 4300 digits, 1000 levels
        return "a huge number" if isinstance(value, int) else "too much to show"
