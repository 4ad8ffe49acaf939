"""Entry point of the command ``bellows``, and of ``python -m bellows_design``."""

from __future__ import annotations

from bellows_design.cli.early_signals import leave_at_signals


def main() -> None:
    """Run the command; its own imports, which take a while, may be interrupted already."""
    leave_at_signals()
    from bellows_design.cli.commands import app

    app()


if __name__ == "__main__":
    main()
