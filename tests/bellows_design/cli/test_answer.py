"""What a command changes in its process while it works, it puts back."""

from __future__ import annotations

import gc

import pytest

from bellows_design.cli.answer import OBJECTS_BETWEEN_COLLECTIONS, rare_garbage_collection


def test_garbage_is_collected_rarely_while_a_command_works_and_as_before_afterwards() -> None:
    usual = gc.get_threshold()
    with pytest.raises(KeyboardInterrupt), rare_garbage_collection():
        assert gc.isenabled() and gc.get_threshold()[0] == OBJECTS_BETWEEN_COLLECTIONS
        raise KeyboardInterrupt
    assert gc.get_threshold() == usual
