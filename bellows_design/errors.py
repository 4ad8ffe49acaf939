"""Errors whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class BellowsError(ValueError):
    """Base of the errors of this package whose sentences are meant for users."""


class DesignError(BellowsError):
    """A design, material, table of measurements or option that cannot be used.

    Attributes:
        sentences: One sentence for each problem; the message has one of them on each line.
    """

    def __init__(self, *sentences: str) -> None:
        super().__init__("\n".join(sentences))
        self.sentences = sentences


class UnreachedError(BellowsError):
    """A load that the solver did not reach, and without which there is no result."""


class ClusterError(BellowsError):
    """Workers or their scheduler cannot be reached, or are gone; what they finished is kept."""
