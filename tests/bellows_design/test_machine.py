"""What the machine has, and what a container leaves of it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest

from bellows_design import machine
from bellows_design.machine import GIB, MIB, memory_gib, peak_memory_mib


@pytest.fixture(autouse=True)
def asked_anew() -> Iterator[None]:
    """The machine's memory is asked for once a process."""
    memory_gib.cache_clear()
    yield
    memory_gib.cache_clear()


def test_a_container_has_no_more_than_it_is_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = [tmp_path / name for name in ("unlimited", "limited", "missing")]
    files[0].write_text("max\n")
    files[1].write_text("536870912\n")
    monkeypatch.setattr(machine, "CONTROL_GROUPS", files)
    assert memory_gib() == machine.machine().memory_gib == 0.5


def test_without_a_limit_it_is_the_machines_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "limit_in_bytes").write_text("9223372036854771712\n")  # none, in version 1
    monkeypatch.setattr(machine, "CONTROL_GROUPS", (tmp_path / "limit_in_bytes",))
    assert memory_gib() == psutil.virtual_memory().total / GIB


def test_memory_that_nobody_states_is_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    def hidden() -> None:
        raise FileNotFoundError("/proc/meminfo")

    monkeypatch.setattr(psutil, "virtual_memory", hidden)
    monkeypatch.setattr(machine, "CONTROL_GROUPS", ())
    assert memory_gib() is None


def test_the_peak_is_no_less_than_what_is_held_now() -> None:
    held = psutil.Process().memory_info().rss / MIB
    peak = peak_memory_mib()
    assert peak is not None and peak >= 0.9 * held


def test_on_windows_the_peak_is_that_of_the_working_set(monkeypatch: pytest.MonkeyPatch) -> None:
    process = SimpleNamespace(memory_info=lambda: SimpleNamespace(peak_wset=3 * MIB))
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(psutil, "Process", lambda: process)
    assert peak_memory_mib() == 3.0


def test_a_limit_of_the_address_space_counts_as_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """The libraries take more addresses than memory."""
    monkeypatch.setattr(machine, "address_space_gib", lambda: 2.0)
    assert memory_gib() == pytest.approx(2.0 - machine.ADDRESSES_OF_LIBRARIES)
    memory_gib.cache_clear()
    monkeypatch.setattr(machine, "address_space_gib", lambda: 1.0)
    assert memory_gib() == 0.0
