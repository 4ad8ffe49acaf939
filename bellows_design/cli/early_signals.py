"""How a command ends when a signal meets it while there is nothing to clear up.

Imports next to nothing: until ``leave_at_signals`` has run, Python answers Ctrl-C by a traceback.
"""

from __future__ import annotations

import os
import signal
from contextlib import suppress

SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)


def leave_at_signals() -> None:
    """From now on the signals end the process with a sentence, but for those to be ignored."""
    for number in SIGNALS:
        if signal.getsignal(number) != signal.SIG_IGN:  # as nohup asks for
            signal.signal(number, _leave)


def ended_by(number: int) -> tuple[str, int]:
    """One sentence and the exit status of a command that a signal ended."""
    word = "interrupted" if number == signal.SIGINT else "terminated"
    return f"{word}; nothing half-done was left behind.", 128 + number


def _leave(number: int, frame: object) -> None:
    sentence, status = ended_by(number)
    with suppress(OSError):  # closed, or full
        os.write(2, f"bellows: {sentence}\n".encode())
    os._exit(status)
