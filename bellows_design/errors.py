"""Errors whose sentences are meant for users. Imports nothing."""

from __future__ import annotations


class BellowsError(ValueError):
    """Base of the errors of this package whose sentences are meant for users.

    Examples:
        >>> from bellows_design import BellowsError, load_design
        >>> try:
        ...     load_design("fingr")
        ... except BellowsError as error:
        ...     print(error)
        unknown design “fingr”; did you mean finger?
    """


class DesignError(BellowsError):
    """A design, material, table of measurements or option that cannot be used.

    Attributes:
        sentences: One sentence for each problem; the message has one of them on each line.

    Examples:
        >>> from bellows_design import DesignError, load_design, with_overrides
        >>> try:
        ...     with_overrides(load_design("finger"), ["bubble_thickness=12", "bubble_width=2"])
        ... except DesignError as error:
        ...     print(*error.sentences, sep="\\n")
        bellows.bubble_width is 2 mm but must be at least 4 mm; ...
        bellows.bubble_thickness is 12 mm but must be at most 10 mm.
    """

    def __init__(self, *sentences: str) -> None:
        super().__init__("\n".join(sentences))
        self.sentences = sentences


class UnreachedError(BellowsError):
    """A load that the solver did not reach, and without which there is no result."""


class ClusterError(BellowsError):
    """Workers or their scheduler cannot be reached, or are gone; what they finished is kept."""
