"""Which command was typed, for whatever answers it."""

from __future__ import annotations

from contextvars import ContextVar

_asked: ContextVar[str] = ContextVar("asked", default="")


def command_asked() -> str:
    """The command that was typed, such as ``study sweep``; empty where there is none."""
    return _asked.get()


def remember(command: str) -> None:
    """From now on ``command`` is the one that was typed."""
    _asked.set(command)
