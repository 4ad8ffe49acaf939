"""The whole examination: every line guarded, so that nothing broken ends it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor

from bellows_design.cli.doctor import computing, libraries, places, programs
from bellows_design.cli.doctor.finding import Examination, Finding
from bellows_design.cli.doctor.probes import PROBES
from bellows_design.cli.doctor.trying import Tried, tried

Line = Callable[[], Finding | Iterable[Finding]]


def examine() -> Examination:
    """Everything, in a few seconds; the slicer is asked while the libraries are tried."""
    began = time.perf_counter()
    with ThreadPoolExecutor(1) as pool:
        slicer = pool.submit(lambda: list(guarded("programs", "slicer", programs.slicer)))
        probes = tried(tuple(PROBES))
        findings = [*_lines(probes), *slicer.result()]
    ordered = sorted(findings, key=lambda each: GROUPS.index(each.group))
    return Examination(tuple(ordered), time.perf_counter() - began)


GROUPS = ("libraries", "extras", "computing", "programs", "places", "environment")
"""In the order in which they are shown."""


def _lines(probes: Mapping[str, Tried]) -> Iterator[Finding]:
    lines: tuple[tuple[str, str, Line], ...] = (
        ("libraries", "Python", libraries.python),
        ("libraries", libraries.PACKAGE, libraries.own_version),
        ("libraries", "core", lambda: libraries.core(probes)),
        ("extras", "extras", libraries.extras),
        ("computing", "linear solver", lambda: computing.linear_solver(probes)),
        ("computing", "compiled functions", lambda: computing.compiled_functions(probes)),
        ("computing", "processors", lambda: computing.processors(probes)),
        ("computing", "memory", computing.memory),
        ("programs", "browser", programs.browser),
        ("programs", "pictures by VTK", lambda: programs.display(probes)),
        ("programs", "completion", programs.shell_completion),
        ("places", "cache", places.cache),
        ("places", "exports", places.exports),
        ("places", "temporary files", places.temporary),
        ("places", "disk", places.disks),
        ("places", "locale", places.encoding),
        ("environment", "variables", places.variables),
    )
    for group, name, line in lines:
        yield from guarded(group, name, line)


def guarded(group: str, name: str, line: Line) -> Iterator[Finding]:
    """What ``line`` finds; a warning with the error where it fails itself."""
    try:
        found = line()
        yield from [found] if isinstance(found, Finding) else list(found)
    except Exception as error:  # whatever is broken, the rest is still examined
        said = f"could not be examined: {type(error).__name__}: {error}"
        yield Finding(group, name, "warn", " ".join(said.split())[:200])
