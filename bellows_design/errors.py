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


class CannotWrite(OSError):
    """A file or folder could not be written; what was begun is gone, what was there before is not.

    Attributes:
        place: The file or folder, as the user named it.
    """

    def __init__(self, place: object, reason: object) -> None:
        number = getattr(reason, "errno", None)
        words = getattr(reason, "strerror", None) or str(reason)
        super().__init__(number, words, str(place))
        self.place = str(place)

    def __str__(self) -> str:
        from bellows_design.validation.quoting import quoted_path

        return f"{quoted_path(self.place)} cannot be written: {self.strerror}"
