"""Which Debian package to install when a wheel misses a library of the system.

Gmsh's wheel links to the X and OpenGL libraries of a desktop even where nothing is displayed;
CadQuery's needs libGL, libX11 and libexpat of them. All other wheels bring what they need.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

PACKAGES: Mapping[str, str] = MappingProxyType(
    {
        "libGL.so.1": "libgl1",
        "libGLU.so.1": "libglu1-mesa",
        "libX11.so.6": "libx11-6",
        "libXcursor.so.1": "libxcursor1",
        "libXext.so.6": "libxext6",
        "libXfixes.so.3": "libxfixes3",
        "libXft.so.2": "libxft2",
        "libXinerama.so.1": "libxinerama1",
        "libXrender.so.1": "libxrender1",
        "libexpat.so.1": "libexpat1",
        "libfontconfig.so.1": "libfontconfig1",
        "libgomp.so.1": "libgomp1",
    }
)
"""Library -> the Debian (and Ubuntu) package that holds it."""

INSTALL = "apt-get install -y libgl1 libglu1-mesa libgomp1 libxcursor1 libxft2 libxinerama1"
"""Brings all of them on a bare Debian; the rest of the packages are dependencies of these."""

_MISSING = re.compile(r"(lib[\w.+-]+\.so[\w.]*): cannot open shared object file")


def missing_library(error: BaseException) -> str | None:
    """One sentence on what to install if ``error`` is a system library that is not there."""
    if not isinstance(error, OSError | ImportError):
        return None
    found = _MISSING.search(str(error))
    if found is None:
        return None
    library = found.group(1)
    if library not in PACKAGES:
        return f"the system library {library} is missing; install the package that holds it."
    return (
        f"the system library {library} is missing: on Debian or Ubuntu install the package "
        f"{PACKAGES[library]} (all that may be needed, as root or with sudo: {INSTALL})."
    )
