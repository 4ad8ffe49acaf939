"""The error whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class PrintersError(ValueError):
    """A profile or a part that cannot be checked: one sentence on what is wrong with it."""
