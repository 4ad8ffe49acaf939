"""XML, element by element, without what makes XML dangerous: no document types, so no entities."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from xml.parsers import expat

from printers.errors import PrintersError
from printers.reading.limits import MOST_TRIANGLES

DEEPEST = 32
MOST_ELEMENTS = 4 * MOST_TRIANGLES  # a closed mesh has half as many vertices as triangles
LONGEST_ELEMENT = 2**22  # bytes that are kept until the element ends

Attributes = dict[str, str]
Begin = Callable[[str, Attributes], None]
"""Called with "namespace name" (or "name") and attributes, named likewise."""


def read_elements(pieces: Iterable[bytes], begin: Begin, end: Callable[[str], None]) -> None:
    """Call `begin` and `end` for each element. Raises PrintersError for what is no plain XML."""
    parser = expat.ParserCreate(namespace_separator=" ")
    depth = count = 0

    def start(name: str, attributes: Attributes) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if count > MOST_ELEMENTS:
            raise PrintersError(f"it holds more than {MOST_ELEMENTS} elements")
        if depth > DEEPEST:
            raise PrintersError(f"its elements are nested more than {DEEPEST} deep")
        begin(name, attributes)

    def finish(name: str) -> None:
        nonlocal depth
        depth -= 1
        end(name)

    def refuse(*_: object) -> None:
        raise PrintersError("its XML declares a document type, which 3MF forbids")

    parser.StartElementHandler, parser.EndElementHandler = start, finish
    parser.StartDoctypeDeclHandler = refuse
    _feed(parser, pieces)


def _feed(parser: expat.XMLParserType, pieces: Iterable[bytes]) -> None:
    fed = 0
    try:
        for piece in pieces:
            parser.Parse(piece, False)
            fed += len(piece)
            if fed - max(parser.CurrentByteIndex, 0) > LONGEST_ELEMENT:
                raise PrintersError(f"an element takes more than {LONGEST_ELEMENT // 2**20} MiB")
        parser.Parse(b"", True)
    except expat.ExpatError as error:
        raise PrintersError(f"its XML is damaged: {error}") from None
    except (UnicodeError, LookupError):
        raise PrintersError("its XML is in no known encoding") from None
