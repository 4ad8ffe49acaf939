"""A 3MF file's archive, unpacked within limits.

`zipfile` reads the whole list of members at once, so its length is looked at beforehand; members
are unpacked in pieces, so that a bomb ends at the limit.
"""

from __future__ import annotations

import struct
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO

from printers.errors import PrintersError
from printers.reading.limits import LARGEST_FILE

LONGEST_LIST = 2**20  # bytes of the list of members
PIECE = 2**20  # bytes
_END, _END_64, _LOCATOR_64 = b"PK\x05\x06", b"PK\x06\x06", b"PK\x06\x07"
_END_SIZE, _END_64_SIZE, _LOCATOR_SIZE = 22, 56, 20
_LONGEST_COMMENT = 65_535
_PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_DAMAGE = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, OSError, ValueError, IndexError)
"""What zipfile raises for archives that are damaged; sizes and places in them are not checked."""


@dataclass
class Package:
    """Members of a ZIP archive. `unpacked` counts the bytes that were taken out of it so far."""

    content: bytes
    unpacked: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        _require_short_list(self.content)
        try:
            self._archive = zipfile.ZipFile(BytesIO(self.content))
        except (*_DAMAGE, NotImplementedError):
            raise PrintersError("its archive is damaged") from None

    def __contains__(self, name: str) -> bool:
        return name in self._archive.NameToInfo

    def pieces(self, name: str) -> Iterator[bytes]:
        """The content of a member. Raises PrintersError if there is none, or too much of it."""
        if name not in self:
            raise PrintersError(f"it lacks {name[:80]!r}")
        if self._archive.NameToInfo[name].compress_type not in _PACKINGS:
            raise PrintersError(f"its member {name[:80]!r} is packed in a way that 3MF forbids")
        try:
            with self._archive.open(name) as member:
                while piece := member.read(PIECE):
                    self.unpacked += len(piece)
                    self._require_bounded()
                    yield piece
        except PrintersError:
            raise
        except (RuntimeError, NotImplementedError):  # how zipfile says this
            raise PrintersError(f"its member {name[:80]!r} is encrypted") from None
        except _DAMAGE:
            raise PrintersError(f"its member {name[:80]!r} is damaged") from None

    def _require_bounded(self) -> None:
        if self.unpacked > LARGEST_FILE:
            raise PrintersError(f"it unpacks to more than {LARGEST_FILE // 2**20} MiB")


def _require_short_list(content: bytes) -> None:
    end = content.rfind(_END, max(0, len(content) - _END_SIZE - _LONGEST_COMMENT))
    if end < 0 or end + _END_SIZE > len(content):
        raise PrintersError("its archive is cut short")
    length = int.from_bytes(content[end + 12 : end + 16], "little")
    locator = end - _LOCATOR_SIZE
    if locator >= 0 and content[locator:].startswith(_LOCATOR_64):
        start = locator - _END_64_SIZE
        if start < 0 or not content[start:].startswith(_END_64):
            raise PrintersError("its archive is damaged")
        length = int.from_bytes(content[start + 40 : start + 48], "little")
    if length > LONGEST_LIST:
        raise PrintersError("its archive lists more members than a part has")
