"""Panels of the help: commands by task, options by what they are about; and examples below.

A command names its panel and shows examples::

    @app.command(rich_help_panel=SHARE, epilog=examples("bellows report finger"))

Its options say in ``rich_help_panel`` which of ``DESIGN``, ``READING``, ``MATERIAL``,
``FILES``, ``LIMITS`` and ``SPEECH`` they belong to; what a command is about stays in “Options”.
"""

from __future__ import annotations

START = "Start"
PRINT = "Design and print"
COMPUTE = "Compute"
STUDY = "Study"
SHARE = "See and share"
TOOLS = "Other tools"
HOUSEKEEPING = "Housekeeping"

PANELS = (START, PRINT, COMPUTE, STUDY, SHARE, TOOLS, HOUSEKEEPING)
"""Of commands, in the order in which the help shows them."""

ORDER_OF_USE = (
    "list", "init",
    "design", "check", "run", "verify", "plate",
    "evaluate", "force", "compare", "fit",
    "optimize", "study", "benchmark",
    "report", "studio",
    "mesh",
    "doctor", "cache", "schema",
)  # fmt: skip
"""Commands in the order in which a panel shows them; any other follows as it was registered."""

DESIGN = "The design"
READING = "How the file is read"
MATERIAL = "The material"
FILES = "Files that are written"
LIMITS = "Limits, and what is kept"
SPEECH = "How it answers"

OPTION_PANELS = (DESIGN, READING, MATERIAL, FILES, LIMITS, SPEECH)
"""Of options."""


def examples(*commands: str) -> str:
    """An epilog that shows commands, each on a line of its own."""
    return "\n".join(["[bold]Examples[/bold]", *(f"  {command}" for command in commands)])
