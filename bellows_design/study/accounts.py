"""Designs of the paper that our results do not agree with, and why; at length in docs/paper.md."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

ACCOUNTS: Mapping[str, str] = MappingProxyType(
    {
        "bubble height 16": (
            "the angle; no reading of the parameters as printed gives the paper's, a tendon 6 mm "
            "high would give both its numbers."
        ),
        "bubble thickness 1.2": (
            "the sign of the change in stress. Where the floors of chamber and channel stay level, "
            "as in Prototype 1, the stress rises as in the paper."
        ),
        "bubble distance 1": (
            "the angle; 7.5 bubbles fit. We take eight; the paper's angle is the mean of seven "
            "and eight."
        ),
    }
)
"""Label of a result -> what differs, and the reason as far as it is known."""
