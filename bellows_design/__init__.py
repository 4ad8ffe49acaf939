"""From the twelve numbers of a soft bellows actuator to an approved, printable STL."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bellows_design.design import Design, load_design
    from bellows_design.errors import DesignError
    from bellows_design.overrides import with_overrides

__version__ = "0.1.0"

__all__ = ["Design", "DesignError", "__version__", "load_design", "with_overrides"]

_HOMES = {
    "Design": "bellows_design.design",
    "load_design": "bellows_design.design",
    "DesignError": "bellows_design.errors",
    "with_overrides": "bellows_design.overrides",
}


def __getattr__(name: str) -> Any:
    """Import the public names when they are first asked for: `bellows --help` needs none."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
