"""Files of a user are read with a bound; devices, pipes and files without an end are refused."""

from __future__ import annotations

import os
import socket
import sys
from pathlib import Path

import pytest

from bellows_design.design import load_design
from bellows_design.errors import DesignError
from bellows_design.files.guarded import PIECE, decoded, read_file
from bellows_design.materials import load_measurements
from printers import PrintersError, load_profile

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="devices of POSIX")

NO_END = Path("/proc/kmsg")
"""Calls itself a regular file, and waits for the kernel's next message."""

may_be_opened = pytest.mark.skipif(
    not os.access(NO_END, os.R_OK), reason="only root may open /proc/kmsg"
)


def test_a_file_is_read_whole_up_to_its_bound(tmp_path: Path) -> None:
    content = os.urandom(2 * PIECE + 7)
    (tmp_path / "file").write_bytes(content)
    assert read_file(tmp_path / "file", "design", len(content)) == content
    with pytest.raises(DesignError, match="design “file” is larger than 2 MB"):
        read_file(tmp_path / "file", "design", len(content) - 1, shown="file")


@POSIX
@pytest.mark.parametrize("kind", ["pipe", "socket", "folder"])
@pytest.mark.parametrize("load", [load_design, load_measurements, load_profile])
def test_what_is_no_file_is_refused_at_once(kind: str, load: object, tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    with socket.socket(socket.AF_UNIX) as server:
        if kind == "pipe":
            os.mkfifo(path)
        elif kind == "socket":
            server.bind(str(path))
        else:
            path.mkdir()
        with pytest.raises((DesignError, PrintersError)) as caught:
            load(path)  # type: ignore[operator]
    assert "\n" not in str(caught.value)


@POSIX
@pytest.mark.parametrize("load", [load_design, load_measurements, load_profile])
@pytest.mark.parametrize("device", ["/dev/zero", "/dev/full", "/dev/random"])
def test_devices_are_refused(load: object, device: str, tmp_path: Path) -> None:
    (tmp_path / "link.toml").symlink_to(device)
    with pytest.raises((DesignError, PrintersError), match=r"device|no file"):
        load(tmp_path / "link.toml")  # type: ignore[operator]


@POSIX
@may_be_opened
@pytest.mark.parametrize("load", [load_design, load_measurements, load_profile])
def test_a_file_without_an_end_is_not_waited_for(load: object, tmp_path: Path) -> None:
    (tmp_path / "link.toml").symlink_to(NO_END)
    with pytest.raises((DesignError, PrintersError), match=r"no end|1 MB"):
        load(tmp_path / "link.toml")  # type: ignore[operator]


@POSIX
def test_a_file_of_the_kernels_that_ends_is_read() -> None:
    assert read_file(Path("/proc/self/status"), "design", 10**6) or sys.platform != "linux"


def test_a_path_that_cannot_be_one_is_a_sentence() -> None:
    with pytest.raises(DesignError, match="cannot be read: embedded null byte"):
        read_file(Path("a\0b"), "design", 10)


def test_lines_end_alike_wherever_they_were_written() -> None:
    assert decoded("\ufeffa\r\nb\rc\n".encode(), "it") == "a\nb\nc\n"
    with pytest.raises(DesignError, match="it is not a text file in UTF-8"):
        decoded(b"\xff", "it")
