"""Python, the libraries of the core and of the extras, and which of them work."""

from __future__ import annotations

import platform
import re
import sys
from collections.abc import Iterator, Mapping
from importlib.metadata import PackageNotFoundError, requires, version

from bellows_design.cli.doctor.finding import Finding, Verdict
from bellows_design.cli.doctor.trying import LATE, Tried
from bellows_design.cli.system_libraries import missing_library

OLDEST = (3, 11)
PACKAGE = "bellows-design"

PACKAGES: Mapping[str, str] = {"scipy.sparse": "scipy"}
"""Module -> package, where their names differ."""

DEVELOPERS = ("test", "docs")
"""Extras that only those who work on this program need."""

EXTRA = re.compile(r"""extra\s*==\s*["']([\w-]+)["']""")
NAME = re.compile(r"^[\w.-]+")
WANTED = re.compile(r"[<>=!~]=?[^;]*")

LIBRARIES = "libraries"
INSTALL = "pip install -e ."


def python() -> Finding:
    """The interpreter, and where it is."""
    said = f"{platform.python_version()}, {sys.executable}"
    if sys.version_info[:2] >= OLDEST:
        return Finding(LIBRARIES, "Python", "ok", said)
    needed = ".".join(map(str, OLDEST))
    return Finding(LIBRARIES, "Python", "fail", said, f"install Python {needed} or newer")


def core(tried: Mapping[str, Tried]) -> Iterator[Finding]:
    """Every library of the core that was tried."""
    for name in ("libraries", "cad", "mesher", "compiler"):
        probe = tried.get(name, Tried())
        for module, said in probe.said.items():
            yield _of_module(module, str(said.get("error", "")), bool(said.get("works")))
        for module, why in probe.broken.items():
            yield _of_module(module, why, False)


def _of_module(module: str, error: str, works: bool) -> Finding:
    package = PACKAGES.get(module, module)
    shown = _version(package)
    if works:
        return Finding(LIBRARIES, package, "ok", shown or "works")
    if error.startswith(LATE) and shown:
        late = f"{shown}: {error}"
        return Finding(LIBRARIES, package, "warn", late, "the machine is busy: try again later")
    said = f"{shown or 'not installed'}: {' '.join((error or 'it does not work').split())[:200]}"
    return Finding(LIBRARIES, package, "fail", said, how_to_mend(error, package))


def how_to_mend(error: str, package: str) -> str:
    """What to install for an error of an import."""
    missing = missing_library(ImportError(error))
    if missing is not None:
        return missing.rstrip(".")
    again = f"pip install --force-reinstall {package}"
    return INSTALL if "No module named" in error else again


def extras() -> Iterator[Finding]:
    """Every extra: which of its packages are there."""
    for name, packages in _extras().items():
        missing = [package for package in packages if not _version(package)]
        there = [f"{package} {_version(package)}" for package in packages if _version(package)]
        if not missing:
            yield Finding("extras", name, "ok", ", ".join(there))
            continue
        verdict: Verdict = "ok" if name in DEVELOPERS else "warn"
        said = f"{', '.join(missing)} not installed"
        mend = f"pip install -e '.[{name}]'" if verdict == "warn" else ""
        yield Finding("extras", name, verdict, said, mend)


def _extras() -> dict[str, list[str]]:
    """Packages that each extra brings, without extras that it consists of."""
    found: dict[str, list[str]] = {}
    try:
        declared = requires(PACKAGE) or []
    except PackageNotFoundError:
        declared = []
    for line in declared:
        extra, name = EXTRA.search(line), NAME.match(line)
        if extra is not None and name is not None and name[0] != PACKAGE:
            found.setdefault(extra[1], []).append(name[0])
    return found


def own_version() -> Finding:
    """This program."""
    from bellows_design import __version__

    if _version(PACKAGE):
        return Finding(LIBRARIES, PACKAGE, "ok", __version__)
    said = f"{__version__}, run from its folder: it is not installed"
    return Finding(LIBRARIES, PACKAGE, "warn", said, INSTALL)


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
    except Exception:  # its metadata are damaged
        return "of unknown version"
