"""The leak test on the G-code of a real slicer: sound parts, settings that leak, broken copies.

    python tests/benchmarks/leak_detection.py                 all that is not in the JSON yet
    python tests/benchmarks/leak_detection.py finger pin      rows whose name has one of these
    python tests/benchmarks/leak_detection.py --again pin     these rows anew
    python tests/benchmarks/leak_detection.py --table         the table of docs/leak-test.md

Needs PrusaSlicer. A row is a process of its own, so that its memory can be measured; it is printed
as it comes and kept in `leak_detection.json`.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import leaking_parts as parts
import numpy as np

from printers import PrinterProfile, load_profile
from printers.leak_test import LeakTest, leak_test
from printers.model import Opening
from printers.slicing.making import Sliced, slice_mesh

RESULTS = Path(__file__).with_suffix(".json")
COLUMNS = (
    *("verdict", "ratio", "width", "lines", "beside_voids", "depth", "seams", "material"),
    *("leak_distance", "depth_distance", "expected", "as_expected"),
    *("slice_s", "test_s", "cpu_s", "memory_mb"),
)
MARGINAL_BAND = (0.95, 1.05)


@dataclass(frozen=True)
class Case:
    """A part, how it is sliced, and the verdict that it must get: of the path, of the depth."""

    part: Callable[[], parts.LeakingPart]
    expected: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    profile: Mapping[str, Any] = field(default_factory=dict)
    rotation: float = 0.0
    port_radius: float | None = None


finger = partial(parts.shipped, "finger")
SOUND, LEAK, FAIL, WARN = "sealed", "leak", "depth fails", "depth warns or better"

THIN = ("bubble_thickness=0.8", "tendon_thickness=0.8")

CASES: dict[str, Case] = {
    "finger": Case(finger, SOUND),
    "finger, turned by 17°": Case(finger, SOUND, rotation=17.0),
    "finger, turned by 45°": Case(finger, SOUND, rotation=45.0),
    "finger, turned by 90°": Case(finger, SOUND, rotation=90.0),
    "finger, overlap 25 %": Case(finger, SOUND, {"infill_overlap": 25.0}),
    "finger, seam aligned": Case(finger, SOUND, {"seam": "aligned"}),
    "finger, seam nearest": Case(finger, SOUND, {"seam": "nearest"}),
    "prototype_1": Case(partial(parts.shipped, "prototype_1"), SOUND),
    "prototype_2": Case(partial(parts.shipped, "prototype_2"), SOUND),
    "prototype_2_indent": Case(partial(parts.shipped, "prototype_2_indent"), SOUND),
    "prototype_1, overlap 25 %": Case(
        partial(parts.shipped, "prototype_1"), SOUND, {"infill_overlap": 25.0}
    ),
    "prototype_2, overlap 25 %": Case(
        partial(parts.shipped, "prototype_2"), SOUND, {"infill_overlap": 25.0}
    ),
    "one perimeter, one solid layer, no infill": Case(
        finger, LEAK, {"perimeters": 1, "infill_density": 0.0}, {"minimum_solid_layers": 1}
    ),
    "six perimeters": Case(finger, LEAK, {"perimeters": 6}),
    **{
        f"pin of {size:g} mm in a wall": Case(partial(parts.pin_in_wall, size), LEAK)
        for size in (0.2, 0.3, 0.5)
    },
    **{
        f"pin of {size:g} mm in the roof": Case(partial(parts.pin_in_roof, size), LEAK)
        for size in (0.2, 0.3, 0.5)
    },
    **{f"slit of {size:g} mm": Case(partial(parts.slit, size), LEAK) for size in (0.2, 0.3)},
    "wall thinned to 0.1 mm": Case(partial(parts.thin_wall, 0.1), LEAK),
    **{
        f"dent that leaves {rest:g} mm": Case(partial(parts.dent, rest), FAIL)
        for rest in (0.3, 0.5, 0.7)
    },
    "dent that leaves 0.9 mm": Case(partial(parts.dent, 0.9), WARN),
    **{
        f"roof of {rest:g} mm": Case(partial(parts.thin_roof, rest), FAIL)
        for rest in (0.2, 0.4, 0.6)
    },
    "walls of 0.8 mm": Case(
        partial(parts.shipped, "finger", "indent=none", "outer_fillet=1.8", *THIN), FAIL
    ),
    "flow 100 %": Case(finger, FAIL, {"flow": 100.0}),
    "pin of 0.1 mm in a wall, closed by the slicer": Case(partial(parts.pin_in_wall, 0.1), SOUND),
    "slit of 0.05 mm, closed by the slicer": Case(partial(parts.slit, 0.05), SOUND),
}


def profile_of(case: Case) -> PrinterProfile:
    """The shipped profile with the case's changes."""
    plain = load_profile("prusa_i3")
    advice = plain.slicer.model_copy(update=dict(case.settings))
    return plain.model_copy(update={"slicer": advice, **case.profile})


def measure(case: Case) -> dict[str, Any]:
    """One row."""
    part, profile = case.part(), profile_of(case)
    sliced = slice_mesh(*part.mesh, profile, rotation=case.rotation)
    _warm_up(sliced, part, profile)
    started, used = time.perf_counter(), time.process_time()
    test = test_of(sliced, part, profile)
    seconds, cpu = time.perf_counter() - started, time.process_time() - used
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
    return row_of(test, part) | {
        "expected": case.expected,
        "as_expected": is_expected(case, test, part),
        "slice_s": round(sliced.seconds, 1),
        "test_s": round(seconds, 1),
        "cpu_s": round(cpu, 1),
        "memory_mb": round(memory),
    }


def test_of(sliced: Sliced, part: parts.LeakingPart, profile: PrinterProfile) -> LeakTest:
    """The leak test of what was sliced."""
    return leak_test(
        sliced.gcode.beads,
        [on_bed(sliced, part.opening)],
        profile,
        solid_volume=part.solid.volume(),
        transform=sliced.placement.to_part,
    )


def on_bed(sliced: Sliced, opening: Opening) -> Opening:
    """The opening in the frame of the G-code."""
    ends = np.array([opening.centre, np.add(opening.centre, opening.direction)])
    centre, ahead = sliced.placement.to_gcode(ends)
    return Opening(opening.name, tuple(centre), tuple(ahead - centre), opening.radius)


def _warm_up(sliced: Sliced, part: parts.LeakingPart, profile: PrinterProfile) -> None:
    """Compile, or load what is compiled, outside of the measurement: on coarse cells."""
    leak_test(sliced.gcode.beads, [on_bed(sliced, part.opening)], profile,
              voxel=profile.line_width / 3, seams=False)  # fmt: skip


def row_of(test: LeakTest, part: parts.LeakingPart) -> dict[str, Any]:
    """The figures of a test."""
    share = test.material.share
    distances = [part.distance(leak.place) for leak in test.leaks]
    near = None if not distances or distances[0] is None else round(min(distances), 2)  # type: ignore[type-var]
    away = part.distance(test.depth.place)
    rules = {rule.rule: rule.verdict for rule in test.rules}
    return {
        "verdict": test.verdict,
        "ratio": round(test.ratio, 3),
        "width": round(test.width, 3),
        "lines": round(test.depth.lines, 2),
        "beside_voids": round(test.depth.lines_beside_voids, 2),
        "depth": rules["printed_depth"],
        "depth_place": test.depth.place,
        "leak_places": [leak.place for leak in test.leaks],
        "seams": test.seams and test.seams.holds,
        "material": share and round(share, 3),
        "leak_distance": near,
        "depth_distance": None if away is None else round(away, 2),
    }


def is_expected(case: Case, test: LeakTest, part: parts.LeakingPart) -> bool:
    """Whether the verdict is what the case asks for, and its place within 1 mm where it has one."""
    depth = next(rule.verdict for rule in test.rules if rule.rule == "printed_depth")
    low, high = MARGINAL_BAND
    if case.expected == SOUND:
        return test.ratio < high and depth != "fail"
    if case.expected == FAIL:
        return depth == "fail"
    if case.expected == WARN:
        return test.ratio < low and depth != "fail"
    near = part.distance(test.leaks[0].place) if test.leaks else None
    return test.ratio >= low and (part.place is None or (near is not None and near <= 1.0))


def table(rows: Mapping[str, Mapping[str, Any]]) -> str:
    """The rows as they stand in the documentation."""
    names = ("part or slicing", "r\\*", "verdict", "leak, mm", "depth, lines", "beside voids")
    more = ("`printed_depth`", "seams hold, mm", "from the fault, mm")
    lines = ["| " + " | ".join((*names, *more)) + " |", "|---" * len((*names, *more)) + "|"]
    for name, row in rows.items():
        leaks = row["verdict"] == "leaks"
        found = leaks or row["depth"] != "pass"
        away = row["leak_distance" if leaks else "depth_distance"] if found else None
        values = (
            *(name, f"{row['ratio']:.2f}", row["verdict"]),
            *(row["width"] if leaks else None, row["lines"], row["beside_voids"], row["depth"]),
            *(row["seams"], away),
        )
        lines.append(
            "| " + " | ".join("–" if each is None else str(each) for each in values) + " |"
        )
    return "\n".join(lines)


def main(arguments: list[str]) -> None:
    """Measure what is asked for, a row in a process of its own."""
    if arguments[:1] == ["--row"]:
        print(json.dumps(measure(CASES[arguments[1]])))
        return
    rows: dict[str, Any] = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if arguments == ["--table"]:
        print(table(rows))
        return
    again = "--again" in arguments
    asked = [word for word in arguments if not word.startswith("--")]
    print("| part | error | " + " | ".join(COLUMNS) + " |\n|" + "---|" * (len(COLUMNS) + 2))
    for name in CASES:
        if asked and not any(word in name for word in asked):
            continue
        if again or "error" in rows.get(name, {"error": ""}):
            rows[name] = _in_process(name)
            ordered = {key: rows[key] for key in CASES if key in rows}
            RESULTS.write_text(json.dumps(ordered, indent=1, ensure_ascii=False) + "\n")
        shown = (str(rows[name].get(key, "")) for key in ("error", *COLUMNS))
        print(f"| {name} | " + " | ".join(shown) + " |", flush=True)


def _in_process(name: str) -> dict[str, Any]:
    command = [sys.executable, __file__, "--row", name]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        return {"error": done.stderr.strip().splitlines()[-1]}
    row: dict[str, Any] = json.loads(done.stdout.strip().splitlines()[-1])
    return row


if __name__ == "__main__":
    main(sys.argv[1:])
