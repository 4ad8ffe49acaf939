"""Entry point of the command ``bellows``, and of ``python -m bellows_design``."""

from __future__ import annotations

import atexit
import os
import sys

from bellows_design.cli.early_signals import leave_at_signals

SIGNALLED = 128
"""Statuses above it tell of a signal."""


def main() -> None:
    """Run the command; its own imports, which take a while, may be interrupted already."""
    leave_at_signals()
    from bellows_design.cli.surroundings.environment import use_plain_environment
    from bellows_design.cli.surroundings.streams import final_status, use_tolerant_streams

    output = use_tolerant_streams()
    use_plain_environment()
    _leave(final_status(output, _status()))


def _leave(status: int) -> None:
    """End the process; taking apart what was compiled and loaded would take another second.

    After a signal, libraries may be half loaded, and what they registered for the end may crash.
    """
    if status > SIGNALLED:
        from bellows_design.cli.answer import clear_up

        clear_up()
    else:
        atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def _status() -> int:
    """Run the command; its exit status, of which 1 is *refused* and nothing else."""
    try:
        from bellows_design.cli.commands import app

        app()
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 0
    except Exception as error:  # Python itself would end with status 1
        from bellows_design.cli.surroundings.memory import want_of_memory

        sentence = want_of_memory(error)
        shown = sentence or f"internal error, {type(error).__name__}: {error}"
        print(f"bellows: {shown}", file=sys.stderr)
        return 3 if sentence else 4
    return 0


if __name__ == "__main__":
    main()
