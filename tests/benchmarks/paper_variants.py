"""Other readings of the three designs of the paper that we do not agree with.

    python tests/benchmarks/paper_variants.py [tests/benchmarks/paper_variants.json]

Each is evaluated ordinarily, and its stress read once more on a mesh with fine fillets, at the
quadrature points (``paper_meshes.py``). Rows are written as they come; those in the file are not
computed again. About five minutes.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from paper_meshes import Case

from bellows_design.design.design import Design
from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design
from bellows_design.files.json_files import write_json
from bellows_design.store import Store, evaluated

VARIANTS: dict[str, tuple[str, ...]] = {
    "Prototype 1": (),
    "thickness 1.2": ("bubble_thickness=1.2",),
    "thickness 1.2, seven bubbles": ("bubble_thickness=1.2", "number_of_bubbles=7"),
    "thickness 1.2, bubbles as long as before": ("bubble_thickness=1.2", "chamber_length=2.6"),
    "thickness 1.2, pitch as before": ("bubble_thickness=1.2", "bubble_distance=2.1"),
    "thickness 1.2, tendon too": ("bubble_thickness=1.2", "tendon_thickness=1.2"),
    "thickness 1.2, inner fillet 0.4": ("bubble_thickness=1.2", "inner_fillet=0.4"),
    "thickness 1.2, inner fillet 0.3": ("bubble_thickness=1.2", "inner_fillet=0.3"),
    "thickness 1.2, outer fillet 1.2": ("bubble_thickness=1.2", "outer_fillet=1.2"),
    "thickness 1.1": ("bubble_thickness=1.1",),
    "thickness 1": ("bubble_thickness=1",),
    "height 16": ("bubble_height=16",),
    "height 15": ("bubble_height=15",),
    "height 14": ("bubble_height=14",),
    "height 13": ("bubble_height=13",),
    "height 16, tendon height 4": ("bubble_height=16", "tendon_height=4"),
    "height 16, tendon height 6": ("bubble_height=16", "tendon_height=6"),
    "height 16, six bubbles": ("bubble_height=16", "number_of_bubbles=6"),
    "distance 1": ("bubble_distance=1",),
    "distance 1, seven bubbles": ("bubble_distance=1", "number_of_bubbles=7"),
    "distance 1.43, seven bubbles": ("bubble_distance=1.43", "number_of_bubbles=7"),
}


def design(label: str) -> Design:
    """Prototype 1 with the changes of that name."""
    return with_overrides(load_design("prototype_1"), VARIANTS[label])


def row(label: str) -> dict[str, Any]:
    """What is found for a variant."""
    found = evaluated(design(label), store=Store.usual())
    read = Case(label, "rounded", "fine fillets").row(found)
    return {
        "variant": label,
        "settings": list(VARIANTS[label]),
        "bubbles": found.design.bellows.bubble_count,
        "bending_angle_deg": found.bending_angle_deg,
        "max_von_mises_mpa": found.max_von_mises_mpa,
        "at_mm": list(found.max_von_mises_position_mm),
        "quadrature_points_mpa": read["quadrature_points_mpa"],
        "beside_crease_mpa": read["beside_crease_mpa"],
    }


def main(target: str = "tests/benchmarks/paper_variants.json") -> None:
    """Compute the rows that are missing, and print the table of docs/paper.md."""
    path = Path(target)
    rows = json.loads(path.read_text("utf-8"))["rows"] if path.is_file() else []
    done = {each["variant"] for each in rows}
    for label in (each for each in VARIANTS if each not in done):
        rows.append(row(label))
        write_json({"rows": rows}, path)
        print(json.dumps(rows[-1]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:2])
