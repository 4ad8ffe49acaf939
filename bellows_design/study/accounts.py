"""Rows of the paper that our results do not agree with, and why; at length in docs/paper.md."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

ACCOUNTS: Mapping[str, str] = MappingProxyType({})
"""Label of a result -> one sentence."""
