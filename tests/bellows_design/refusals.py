"""How a bad design, material or table is refused."""

from __future__ import annotations

from collections.abc import Callable

from damage import soon

from bellows_design.errors import DesignError

LONGEST_SENTENCE = 1000


def refused_in_sentences(read: Callable[[], object]) -> bool:
    """True if ``read`` refused as documented; any error but ``DesignError`` goes through."""
    with soon():
        try:
            read()
        except DesignError as error:
            assert 0 < len(error.sentences) <= 21
            assert str(error).split("\n") == list(error.sentences)
            assert all(0 < len(line) < LONGEST_SENTENCE for line in error.sentences)
            assert all(line.isprintable() for line in error.sentences)
            return True
    return False
