"""What a command says and leaves: sentences and statuses of errors, and its process as it was."""

from __future__ import annotations

import gc

import pytest

from bellows_design.cli.answer import (
    BAD_INPUT,
    INTERNAL,
    NOT_SOLVED,
    OBJECTS_BETWEEN_COLLECTIONS,
    explained,
    rare_garbage_collection,
)
from bellows_design.design.shipped import load_design
from bellows_design.errors import BellowsError, DesignError
from bellows_design.geometry.named_solids import GeometryError
from bellows_design.geometry.tessellation import TessellationError
from bellows_design.validation.parameters import require
from printers.errors import PrintersError
from solver.errors import MeshingError, SolverError


def error_of(call: object, *arguments: object) -> Exception:
    with pytest.raises(Exception) as caught:
        call(*arguments)  # type: ignore[operator]
    return caught.value


@pytest.mark.parametrize(
    ("kind", "status"),
    [
        (BellowsError, BAD_INPUT),
        (DesignError, BAD_INPUT),
        (GeometryError, BAD_INPUT),
        (TessellationError, BAD_INPUT),
        (SolverError, BAD_INPUT),
        (PrintersError, BAD_INPUT),
        (MeshingError, NOT_SOLVED),
    ],
)
def test_an_error_for_users_is_its_own_sentence(kind: type[Exception], status: int) -> None:
    assert explained(kind("a wall is too thin.")) == ("a wall is too thin.", status)


def test_only_a_message_of_ours_counts_as_bad_input() -> None:
    assert explained(error_of(load_design, "nowhere"))[1] == BAD_INPUT
    assert explained(error_of(int, "a bug"))[1] == INTERNAL


def test_any_other_error_is_an_internal_one_wherever_it_was_raised() -> None:
    for error in (
        error_of(require, False, "a bug of ours"),
        error_of(int, "a bug"),
        RuntimeError("a bug"),
        TypeError("a bug"),
    ):
        sentence, status = explained(error)
        assert status == INTERNAL and "a bug" in sentence
        assert sentence.startswith(f"internal error, {type(error).__name__}: ")


def test_garbage_is_collected_rarely_while_a_command_works_and_as_before_afterwards() -> None:
    usual = gc.get_threshold()
    with pytest.raises(KeyboardInterrupt), rare_garbage_collection():
        assert gc.isenabled() and gc.get_threshold()[0] == OBJECTS_BETWEEN_COLLECTIONS
        raise KeyboardInterrupt
    assert gc.get_threshold() == usual
