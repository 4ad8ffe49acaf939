"""Files that are none, or mean harm: one sentence each, at once, with little memory."""

from __future__ import annotations

import os
import random
import re
import struct
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest
from part_files import (
    CORE,
    binary_stl,
    mesh_xml,
    model_xml,
    object_xml,
    package,
    text_stl,
    three_mf,
)
from small_solids import arrays, hollow_box

from printers.errors import PrintersError
from printers.reading import limits
from printers.reading.read import read_part
from printers.reading.step_files.reader import read_step
from printers.reading.stl import read_stl
from printers.reading.threemf import archive, xml_events
from printers.reading.threemf.reader import read_3mf

VERTICES, TRIANGLES = arrays(hollow_box())
BINARY, TEXT = binary_stl(VERTICES, TRIANGLES), text_stl(VERTICES, TRIANGLES)
MESH = mesh_xml(VERTICES, TRIANGLES)
STEP = b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n%s\nENDSEC;\nEND-ISO-10303-21;\n"


def wrong_number(value: float) -> bytes:
    vertices = VERTICES.copy()
    vertices[3, 1] = value
    return binary_stl(vertices, TRIANGLES)


def built(objects: str, build: str = '<item objectid="1"/>') -> bytes:
    return package(model_xml(objects, build))


def ten_of(number: int) -> str:
    """Components: ten copies of an object."""
    return "<components>" + 10 * f'<component objectid="{number}"/>' + "</components>"


def with_first_number(text: bytes) -> bytes:
    """The text STL with another word for its first coordinate."""
    return re.sub(rb"vertex \S+", b"vertex " + text, TEXT, count=1)


def squashed(scale: float) -> bytes:
    """The box, much narrower along x."""
    transform = f"{scale!r} 0 0 0 1 0 0 0 1 0 0 0"
    return built(object_xml(1, MESH), f'<item objectid="1" transform="{transform}"/>')


THREE_VERTICES = mesh_xml(VERTICES[:3], np.zeros((4, 3), dtype=int))
CHAIN = "".join(object_xml(i, ten_of(i + 1)) for i in range(1, 10)) + object_xml(10, MESH)
ITSELF = object_xml(1, ten_of(1))
BILLION = b"x" * 80 + struct.pack("<I", 10**9) + b"y" * 5000
ENTITY = f'<!DOCTYPE a [<!ENTITY b "cc">]><model xmlns="{CORE}"/>'
LONG = f'<model xmlns="{CORE}" x="{"a" * 2**23}"/>'
FLAT = f'<item objectid="1" transform="{"0 " * 12}"/>'


@pytest.mark.parametrize(
    ("content", "suffix", "words"),
    [
        (b"", ".stl", "it is empty"),
        (b"solid", ".stl", "at least 84"),
        (BINARY[:-30], ".stl", "it is cut short"),
        (
            b"x" * 80 + struct.pack("<I", 10**9) + b"y" * 500,
            ".stl",
            "declares 1000000000 triangles",
        ),
        (b"x" * 80 + struct.pack("<I", 3) + BINARY[84:], ".stl", "more behind them"),
        (b"x" * 84, ".stl", "it is cut short, or no STL"),
        (b"\0" * 84, ".stl", "holds no triangle"),
        (binary_stl(VERTICES, TRIANGLES[:1]), ".stl", "holds 1 triangle; a solid has 4 or more"),
        (text_stl(VERTICES, TRIANGLES[:3]), ".stl", "holds 3 triangles; a solid has 4 or more"),
        (built(object_xml(1, THREE_VERTICES)), ".3mf", "holds 3 vertices; a solid has 4 or more"),
        (wrong_number(np.nan), ".stl", "no finite number"),
        (wrong_number(-np.inf), ".stl", "no finite number"),
        (wrong_number(1e30), ".stl", "1e\\+30 mm"),
        (TEXT[:-40], ".stl", "cut short|no whole facet"),
        (TEXT.removesuffix(b"endsolid part\n"), ".stl", "cut short"),
        (TEXT.replace(b"vertex", b"vertx", 1), ".stl", "from its line 2 on"),
        (
            re.sub(rb"vertex \S+", b"vertex one", TEXT, count=1),
            ".stl",
            "coordinate that is no number",
        ),
        (with_first_number(b"nan"), ".stl", "no finite number"),
        (b"solid x\nendsolid x\n" + b" " * 100, ".stl", "holds no triangle"),
        (b"solid x\nendsolid x\n" * 20_000, ".stl", "more than 10000 solids"),
        (three_mf(VERTICES, TRIANGLES), ".stl", "that of a .3mf file"),
        (BINARY, ".3mf", "does not begin as that of a .3mf file"),
        (BINARY, ".step", "does not begin as that of a .step file"),
        (BINARY, ".obj", "must end in .stl"),
        (three_mf(VERTICES, TRIANGLES)[:-40], ".3mf", "cut short|damaged"),
        (b"PK\x03\x04" + b"\0" * 200, ".3mf", "cut short"),
        (package("<model/>"), ".3mf", "no 3MF model"),
        (package("not xml"), ".3mf", "XML is damaged"),
        (
            package(f'<!DOCTYPE a [<!ENTITY b "cc">]><model xmlns="{CORE}"/>'),
            ".3mf",
            "document type",
        ),
        (package(f'<model xmlns="{CORE}">' + "<a>" * 1000), ".3mf", "nested more than"),
        (
            package(f'<model xmlns="{CORE}" x="{"a" * 2**23}"/>'),
            ".3mf",
            "an element takes more than",
        ),
        (package(model_xml("", "")), ".3mf", "builds nothing"),
        (built(""), ".3mf", "which it lacks"),
        (
            built(object_xml(1, '<components><component objectid="1"/></components>')),
            ".3mf",
            "deep",
        ),
        (built(CHAIN), ".3mf", "copies"),
        (built(object_xml(1, MESH.replace('v1="0"', 'v1="9999"'))), ".3mf", "vertex beyond"),
        (built(object_xml(1, MESH.replace('v1="0"', 'v1="-1"'))), ".3mf", "vertex beyond"),
        (built(object_xml(1, MESH.replace('v1="0"', 'v1="9e9"'))), ".3mf", "no number"),
        (built(object_xml(1, MESH.replace(' x="', ' w="', 1))), ".3mf", "lacks 'x'"),
        (built(object_xml(1, MESH), '<item objectid="1" transform="1 2"/>'), ".3mf", "twelve"),
        (
            built(object_xml(1, MESH), f'<item objectid="1" transform="{"0 " * 12}"/>'),
            ".3mf",
            "flat",
        ),
        (squashed(1e-9), ".3mf", "flat"),
        (squashed(-1e-9), ".3mf", "flat"),
        (built(object_xml(1, "<mesh><beamlattice/></mesh>")), ".3mf", "only triangles"),
        (package(model_xml(object_xml(1, MESH), "", "parsec")), ".3mf", "its unit is 'parsec'"),
        (STEP[:60], ".step", "cut short"),
    ],
)
def test_a_file_that_holds_no_part_gets_one_sentence(
    content: bytes, suffix: str, words: str, tmp_path: Path
) -> None:
    path = tmp_path / f"part{suffix}"
    path.write_bytes(content)
    with pytest.raises(PrintersError, match=words) as refusal:
        read_part(path)
    assert str(refusal.value).count("\n") == 0 and path.name in str(refusal.value)
    assert len(str(refusal.value)) < 1000


def test_no_memory_is_taken_for_what_a_file_only_declares(tmp_path: Path) -> None:
    """10⁹ triangles would be 72 GB."""
    path = tmp_path / "part.stl"
    path.write_bytes(BILLION)
    tracemalloc.start()
    try:
        with pytest.raises(PrintersError):
            read_part(path)
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


def test_a_zip_bomb_ends_at_the_limit(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Blanks shrink a thousand times. The limit is lowered so that the test takes no second."""
    path = tmp_path / "part.3mf"
    path.write_bytes(package(f'<model xmlns="{CORE}">' + " " * 2**26))
    monkeypatch.setattr(archive, "LARGEST_FILE", 2**23)
    assert path.stat().st_size < 2**18
    tracemalloc.start()
    try:
        with pytest.raises(PrintersError, match="unpacks to more than 8 MiB"):
            read_part(path)
        assert tracemalloc.get_traced_memory()[1] < 2**24
    finally:
        tracemalloc.stop()


def test_many_elements_end_at_the_limit(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Elements that mean nothing cost time all the same."""
    path = tmp_path / "part.3mf"
    path.write_bytes(package(f'<model xmlns="{CORE}">' + "<a/>" * 5000))
    monkeypatch.setattr(xml_events, "MOST_ELEMENTS", 4000)
    with pytest.raises(PrintersError, match="more than 4000 elements"):
        read_part(path)


def test_an_archive_with_a_million_members_is_refused_by_the_length_of_its_list() -> None:
    many = b"PK\x03\x04" + b"PK\x01\x02" * 2**19
    end = b"PK\x05\x06" + struct.pack("<HHHHIIH", 0, 0, 9, 9, len(many), 4, 0)
    with pytest.raises(PrintersError, match="more members"):
        archive.Package(many + end)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes with names")
def test_pipes_devices_folders_and_huge_files_are_no_files(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.stl")
    (tmp_path / "folder.stl").mkdir()
    (tmp_path / "device.stl").symlink_to("/dev/zero")
    with (tmp_path / "huge.stl").open("wb") as huge:
        huge.truncate(limits.LARGEST_FILE + 1)
    for name, words in (
        ("pipe.stl", "pipe or a device"),
        ("folder.stl", "folder"),
        ("device.stl", "pipe or a device"),
        ("huge.stl", "at most 256 MiB"),
    ):
        with pytest.raises(PrintersError, match=words):
            read_part(tmp_path / name)
    with pytest.raises(OSError, match="No such file"):
        read_part(tmp_path / "nothing.stl")


def test_a_step_reader_that_does_not_end_is_ended() -> None:
    """A whole file, and no time for it."""
    with pytest.raises(PrintersError, match=r"did not read it within 0\.05 s"):
        read_step(STEP % b"#1=X();", seconds=0.05)


def test_a_step_reader_without_memory_does_not_end_the_program() -> None:
    with pytest.raises(PrintersError, match=r"could not read it|memory"):
        read_step(STEP % b"#1=X();", memory=2**28)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"#1=CARTESIAN_POINT('',(0.,0.,0.));", "holds no shape"),
        (b"#1=ADVANCED_FACE('',(#2),#3,.T.);", "references lead nowhere"),
        (b"\0\xff#1=((((" * 1000, "no STEP|no shape|damaged"),
    ],
)
def test_what_holds_no_solid_is_refused_by_the_cad_kernel(data: bytes, words: str) -> None:
    with pytest.raises(PrintersError, match=words):
        read_step(STEP % data)


READERS = {
    "binary": (BINARY, read_stl),
    "text": (TEXT, read_stl),
    "3mf": (three_mf(VERTICES, TRIANGLES), read_3mf),
    "3mf, not packed": (
        package(model_xml(object_xml(1, MESH), '<item objectid="1"/>'), zipfile.ZIP_STORED),
        read_3mf,
    ),
}


def damaged(content: bytes, rng: random.Random) -> bytes:
    """Bytes changed, lost and put in, more often near the ends, where the counts stand."""
    result = bytearray(content)
    for _ in range(rng.choice([1, 2, 5, 20])):
        start, stop = rng.choice([(0, 300), (len(result) - 300, len(result)), (0, len(result))])
        place = rng.randrange(max(0, start), max(1, min(stop, len(result))))
        some = bytes(rng.randrange(256) for _ in range(rng.randrange(1, 9)))
        kind = rng.randrange(4)
        if kind < 3:
            result[place : place + (1, 0, len(some))[kind]] = (some[:1], some, b"")[kind]
        elif rng.random() < 0.2:
            del result[place:]
        if len(result) < 100:
            break
    return bytes(result)


@pytest.mark.parametrize("kind", READERS)
def test_damage_anywhere_is_a_sentence_or_another_part(kind: str) -> None:
    content, reader = READERS[kind]
    rng = random.Random(kind)
    refused = 0
    for _ in range(300):
        try:
            reader(damaged(content, rng))
        except PrintersError:
            refused += 1
    assert refused > 100
