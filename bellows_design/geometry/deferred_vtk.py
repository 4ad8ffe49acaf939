"""VTK, loaded when something of it is asked for.

The CAD kernel's bindings import all of it, some 130 libraries, for types of arguments that nothing
here has: a quarter of the time that CadQuery takes to load.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
from types import ModuleType
from typing import Any

NAME = "vtk"


def defer_vtk() -> None:
    """Put a module in VTK's place that loads it when asked for one of its names."""
    spec = None if NAME in sys.modules else importlib.util.find_spec(NAME)
    if spec is None:
        return
    module = _Deferred(NAME)
    module.__spec__ = spec
    sys.modules[NAME] = module


class _Deferred(ModuleType):
    """Becomes what it stands for at the first name that it does not have."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # the import machinery looks for such; VTK has none of its own
            raise AttributeError(name)
        if sys.modules.get(NAME) is self:
            del sys.modules[NAME]
        return getattr(importlib.import_module(NAME), name)
