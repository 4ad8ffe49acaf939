"""What a bare Debian lacks is named, and the README's line installs it."""

from __future__ import annotations

import ctypes
import shutil
import struct
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import files
from pathlib import Path

import pytest

from bellows_design.cli.system_libraries import INSTALL, PACKAGES, missing_library

ROOT = Path(__file__).parents[3]
WHEELS = ("cadquery-ocp", "gmsh", "lib3mf", "llvmlite", "manifold3d", "numpy", "scipy", "vtk")
"""Those whose every library must load; Numba's threading layers, for one, are optional."""

EVERYWHERE = (
    *("ld-linux", "libc.", "libdl.", "libgcc_s.", "libm.", "libpthread.", "librt.", "libstdc++."),
    "libz.",
)
"""Libraries that every Debian has: dpkg and apt are linked to them."""


def test_a_missing_library_is_recognised_in_the_words_of_the_real_loader() -> None:
    with pytest.raises(OSError) as caught:
        ctypes.CDLL("libnosuchthing.so.7")
    sentence = missing_library(caught.value)
    assert sentence is not None and "libnosuchthing.so.7 is missing" in sentence


@pytest.mark.parametrize("library", PACKAGES)
def test_one_sentence_names_the_library_and_its_package(library: str) -> None:
    error = ImportError(f"{library}: cannot open shared object file: No such file or directory")
    sentence = missing_library(error)
    assert sentence is not None and "\n" not in sentence
    assert f"{library} is missing" in sentence
    assert f"install the package {PACKAGES[library]} " in sentence and INSTALL in sentence


def test_other_errors_are_not_taken_for_a_missing_library() -> None:
    assert missing_library(OSError("disk full")) is None
    assert missing_library(ImportError("No module named 'gmsh'")) is None
    assert missing_library(ValueError("libGL.so.1: cannot open shared object file")) is None


def test_the_readme_installs_exactly_what_the_program_asks_for() -> None:
    lines = (ROOT / "README.md").read_text("utf-8").splitlines()
    libraries, slicer = [line for line in lines if "apt-get install -y" in line]
    assert libraries == f"apt-get update && {INSTALL} python3-venv"
    assert slicer == "apt-get update && apt-get install -y prusa-slicer"


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has Debian's packages")
@pytest.mark.thorough
def test_every_library_the_wheels_link_to_has_its_package_named() -> None:
    objects = [path for wheel in WHEELS for path in shared_objects(wheel)]
    brought = {path.name for path in objects}
    linked = {library for path in objects for library in needed(path.read_bytes())}
    wanted = {library for library in linked - brought if not library.startswith(EVERYWHERE)}
    assert wanted and wanted <= set(PACKAGES)


def test_debian_brings_every_named_package_with_those_the_program_asks_for() -> None:
    asked = INSTALL.split()[3:]
    if shutil.which("dpkg-query") is None or installed_dependencies(asked) is None:
        pytest.skip("needs Debian with these packages installed")
    known: set[str] = set()
    ahead = set(asked)
    while ahead:
        known |= ahead
        ahead = (installed_dependencies(sorted(ahead)) or set()) - known
    assert set(PACKAGES.values()) <= known


def shared_objects(distribution: str) -> Iterator[Path]:
    """The ELF files that a wheel brought."""
    for file in files(distribution) or ():
        path = Path(str(file.locate()))
        if ".so" in path.name and path.is_file() and not path.is_symlink():
            yield path


def needed(elf: bytes) -> Iterator[str]:
    """Names of the libraries that a little-endian 64-bit ELF file links to (DT_NEEDED)."""
    (table,) = struct.unpack_from("<Q", elf, 0x20)
    size, count = struct.unpack_from("<HH", elf, 0x36)
    headers = [struct.unpack_from("<IIQQQQ", elf, table + size * i) for i in range(count)]
    dynamic = next((offset, length) for kind, _, offset, _, _, length in headers if kind == 2)
    entries = list(struct.iter_unpack("<qQ", elf[dynamic[0] : sum(dynamic)]))
    strings = dict(entries)[5]
    for kind, _, offset, address, _, length in headers:
        if kind == 1 and address <= strings < address + length:
            strings += offset - address
            break
    for tag, value in entries:
        if tag == 1:
            start = strings + value
            yield elf[start : elf.index(b"\0", start)].decode()


def installed_dependencies(packages: list[str]) -> set[str] | None:
    """Names of all packages that installed ones depend on; None if one is not installed."""
    query = subprocess.run(
        ["dpkg-query", "-W", "-f", "${Depends},", *packages], capture_output=True, encoding="utf-8"
    )
    if query.returncode:
        return None
    alternatives = query.stdout.replace("|", ",").split(",")
    return {name.split()[0].split(":")[0] for name in alternatives if name.strip()}
