"""Standard streams that take everything: what cannot be written is remembered, not raised.

A stream may be closed, lead to a full disk, or to a program that has stopped reading. None of that
changes what a command finds, and so neither its other stream nor, as a rule, its exit status. Only
an answer that was lost by a fault is an error: then a sentence on stderr says which status it had.
"""

from __future__ import annotations

import errno
import os
import select
import sys
from io import BufferedWriter, FileIO, TextIOWrapper
from typing import Any, TextIO

STDIN, STDOUT, STDERR = 0, 1, 2

ANSWER_LOST = 2
"""Exit status where stdout could not be written."""


class Sink(FileIO):
    """A file that drops what it cannot write; ``failure`` is the first reason.

    One that ``leads_nowhere`` fails with the first write.
    """

    failure: OSError | None = None
    leads_nowhere = False

    def write(self, content: Any) -> int:
        """Write, or drop, all of ``content``; returns its bytes."""
        size = memoryview(content).nbytes
        if self.failure is not None:
            return size
        try:
            if self.leads_nowhere:
                raise OSError(errno.EBADF, "it is closed")
            while (written := super().write(content)) is None:  # another program made it so
                select.select([], [self], [])
        except OSError as error:
            self.failure = error
            return size
        return written


def use_tolerant_streams() -> Sink:
    """Put such streams in the place of stdout and stderr; returns the one that stdout writes to.

    Closed ones lead nowhere: the next file to be opened would take their numbers, and what
    libraries print would go there.
    """
    closed = [number for number in (STDIN, STDOUT, STDERR) if _is_closed(number)]
    for number in closed:
        os.open(os.devnull, os.O_RDONLY if number == STDIN else os.O_WRONLY)
    output, errors = (Sink(number, "w", closefd=False) for number in (STDOUT, STDERR))
    output.leads_nowhere = STDOUT in closed
    sys.stdout = _text(output, sys.stdout, "replace")
    sys.stderr = _text(errors, sys.stderr, "backslashreplace")
    return output


def final_status(output: Sink, status: int) -> int:
    """The exit status of a command that found ``status``, once all is written to ``output``."""
    sys.stdout.flush()
    failure = output.failure
    if failure is None or failure.errno == errno.EPIPE:  # the reader wants no more
        return status
    print(
        f"bellows: the answer cannot be written to standard output: {failure.strerror}; "
        f"the command itself ended with status {status}.",
        file=sys.stderr,
    )
    return status if failure.errno == errno.EBADF else ANSWER_LOST


def _is_closed(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return True
    return False


def _text(sink: Sink, usual: TextIO | None, errors: str) -> TextIOWrapper:
    """Text for ``sink`` in the encoding of ``usual``; characters that it lacks become others."""
    encoding = "utf-8" if usual is None else usual.encoding
    return TextIOWrapper(BufferedWriter(sink), encoding, errors, line_buffering=True)
