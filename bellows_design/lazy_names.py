"""Names of a package that are imported when they are first asked for.

So ``bellows --help`` and programs that only need data classes wait for no compiled code.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module


def imported_when_asked_for(
    package: str, homes: Mapping[str, tuple[str, ...]]
) -> Callable[[str], object]:
    """The ``__getattr__`` of ``package`` (PEP 562); ``homes``: its modules and their names."""

    def find(name: str) -> object:
        for module, names in homes.items():
            if name in names:
                return getattr(import_module(f"{package}.{module}"), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return find
