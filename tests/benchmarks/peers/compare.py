"""Seconds, iterations and agreement of other codes on our mesh, next to ours.

    python tests/benchmarks/peers/compare.py --python ENVIRONMENT/bin/python [--json FILE]

Each code runs alone in its own process, ours once untimed before so that its compiled kernels are
cached. Prints a Markdown table; ``--json`` writes everything measured, with the machine.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
PEERS = {"NGSolve": "ngsolve_peer.py", "FElupe": "felupe_peer.py", "CalculiX": "calculix.py"}
FULL_PRESSURE = 0.1
WARM_UP_LOAD = 0.02
PACKAGES = ("numpy", "scipy", "numba", "mkl", "pypardiso", "ngsolve", "felupe")
HEADING = (
    "| code | reached | tip rotation | off the reference | load steps | iterations "
    "| solve | with start-up | memory | time / ours |\n|---|---|---|---|---|---|---|---|---|---|"
)

Result = dict[str, Any]


def run(name: str, python: str, script: str, load: float, limit: float) -> Result:
    """Run one code for at most ``limit`` seconds; what it reports, or how far it got."""
    command = [python, str(HERE / script), "--load", repr(load)]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        child = subprocess.Popen(command, stdout=out, stderr=err, start_new_session=True)
        late = wait(child, limit)
        out.seek(0)
        err.seek(0)
        reports, told = out.read(), err.read()
    if child.returncode == 0 and objects(reports):
        return {**objects(reports)[-1], "name": name}
    progress = (objects(told) or [{}])[-1]
    return {**progress, "name": name, "message": late or failure(told)}


def failure(told: str) -> str:
    """Why a code did not report, by the last line it left on stderr."""
    last = (told.strip().splitlines() or ["it said nothing"])[-1]
    if last.startswith(("not installed", "ModuleNotFoundError")):
        return f"not installed ({last.split()[-1]})"
    return f"failed: {last}"


def wait(child: subprocess.Popen[bytes], limit: float) -> str:
    """Wait for a process; end it and all it started after ``limit`` seconds, and say so."""
    try:
        child.wait(limit)
        return ""
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        return f"ended after the limit of {limit:g} s"


def objects(text: str) -> list[Result]:
    """The JSON objects among the lines of a text."""
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def row(result: Result, ours: Result, pressure: float) -> str:
    """One line of the table; a code that did not get to ``pressure`` (MPa) has no ratio."""
    if "seconds" not in result:
        return f"| {result['name']} | {result['message']} |" + " – |" * 8
    off, finished = result["difference_mm"], math.isclose(result["reached_mpa"], pressure)
    ratio = f"{result['seconds'] / ours['seconds']:.1f}" if finished and "seconds" in ours else "–"
    return (
        f"| {result['name']} {result.get('version', '')} | {result['reached_mpa']:.4g} MPa "
        f"| {result['rotation_deg']:.2f}° | {'–' if off is None else f'{off:.1e} mm'} "
        f"| {result['load_steps']} | {result['iterations']} | {result['seconds']:.1f} s "
        f"| {result['total_seconds']:.1f} s | {result['peak_memory_mib']:.0f} MiB | {ratio} |"
    )


def machine() -> Result:
    """Processor, cores, memory, system and load before the runs."""
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "memory_gib": os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1024**3,
        "system": platform.platform(),
        "load_average": os.getloadavg(),
    }


def processor() -> str:
    """Model name of the processor."""
    information = Path("/proc/cpuinfo")
    lines = information.read_text().splitlines() if information.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def versions(python: str) -> dict[str, str]:
    """Versions of the packages that matter, in an environment."""
    listing = [python, "-m", "pip", "list", "--format=json", "--disable-pip-version-check"]
    found = subprocess.run(listing, capture_output=True, text=True).stdout
    packages = json.loads(found) if found.startswith("[") else []
    return {p["name"]: p["version"] for p in packages if p["name"] in PACKAGES}


def arguments() -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(description="Compare our solver with other codes.")
    parser.add_argument("--python", default=sys.executable, help="interpreter with the peers")
    parser.add_argument("--json", type=Path, help="write all results to this file")
    parser.add_argument("--limit", type=float, default=1800.0, help="seconds for each code")
    parser.add_argument("--load", type=float, default=1.0, help="fraction of 0.1 MPa")
    parser.add_argument("--only", nargs="*", choices=PEERS, default=list(PEERS), help="peers")
    return parser.parse_args()


def main() -> None:
    """Run all, print the table, write the file."""
    options, before = arguments(), machine()
    pressure = options.load * FULL_PRESSURE
    run("ours", sys.executable, "ours.py", WARM_UP_LOAD, options.limit)
    ours = run("ours", sys.executable, "ours.py", options.load, options.limit)
    print(HEADING, row(ours, ours, pressure), sep="\n", flush=True)
    results = [ours]
    for name in options.only:
        results.append(run(name, options.python, PEERS[name], options.load, options.limit))
        print(row(results[-1], ours, pressure), flush=True)
    if options.json is not None:
        packages = {"ours": versions(sys.executable), "peers": versions(options.python)}
        content = {"machine": before, "packages": packages, "results": results}
        options.json.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
