"""Want of memory is called so: not a singular matrix, a missing library, or a bad solid."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from real_command import bellows

from bellows_design.cli.answer import NOT_SOLVED, explained
from bellows_design.cli.surroundings.memory import require_address_space, want_of_memory

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="limits as Linux has them")


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (MemoryError(), "nothing more could be allocated"),
        (MemoryError("Unable to allocate 9.36 MiB"), "Unable to allocate 9.36 MiB."),
        (ImportError("libvtk.so: failed to map segment from shared object"), "libvtk.so"),
        (OSError(12, "Cannot allocate memory"), "Cannot allocate memory"),
    ],
)
def test_it_is_recognised_and_has_a_status_of_its_own(error: Exception, words: str) -> None:
    sentence, status = explained(error)
    assert status == NOT_SOLVED and sentence.startswith("not enough memory") and words in sentence


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), ValueError("memory")])
def test_other_errors_are_not_taken_for_it(error: Exception) -> None:
    assert want_of_memory(error) is None


@LINUX
@pytest.mark.parametrize(
    "arguments",
    [
        ("design", "finger", "-o", "part.stl"),
        ("check", "finger"),
        ("evaluate", "prototype_1"),
    ],
    ids=lambda words: words[0],
)
def test_too_little_address_space_is_noticed_before_libraries_abort(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    ended = bellows(*arguments, limits="ulimit -v 1000000;", folder=tmp_path)
    assert (ended.status, ended.out) == (3, "")
    assert "limited to 0.95 GiB of address space (ulimit -v)" in ended.err
    assert ended.err.count("\n") == 1 and list(tmp_path.iterdir()) == []


def test_without_a_limit_nothing_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    for limit in ("address_space_gib", "data_gib"):
        monkeypatch.setattr(f"bellows_design.machine.{limit}", lambda: None)
    require_address_space(1e9)


@LINUX
@pytest.mark.slow
def test_too_little_to_allocate_is_noticed_before_libraries_abort() -> None:
    for kibibytes, limit in ((400_000, "0.38"), (600_000, "0.57"), (900_000, "0.86")):
        ended = bellows("evaluate", "prototype_1", limits=f"ulimit -d {kibibytes};")
        assert ended.status == 3 and "not enough memory" in ended.err
        assert f"limited to {limit} GiB of data (ulimit -d) but needs 0.95 GiB" in ended.err


@LINUX
@pytest.mark.slow
def test_a_small_stack_is_enlarged_or_blamed_itself() -> None:
    assert bellows("evaluate", "prototype_1", limits="ulimit -Ss 256;").status == 0
    ended = bellows("evaluate", "prototype_1", "--no-cache", limits="ulimit -s 256;")
    assert ended.status == 3 and "stack is limited to 256 KiB (ulimit -s)" in ended.err
