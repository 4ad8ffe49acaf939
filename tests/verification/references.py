"""Reference values and materials of the cases."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from solver import Ogden

DATA = Path(__file__).parent / "data"

NINJAFLEX = Ogden(mu=(0.19825, 3.2778), alpha=(3.05, -0.0054))
"""Curkovic & Jambresic 2020, table 3."""

TRELOAR = Ogden(mu=(0.4095, 0.003, 0.01), alpha=(1.3, 5.0, -2.0))
"""Ogden 1972, his constants in Abaqus's form."""

NEO_HOOKE = Ogden(mu=(1.0,), alpha=(2.0,))


def closed_form(name: str) -> dict[str, Any]:
    """The case of ``data/closed_forms.json`` whose name starts so: definition, reference."""
    cases = json.loads((DATA / "closed_forms.json").read_text(encoding="utf-8"))["cases"]
    return next(case for case in cases if case["name"].startswith(name))
