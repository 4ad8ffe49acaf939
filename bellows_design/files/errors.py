"""A file that could not be written, as a sentence for users."""

from __future__ import annotations

from bellows_design.validation.quoting import quoted_path


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
        return f"{quoted_path(self.place)} cannot be written: {self.strerror}"
